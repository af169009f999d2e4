#include "places.h"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace swage::test {

std::filesystem::path shared(std::string_view inside) { return std::filesystem::path(SWAGE_SHARED) / inside; }

bool has_shared() { return std::filesystem::exists(shared("oracle")); }

TempFolder::TempFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "swage-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace swage::test

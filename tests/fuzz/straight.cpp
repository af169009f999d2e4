// Chains of vertices that stay straight.
#include "fuzz.h"
#include "swage/handles.h"

namespace swage::fuzz {

void use(std::string_view bytes) {
  constexpr int kVertices = 100;
  const auto read = [&](const std::filesystem::path& path) { return read_straight_chains(path, kVertices); };
  const auto chains = unless_refused<UnreadableFile>([&] { return read(file_of(".txt", bytes)); });
  if (!chains) return;
  const std::filesystem::path path = file_of(".txt", "");
  write_straight_chains(path, *chains);
  require(read(path) == *chains, "chains are kept");
}

}  // namespace swage::fuzz

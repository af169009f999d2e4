// Folders that tests use.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace swage::test {

/// The folder with real meshes and reference results, where there is one: test with has_shared() first.
std::filesystem::path shared(std::string_view inside = "");
bool has_shared();

/// An empty folder, removed with all its files at the end of the scope.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace swage::test

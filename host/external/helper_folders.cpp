#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "helper_process.h"

namespace swage {
namespace {

namespace fs = std::filesystem;

/// `swage` in libexec, then in others of its kind, as packagers like them.
std::vector<fs::path> library_folders(const fs::path& prefix) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator entry(prefix, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    const std::string name = entry->path().filename();
    if (name.starts_with("lib") && name != "libexec" && entry->is_directory(ignored)) {
      folders.push_back(entry->path() / "swage");
    }
  }
  std::sort(folders.begin(), folders.end());
  folders.insert(folders.begin(), prefix / "libexec" / "swage");
  return folders;
}

}  // namespace

std::vector<fs::path> helper_folders() {
  std::vector<fs::path> folders;
  if (const char* named = std::getenv("SWAGE_HELPERS"); named != nullptr && *named != '\0') folders.emplace_back(named);
  std::error_code error;
  const fs::path running = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (!error) {
    folders.push_back(running);
    const std::vector<fs::path> beside = library_folders(running.parent_path());
    folders.insert(folders.end(), beside.begin(), beside.end());
  }
  folders.emplace_back(SWAGE_BUILT_HELPERS);
  folders.emplace_back(SWAGE_INSTALLED_HELPERS);
  return folders;
}

}  // namespace swage

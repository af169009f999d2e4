#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "helper_process.h"

namespace swage {
namespace {

namespace fs = std::filesystem;

/// ../libexec/swage and others of its kind, as packagers like them.
std::vector<fs::path> library_folders(const fs::path& prefix) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator entry(prefix, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().string().starts_with("lib")) folders.push_back(entry->path() / "swage");
  }
  std::sort(folders.begin(), folders.end());
  const auto libexec = std::find(folders.begin(), folders.end(), prefix / "libexec" / "swage");
  if (libexec != folders.end()) std::rotate(folders.begin(), libexec, libexec + 1);
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

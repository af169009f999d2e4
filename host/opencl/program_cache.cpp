#include "program_cache.h"

#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string_view>
#include <utility>

namespace swage {
namespace {

constexpr std::uint64_t kFnvStart = 14695981039346656037u, kFnvPrime = 1099511628211u;
constexpr int kDigits = 16;

/// FNV-1a, sixteen digits: names and checks; it need not resist anyone.
std::string hash(std::string_view bytes) {
  std::uint64_t value = kFnvStart;
  for (const char byte : bytes) value = (value ^ static_cast<unsigned char>(byte)) * kFnvPrime;
  std::ostringstream digits;
  digits << std::hex << std::setw(kDigits) << std::setfill('0') << value;
  return digits.str();
}

/// A file is this, the program's hash, and the program.
std::string head(const std::string& key) { return "swage program 1\n" + key + '\n'; }

std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  static std::atomic<int> serial{0};
  return path.string() + '.' + std::to_string(getpid()) + '.' + std::to_string(serial++);
}

}  // namespace

ProgramCache ProgramCache::of_user() {
  const char* const caches = std::getenv("XDG_CACHE_HOME");
  if (caches != nullptr && *caches == '/') return ProgramCache(std::filesystem::path(caches) / "swage");
  const char* const home = std::getenv("HOME");
  if (home != nullptr && *home == '/') return ProgramCache(std::filesystem::path(home) / ".cache" / "swage");
  return {};
}

std::filesystem::path ProgramCache::path_of(const std::string& key) const { return folder_ / (hash(key) + ".bin"); }

std::optional<ProgramCache::Bytes> ProgramCache::find(const std::string& key) const {
  if (!keeps()) return std::nullopt;
  std::ifstream file(path_of(key), std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  const std::string all = std::move(content).str();
  const std::string start = head(key);
  if (!all.starts_with(start) || all.size() < start.size() + kDigits) return std::nullopt;
  const std::string_view program = std::string_view(all).substr(start.size() + kDigits);
  if (all.compare(start.size(), kDigits, hash(program)) != 0) return std::nullopt;
  return Bytes(program.begin(), program.end());
}

void ProgramCache::keep(const std::string& key, const Bytes& program) const {
  if (!keeps()) return;
  std::error_code ignored;
  std::filesystem::create_directories(folder_, ignored);
  const std::filesystem::path path = path_of(key), temporary = temporary_beside(path);
  std::ofstream file(temporary, std::ios::binary);
  const std::string_view text(reinterpret_cast<const char*>(program.data()), program.size());
  file << head(key) << hash(text) << text;
  file.close();
  if (file) std::filesystem::rename(temporary, path, ignored);
  if (!file || ignored) std::filesystem::remove(temporary, ignored);
}

}  // namespace swage

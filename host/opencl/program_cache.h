// Built programs kept on disk, for platforms that keep none themselves or are slow to find them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swage {

/// A file an entry. Processes may share the folder: an entry is written beside and renamed. What cannot be read,
/// written or trusted is as if it was not there.
class ProgramCache {
 public:
  using Bytes = std::vector<unsigned char>;

  /// Keeps nothing.
  ProgramCache() = default;
  /// Made at the first entry.
  explicit ProgramCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// $XDG_CACHE_HOME/swage or ~/.cache/swage; a cache that keeps nothing where neither is set.
  static ProgramCache of_user();

  bool keeps() const { return !folder_.empty(); }
  std::optional<Bytes> find(const std::string& key) const;
  void keep(const std::string& key, const Bytes& program) const;

 private:
  std::filesystem::path path_of(const std::string& key) const;

  std::filesystem::path folder_;
};

}  // namespace swage

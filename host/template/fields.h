// An object of a template's file, read strictly: by keys that are known, each error with its path and a remedy.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace swage {

using Json = nlohmann::ordered_json;

/// Throws UnreadableFile: "couch.json: nodes[3].radius: ...".
class Fields {
 public:
  /// Throws where it is no object. Must not outlive `object`.
  Fields(const Json& object, std::string file, std::string path);

  /// Whether it is there, where it need not be.
  bool may_have(const char* key);
  /// Throws where there is none.
  const Json& get(const char* key);
  std::string text(const char* key);
  std::string text_or(const char* key, const std::string& otherwise);
  /// One of these.
  std::string choice(const char* key, const std::vector<std::string>& choices, const std::string& otherwise);
  /// Finite.
  double plain_number(const char* key);
  int integer(const char* key, int least, int most);
  /// A list of `least` to `most` entries.
  const Json& list(const char* key, std::size_t least, std::size_t most);

  /// Throws where the object has keys that were not asked for.
  void end() const;

  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  [[noreturn]] void refuse(const std::string& key, const std::string& why) const;
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  const Json* object_;
  std::string file_, path_;
  std::set<std::string> known_;
};

/// "a, b, c"
std::string listed(const std::vector<std::string>& names);

}  // namespace swage

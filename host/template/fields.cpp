#include "fields.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "swage/error.h"

namespace swage {

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

Fields::Fields(const Json& object, std::string file, std::string path)
    : object_(&object), file_(std::move(file)), path_(std::move(path)) {
  if (!object.is_object()) refuse("an object in braces is expected");
}

void Fields::refuse(const std::string& key, const std::string& why) const {
  throw UnreadableFile(file_ + ": " + path_of(key) + ": " + why);
}

void Fields::refuse(const std::string& why) const {
  throw UnreadableFile(file_ + ": " + (path_.empty() ? "" : path_ + ": ") + why);
}

bool Fields::may_have(const char* key) {
  known_.insert(key);
  return object_->contains(key);
}

const Json& Fields::get(const char* key) {
  known_.insert(key);
  const auto found = object_->find(key);
  if (found == object_->end()) refuse(std::string("'") + key + "' is missing; add it");
  return *found;
}

std::string Fields::text(const char* key) {
  const Json& value = get(key);
  if (!value.is_string()) refuse(key, "a text is expected, not " + value.dump());
  return value.get<std::string>();
}

std::string Fields::text_or(const char* key, const std::string& otherwise) {
  return may_have(key) ? text(key) : otherwise;
}

std::string Fields::choice(const char* key, const std::vector<std::string>& choices, const std::string& otherwise) {
  std::string value = otherwise.empty() ? text(key) : text_or(key, otherwise);
  if (std::find(choices.begin(), choices.end(), value) == choices.end()) {
    refuse(key, "'" + value + "' is none of " + listed(choices));
  }
  return value;
}

double Fields::plain_number(const char* key) {
  const Json& value = get(key);
  if (!value.is_number()) refuse(key, "a number is expected, not " + value.dump());
  const double number = value.get<double>();
  if (!std::isfinite(number)) refuse(key, "a finite number is expected");
  return number;
}

int Fields::integer(const char* key, int least, int most) {
  const double number = plain_number(key);
  if (number != std::floor(number) || number < least || number > most) {
    refuse(key, "a whole number from " + std::to_string(least) + " to " + std::to_string(most) + " is expected, not " +
                    get(key).dump());
  }
  return static_cast<int>(number);
}

const Json& Fields::list(const char* key, std::size_t least, std::size_t most) {
  const Json& value = get(key);
  if (!value.is_array()) refuse(key, "a list in brackets is expected, not " + value.dump());
  if (value.size() < least || value.size() > most) {
    refuse(key, (least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most)) +
                    " entries are expected, not " + std::to_string(value.size()));
  }
  return value;
}

void Fields::end() const {
  for (const auto& [key, value] : object_->items()) {
    if (known_.contains(key)) continue;
    refuse(key, "is not known here; known are " + listed({known_.begin(), known_.end()}) + "; remove or rename it");
  }
}

}  // namespace swage

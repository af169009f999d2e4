#include "shipped.h"

#include "fields.h"
#include "swage/error.h"
#include "swage/template.h"

namespace swage {

std::vector<std::string> shipped_templates() {
  std::vector<std::string> names;
  for (const auto& [name, text] : shipped_files()) names.emplace_back(name);
  return names;
}

Template shipped_template(std::string_view name) {
  const auto found = shipped_files().find(name);
  if (found == shipped_files().end()) {
    throw InvalidInput("there is no template '" + std::string(name) + "'; there are " + listed(shipped_templates()));
  }
  return parse_template(found->second, std::string(name));
}

}  // namespace swage

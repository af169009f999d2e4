// Templates from files.
#include "input.h"
#include "swage/template.h"

namespace swage {

Template read_template(const std::filesystem::path& path) {
  const Input input = slurp(path);
  require_text(input);
  return parse_template(std::string_view(input.bytes).substr(text_begin(input)), path.string());
}

}  // namespace swage

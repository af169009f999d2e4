#include "axis_list.h"

#include <spdlog/fmt/fmt.h>

#include <CLI/StringTools.hpp>
#include <CLI/TypeTools.hpp>

#include "failure.h"

namespace swage::cli {

AxisList axis_list(const std::string& option, const std::string& text, const AxisRange& range) {
  std::vector<std::string> parts;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(CLI::detail::trim_copy(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  if (parts.size() != 3) {
    throw WrongUsage(fmt::format("{} {}: give three values, for x, y and z, such as 2,1,1", option, text));
  }
  AxisList list;
  for (size_t u = 0; u < 3; ++u) {
    if (parts[u].empty() || parts[u] == "-") continue;
    double value = 0;
    const bool good = CLI::detail::lexical_cast(parts[u], value) && value >= range.low && value <= range.high;
    if (!good) {
      throw WrongUsage(
          fmt::format("{} {}: '{}' is not {}; - leaves an axis as it is", option, text, parts[u], range.words));
    }
    list[u] = value;
  }
  return list;
}

}  // namespace swage::cli

// Three values of an option, one for each axis: X,Y,Z.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace swage::cli {

/// None where an axis is left as it is.
using AxisList = std::array<std::optional<double>, 3>;

struct AxisRange {
  double low, high;   ///< Both included.
  const char* words;  ///< What each value is, such as "a factor from 1e-6 to 1e6".
};

/// "2,1,1"; "-" or nothing for an axis that is left as it is. Throws WrongUsage, naming the option.
AxisList axis_list(const std::string& option, const std::string& text, const AxisRange& range);

}  // namespace swage::cli

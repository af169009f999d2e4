// What messages say of numbers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <charconv>
#include <string>

namespace swage {

/// The shortest that reads back as the same double: a number that is beyond a bound by little looks so.
inline std::string digits(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// The first row with an entry that is not finite, -1 where there is none.
template <typename Rows>
Eigen::Index first_not_finite(const Rows& rows) {
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    if (!rows.row(i).allFinite()) return i;
  }
  return -1;
}

}  // namespace swage

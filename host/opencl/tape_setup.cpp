#include "tape_setup.h"

#include <algorithm>

namespace swage {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

int setup_begin(const Tape& tape) { return tape.parameter_count + static_cast<int>(tape.constants.size()); }

/// #slots × #parameters.
MatrixXd by_parameters(const Tape& tape, const Eigen::VectorXd& values) {
  MatrixXd result = MatrixXd::Zero(values.size(), tape.parameter_count);
  result.topRows(tape.parameter_count).setIdentity();
  Index slot = setup_begin(tape);
  for (const auto& [op, a, b] : tape.setup) {
    const TapeSlopes own = slopes_of(op, values[a], values[b], values[slot]);
    result.row(slot) = own.a * result.row(a);
    if (is_binary(op)) result.row(slot) += own.b * result.row(b);
    ++slot;
  }
  return result;
}

}  // namespace

TapeSetup::TapeSetup(const Tape& tape, const Eigen::VectorXd& parameters, bool with_derivatives)
    : values(tape.uniform_count()) {
  values.head(tape.parameter_count) = parameters;
  std::copy(tape.constants.begin(), tape.constants.end(), values.data() + tape.parameter_count);
  Index slot = setup_begin(tape);
  for (const auto& [op, a, b] : tape.setup) values[slot++] = value_of(op, values[a], values[b]);

  offsets.push_back(0);
  std::vector<double> found;
  const MatrixXd matrix = with_derivatives ? by_parameters(tape, values) : MatrixXd();
  for (Index m = 0; m < tape.parameter_count; ++m) {
    for (Index s = 0; s < matrix.rows(); ++s) {
      if (matrix(s, m) == 0) continue;
      slots.push_back(static_cast<int>(s));
      found.push_back(matrix(s, m));
    }
    offsets.push_back(static_cast<int>(slots.size()));
  }
  weights = Eigen::Map<const Eigen::VectorXd>(found.data(), static_cast<Index>(found.size()));
}

}  // namespace swage

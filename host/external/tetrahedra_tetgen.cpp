// TetGen (AGPL), as a program of its own.
#include "helpers/wire.h"
#include "swage/error.h"
#include "tetrahedra.h"

namespace swage {
namespace {

template <typename Matrix, typename Item>
Matrix rows_of(const std::vector<Item>& items) {
  return Eigen::Map<const Matrix>(items.data(), static_cast<Eigen::Index>(items.size()) / Matrix::ColsAtCompileTime,
                                  Matrix::ColsAtCompileTime);
}

template <typename Matrix>
void add(wire::Writer& message, const Matrix& rows) {
  message.add(rows.data(), static_cast<size_t>(rows.size()));
}

}  // namespace

bool has_tetgen() { return true; }

Filling tetrahedra_of(const Complex& complex, bool quality, const HelperLimits& limits, const Poll& poll) {
  wire::Writer message;
  add(message, complex.points);
  add(message, complex.triangles);
  add(message, complex.quadrilaterals);
  message.add(std::vector<std::int32_t>{quality ? 1 : 0});
  const std::string answer = run_helper("swage-tetgen", message.take(), limits, poll);
  try {
    wire::Reader reader(answer);
    Filling filling;
    filling.points = rows_of<Positions>(reader.read<double>(3));
    filling.tetrahedra = rows_of<Tetrahedra>(reader.read<std::int32_t>(4));
    filling.crossing = reader.read<std::int32_t>();
    reader.finish();
    return filling;
  } catch (const wire::Malformed& error) {
    throw Unsolvable("swage-tetgen answers with " + std::string(error.what()));
  }
}

}  // namespace swage

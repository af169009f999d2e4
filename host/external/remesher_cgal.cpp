// CGAL (GPL), as a program of its own.
#include "helpers/wire.h"
#include "remesher.h"
#include "swage/error.h"

namespace swage {
namespace {

constexpr double kOffset = 1.0 / 30;  // Of the envelope from the triangles, in alphas.

template <typename Matrix, typename Item>
Matrix rows_of(const std::vector<Item>& items) {
  return Eigen::Map<const Matrix>(items.data(), static_cast<Eigen::Index>(items.size()) / 3, 3);
}

std::string message_of(const RemeshTask& task) {
  const auto& [positions, triangles] = task.mesh;
  return wire::Writer()
      .add(positions.data(), static_cast<size_t>(positions.size()))
      .add(triangles.data(), static_cast<size_t>(triangles.size()))
      .add(std::vector<double>{task.edge_length, task.feature_angle, task.wrap_alpha, kOffset * task.wrap_alpha})
      .add(std::vector<std::int32_t>{task.iterations, task.wrap_alpha > 0 ? 1 : 0, task.triangle_limit})
      .take();
}

}  // namespace

bool has_cgal() { return true; }

Mesh remeshed(const RemeshTask& task, const HelperLimits& limits, const Poll& poll) {
  const std::string answer = run_helper("swage-remesh", message_of(task), limits, poll);
  try {
    wire::Reader reader(answer);
    Mesh mesh;
    mesh.positions = rows_of<Positions>(reader.read<double>(3));
    mesh.triangles = rows_of<Triangles>(reader.read<std::int32_t>(3));
    reader.finish();
    return mesh;
  } catch (const wire::Malformed& error) {
    throw Unsolvable("swage-remesh answers with " + std::string(error.what()));
  }
}

}  // namespace swage

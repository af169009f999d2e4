#include "samples.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "by_place.h"
#include "measures.h"
#include "swage/thrown.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;

constexpr double kLarger = 1.5;
constexpr double kAbout =
    0.25;  // Of the diagonal, at least: a thin mesh has much about it that a template may reach into.

/// In [0, 1): the same on every machine.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace

Positions surface_samples(const Mesh& given, int count, unsigned seed) {
  Mesh mesh = in_order(given, by_place(given));
  begin_with_first(mesh.triangles);
  Random random(seed);
  const Eigen::VectorXd areas = area_vectors(mesh.positions, mesh.triangles).rowwise().norm();
  const double each = areas.sum() / count;
  Positions samples(count, 3);
  Index t = 0;
  double passed = 0;  // The area of triangles before t.
  for (Index s = 0; s < count; ++s) {
    const double at = (static_cast<double>(s) + random()) * each;
    while (t + 1 < areas.size() && passed + areas[t] <= at) passed += areas[t++];
    const double root = std::sqrt(random()), along = random();
    const RowVector3d a = mesh.positions.row(mesh.triangles(t, 0)), b = mesh.positions.row(mesh.triangles(t, 1)),
                      c = mesh.positions.row(mesh.triangles(t, 2));
    samples.row(s) = (1 - root) * a + root * (1 - along) * b + root * along * c;
  }
  return samples;
}

VolumeSamples volume_samples(const Mesh& mesh, const SurfaceDistance& distance, int count, unsigned seed) {
  Random random(seed);
  const RowVector3d low = mesh.positions.colwise().minCoeff(), high = mesh.positions.colwise().maxCoeff();
  const RowVector3d middle = 0.5 * (low + high);
  const RowVector3d half =
      (0.5 * kLarger * (high - low)).array().max(0.5 * (high - low).array() + kAbout * (high - low).norm());
  VolumeSamples samples{Positions(count, 3), Eigen::VectorXd(count), std::vector<char>(static_cast<size_t>(count))};
  for (Index s = 0; s < count; ++s) {
    for (int u = 0; u < 3; ++u) samples.points(s, u) = middle[u] + (2 * random() - 1) * half[u];
  }
  Thrown thrown;
#pragma omp parallel for schedule(dynamic, 64)
  for (Index s = 0; s < count; ++s) {
    thrown.keep([&] {
      const SurfaceDistance::Found found = distance(samples.points.row(s));
      samples.distances[s] = found.distance;
      // Beyond its box nothing is inside.
      const auto point = samples.points.row(s).array();
      const bool is_beyond = (point < low.array()).any() || (point > high.array()).any();
      samples.is_signed[static_cast<size_t>(s)] = found.is_signed || is_beyond ? 1 : 0;
    });
  }
  thrown.rethrow();
  return samples;
}

}  // namespace swage

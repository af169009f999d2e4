#include "face_curvature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "swage/curvature.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;

constexpr int kRings = 2;
constexpr double kAlongNormal = 0.99984769515639127;  // Cosine of a degree.
constexpr Index kVertices = 1 << 17;                  // Fitted at once.
// Coordinates of six digits make flat parts curve by 1e-6 of the diagonal over the square of their edges' length:
// shorter edges than this, of the diagonal, need the mean with their neighbours, of half the length twice that, and so
// on. Grids do not see what is lost.
constexpr double kFine = 0.005;
constexpr int kMostPasses = 4;
// Sides of the diagonal from which triangles are large: all corners of one may lie on roundings beside it, so that it
// is asked how far normals turn over the triangle itself. From the second on alone. Smaller ones may be parts of a
// facet, of what is round as a whole.
constexpr double kLarge = 0.05, kLargest = 0.1;

CurvatureTensor tensor_of(const RowVector3d& a, const RowVector3d& b, double scale) {
  CurvatureTensor tensor;
  int entry = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) tensor[entry++] = static_cast<float>(scale * (a[i] * b[j] + a[j] * b[i]));
  }
  return tensor;
}

RowVector3d times(const CurvatureTensor& t, const RowVector3d& v) {
  return {t[0] * v[0] + t[1] * v[1] + t[2] * v[2], t[1] * v[0] + t[3] * v[1] + t[4] * v[2],
          t[2] * v[0] + t[4] * v[1] + t[5] * v[2]};
}

/// Of the two that are not 0, the larger in magnitude.
double largest_eigenvalue(const CurvatureTensor& t) {
  const double half_trace = 0.5 * (t[0] + t[3] + t[5]);
  const double squares = t[0] * t[0] + t[3] * t[3] + t[5] * t[5] + 2 * (t[1] * t[1] + t[2] * t[2] + t[4] * t[4]);
  return std::abs(half_trace) + std::sqrt(std::max(0.0, squares / 2 - half_trace * half_trace));
}

}  // namespace

Eigen::RowVector3d curvatures_along(const CurvatureTensor& tensor, const RowVector3d& normal) {
  const RowVector3d across = times(tensor, normal);  // 0, but for rounding and means.
  const double up = across.dot(normal);
  RowVector3d along;
  for (int u = 0; u < 3; ++u) {
    const double n = normal[u], own = tensor[u == 0 ? 0 : u == 1 ? 3 : 5];
    along[u] = std::abs(n) > kAlongNormal ? largest_eigenvalue(tensor)
                                          : std::abs(own - 2 * n * across[u] + n * n * up) / (1 - n * n);
  }
  return along;
}

FaceCurvatures::FaceCurvatures(Pieces pieces, double diagonal, const Backend& backend, const Poll& poll)
    : pieces_(std::move(pieces)),
      diagonal_(diagonal),
      near_(pieces_.mesh, kRings),
      tensors_(pieces_.mesh.positions.rows(), 6) {
  fit(backend, poll);
  smooth(poll);
}

void FaceCurvatures::fit(const Backend& backend, const Poll& poll) {
  const Index count = tensors_.rows();
  Curvatures principal;
  Positions directions;
  for (Index first = 0; first < count; first += kVertices) {
    ask(poll);
    const Index some = std::min(kVertices, count - first);
    backend.curvature(near_.of({first, first + some}))->fit(principal, directions);
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < some; ++i) {
      const RowVector3d along = directions.row(i), normal = near_.normals().row(first + i);
      const RowVector3d across = normal.cross(along);
      tensors_.row(first + i) =
          tensor_of(along, along, principal(i, 0) / 2) + tensor_of(across, across, principal(i, 1) / 2);
    }
  }
}

void FaceCurvatures::smooth(const Poll& poll) {
  const Lists& near = near_.one_rings();
  const Positions& positions = pieces_.mesh.positions;
  std::vector<char> passes(static_cast<size_t>(near.size()));  // Of each vertex.
#pragma omp parallel for schedule(static)
  for (int v = 0; v < near.size(); ++v) {
    double sum = 0;
    for (const int other : near[v]) sum += (positions.row(other) - positions.row(v)).norm();
    const double length = sum / std::max(1, near[v].size());
    const double halvings = length > 0 ? std::ceil(std::log2(kFine * diagonal_ / length)) : 0;
    passes[static_cast<size_t>(v)] = static_cast<char>(std::clamp(halvings, 0.0, double{kMostPasses}));
  }
  const char most = passes.empty() ? char{0} : *std::max_element(passes.begin(), passes.end());
  CurvatureTensors means(most > 0 ? tensors_.rows() : 0, 6);
  for (char pass = 0; pass < most; ++pass) {
    ask(poll);
#pragma omp parallel for schedule(static)
    for (int v = 0; v < near.size(); ++v) {
      CurvatureTensor sum = tensors_.row(v);
      if (passes[static_cast<size_t>(v)] > pass) {
        for (const int other : near[v]) sum += tensors_.row(other);
        sum /= static_cast<float>(1 + near[v].size());
      }
      means.row(v) = sum;
    }
    tensors_.swap(means);
  }
}

/// From the normals at the corners, linear in between.
CurvatureTensor FaceCurvatures::by_normals(Index triangle, const RowVector3d& area) const {
  const auto corner = [&](int k) { return pieces_.mesh.triangles(triangle, k % 3); };
  const RowVector3d normal = area.normalized();
  CurvatureTensor tensor = CurvatureTensor::Zero();
  for (int k = 0; k < 3; ++k) {
    const RowVector3d side = pieces_.mesh.positions.row(corner(k + 2)) - pieces_.mesh.positions.row(corner(k + 1));
    const RowVector3d gradient = normal.cross(side) / area.norm();  // Of the weight of corner k.
    const RowVector3d own = near_.normals().row(corner(k));
    tensor += tensor_of(own - normal.dot(own) * normal, gradient, 0.5);
  }
  return tensor;
}

Eigen::RowVector3d FaceCurvatures::along_axes(Index triangle) const {
  const Positions& positions = pieces_.mesh.positions;
  const Eigen::RowVector3i corners = pieces_.mesh.triangles.row(triangle);
  const RowVector3d ab = positions.row(corners[1]) - positions.row(corners[0]);
  const RowVector3d ac = positions.row(corners[2]) - positions.row(corners[0]);
  const RowVector3d area = ab.cross(ac);
  const double longest = std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()}));
  if (!(area.norm() > CarryStep::kLeastHeight * longest * longest)) return RowVector3d::Zero();
  RowVector3d mean = RowVector3d::Zero();
  for (const int v : corners) mean += curvatures_along(tensors_.row(v), near_.normals().row(v)) / 3;
  const double part = std::clamp((longest / diagonal_ - kLarge) / (kLargest - kLarge), 0.0, 1.0);
  if (part == 0) return mean;
  const RowVector3d least = mean.cwiseMin(curvatures_along(by_normals(triangle, area), area.normalized()));
  return (1 - part) * mean + part * least;
}

}  // namespace swage

// The zero set as a mesh, by dual contouring.
//
// Ju, Losasso, Schaefer, Warren: Dual Contouring of Hermite Data. SIGGRAPH 2002.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "axes.h"
#include "lattice.h"
#include "messages.h"
#include "preparation.h"
#include "swage/error.h"
#include "swage/template.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::RowVector3d;

constexpr int kRefinements = 8;          // Of where an edge is crossed.
constexpr double kFlatDirection = 0.05;  // Of the normals' spread: directions in which they spread less are not told.

Place moved(Place place, int axis, int by) {
  place[static_cast<size_t>(axis)] += by;
  return place;
}

/// An edge of the lattice on which the field changes its sign.
struct Crossing {
  Place first;
  int axis;
  bool grows;  ///< From its first corner on.
};

class Contour {
 public:
  Contour(const FieldAt& field, const NearCells& near) : field_(field), lattice_(near.lattice) {
    find_crossings(near.cells);
  }

  Mesh mesh() {
    locate();
    place_vertices();
    return join();
  }

 private:
  void find_crossings(const std::vector<Place>& cells) {
    std::unordered_map<std::int64_t, Index> numbers;
    std::vector<Place> corners;
    for (const Place& cell : cells) {
      for (int corner = 0; corner < 8; ++corner) {
        const Place place = {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)};
        if (numbers.try_emplace(lattice_.key(place), static_cast<Index>(corners.size())).second)
          corners.push_back(place);
      }
    }
    Positions points(static_cast<Index>(corners.size()), 3);
    for (size_t c = 0; c < corners.size(); ++c) points.row(static_cast<Index>(c)) = lattice_.at(corners[c]);
    FieldValues found;
    field_.evaluate(points, FieldDerivatives::none, found);
    for (size_t c = 0; c < corners.size(); ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto other = numbers.find(lattice_.key(moved(corners[c], axis, 1)));
        if (other == numbers.end() || corners[c][static_cast<size_t>(axis)] == lattice_.count) continue;
        const bool inside = found.values[static_cast<Index>(c)] < 0, beyond = found.values[other->second] < 0;
        if (inside != beyond) crossings_.push_back({corners[c], axis, inside});
      }
    }
  }

  /// By halving, all crossings at once.
  void locate() {
    const auto count = static_cast<Index>(crossings_.size());
    Eigen::VectorXd low = Eigen::VectorXd::Zero(count), high = Eigen::VectorXd::Ones(count);
    FieldValues found;
    points_.resize(count, 3);
    for (int i = 0; i <= kRefinements; ++i) {
      const Eigen::VectorXd part = 0.5 * (low + high);
      for (Index c = 0; c < count; ++c) {
        const Crossing& crossing = crossings_[static_cast<size_t>(c)];
        points_.row(c) = lattice_.at(crossing.first);
        points_(c, crossing.axis) += part[c] * lattice_.width;
      }
      if (i == kRefinements) break;
      field_.evaluate(points_, FieldDerivatives::none, found);
      for (Index c = 0; c < count; ++c) {
        const bool before = (found.values[c] < 0) == crossings_[static_cast<size_t>(c)].grows;
        (before ? low : high)[c] = part[c];
      }
    }
    field_.evaluate(points_, FieldDerivatives::in_space, found);
    normals_ = found.gradients.rowwise().normalized();
  }

  /// The four cells around a crossed edge, in turn about its axis.
  static std::array<Place, 4> around(const Crossing& crossing) {
    const int a = next(crossing.axis), b = next(a);
    const Place low = moved(moved(crossing.first, a, -1), b, -1);
    return {low, moved(low, a, 1), crossing.first, moved(low, b, 1)};
  }

  void place_vertices() {
    std::vector<std::vector<Index>> crossed;  // Edges of each cell.
    std::vector<Place> cells;
    for (size_t c = 0; c < crossings_.size(); ++c) {
      for (const Place& cell : around(crossings_[c])) {
        const auto [found, is_new] = vertices_.try_emplace(lattice_.key(cell), static_cast<int>(cells.size()));
        if (is_new) {
          cells.push_back(cell);
          crossed.emplace_back();
        }
        crossed[static_cast<size_t>(found->second)].push_back(static_cast<Index>(c));
      }
    }
    positions_.resize(static_cast<Index>(cells.size()), 3);
#pragma omp parallel for schedule(static)
    for (Index v = 0; v < positions_.rows(); ++v) {
      positions_.row(v) = vertex_in(cells[static_cast<size_t>(v)], crossed[static_cast<size_t>(v)]);
    }
  }

  /// Where the tangent planes meet; about their middle where they do not tell. Within the cell.
  RowVector3d vertex_in(const Place& cell, const std::vector<Index>& crossed) const {
    RowVector3d middle = RowVector3d::Zero();
    for (const Index c : crossed) middle += points_.row(c);
    middle /= static_cast<double>(crossed.size());
    Matrix3d matrix = Matrix3d::Zero();
    Eigen::Vector3d side = Eigen::Vector3d::Zero();
    for (const Index c : crossed) {
      const Eigen::Vector3d n = normals_.row(c);
      if (!n.allFinite()) continue;
      matrix += n * n.transpose();
      side += n * n.dot(points_.row(c) - middle);
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(matrix);
    RowVector3d vertex = middle;
    for (int k = 0; k < 3; ++k) {
      if (!(axes.eigenvalues()[k] > kFlatDirection * axes.eigenvalues()[2])) continue;
      const Eigen::Vector3d axis = axes.eigenvectors().col(k);
      vertex += (axis.dot(side) / axes.eigenvalues()[k] * axis).transpose();
    }
    const RowVector3d low = lattice_.at(cell);
    return vertex.cwiseMax(low).cwiseMin(low + RowVector3d::Constant(lattice_.width));
  }

  /// Two triangles about each crossed edge, cut along the shorter diagonal.
  Mesh join() {
    Mesh mesh{positions_, Triangles(2 * static_cast<Index>(crossings_.size()), 3)};
    for (size_t c = 0; c < crossings_.size(); ++c) {
      std::array<int, 4> corners = {};
      const std::array<Place, 4> cells = around(crossings_[c]);
      for (size_t k = 0; k < 4; ++k) corners[k] = vertices_.at(lattice_.key(cells[k]));
      if (!crossings_[c].grows) std::swap(corners[1], corners[3]);
      const auto at = [&](size_t k) { return mesh.positions.row(corners[k]); };
      const size_t first = (at(0) - at(2)).norm() <= (at(1) - at(3)).norm() ? 0 : 1;
      const auto corner = [&](size_t k) { return corners[(first + k) % 4]; };
      const auto row = 2 * static_cast<Index>(c);
      mesh.triangles.row(row) << corner(0), corner(1), corner(2);
      mesh.triangles.row(row + 1) << corner(0), corner(2), corner(3);
    }
    return mesh;
  }

  const FieldAt& field_;
  Lattice lattice_;
  std::vector<Crossing> crossings_;
  Positions points_, normals_;                      // Of crossings.
  std::unordered_map<std::int64_t, int> vertices_;  // Of cells.
  Positions positions_;
};

constexpr int kLeastResolution = 8, kMostResolution = 1024;

void check_arguments(const Template& of, const Eigen::VectorXd& parameters, const TemplateMeshOptions& options) {
  const auto count = static_cast<Index>(of.parameters().size());
  if (parameters.size() != count) {
    throw InvalidInput("template_mesh: parameters: " + std::to_string(parameters.size()) + ", but the template has " +
                       std::to_string(count) + "; give one value for each");
  }
  if (const Index i = first_not_finite(parameters); i >= 0) {
    throw InvalidInput("template_mesh: parameters: " + of.parameters()[static_cast<size_t>(i)].name +
                       " is not finite; mend it");
  }
  if (options.resolution < kLeastResolution || options.resolution > kMostResolution) {
    throw InvalidInput("template_mesh: options.resolution: " + std::to_string(options.resolution) +
                       " is not between 8 and 1024");
  }
}

}  // namespace

Mesh template_mesh(const Template& of, const Eigen::VectorXd& parameters, const TemplateMeshOptions& options,
                   const ProgressFn& progress) {
  check_arguments(of, parameters, options);
  const std::shared_ptr<Backend> backend = options.backend ? options.backend : cpu_backend();
  const std::unique_ptr<FieldStep> step = of.field(*backend);
  const FieldAt field{*step, parameters};
  try {
    Stages stages(progress, 1, 1);
    stages.begin("cells", 0);
    const NearCells near = cells_near(field, options.resolution, stages.poll());
    if (near.cells.empty())
      throw Unsolvable("template " + of.name() + ": there is no surface near the origin; change its parameters");
    if (near.touch_border())
      throw Unsolvable("template " + of.name() + ": its surface does not end within 64 units; change its parameters");
    stages.begin("surface", 0.5);
    return Contour(field, near).mesh();
  } catch (const Cancelled&) {
    return {};
  }
}

}  // namespace swage

// The transform step (paper sections 3.3 and 4.2) as the formulas read.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "cpu_steps.h"
#include "inverse.h"
#include "matrix_of_row.h"

namespace swage {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Row9 = Eigen::Matrix<double, 1, 9>;

Row9 row(const Matrix3d& matrix) {
  Row9 entries;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(entries.data()) = matrix;
  return entries;
}

/// Below so many elements a pass is over sooner than the threads have met, on a busy machine far sooner.
constexpr Eigen::Index kWorthThreads = 20000;

class CpuTransform final : public TransformStep {
 public:
  explicit CpuTransform(std::shared_ptr<const Rest> rest)
      : shared_rest_(std::move(rest)),
        rest_(*shared_rest_),
        rest_lengths_(rest_.edge_vectors.rowwise().norm()),
        transforms_(rest_.triangles.rows(), 9),
        inverses_(rest_.triangles.rows(), 9) {
    list_triangles_of_edges();
    CpuTransform::reset();
  }

  void reset() override {
    length_weights_ = rest_.length_weights;
    if (length_weights_.size() == 0) {
      length_weights_ = rest_lengths_.unaryExpr([this](double l) { return length_weight(l); });
    }
  }

  void fit_edges(const Transforms& transforms, EdgeQuadratics& quadratics) override {
    check_rows("TransformStep::fit_edges", "transforms", transforms.rows(), rest_.triangles.rows());
    transforms_ = transforms;
    invert(quadratics);
    const Eigen::Index edge_count = rest_lengths_.size();
    quadratics.blocks.resize(edge_count, 6);
    quadratics.right_hand_sides.resize(edge_count, 3);
    quadratics.target_lengths.resize(edge_count);
#pragma omp parallel for schedule(static) if (edge_count > kWorthThreads)
    for (Eigen::Index e = 0; e < edge_count; ++e) {
      quadratics.target_lengths[e] = target_length(e);
      if (rest_.weighs_targets) length_weights_[e] = length_weight(quadratics.target_lengths[e]);
      fit_edge(e, quadratics);
    }
  }

  Energy fit_transforms(const Positions& positions, Transforms& right_hand_sides) override {
    check_rows("TransformStep::fit_transforms", "positions", positions.rows(), rest_.vertices.rows());
    vectors_.resize(rest_.edges.rows(), 3);
#pragma omp parallel for schedule(static) if (rest_.edges.rows() > kWorthThreads)
    for (Eigen::Index e = 0; e < rest_.edges.rows(); ++e) {
      vectors_.row(e) = positions.row(rest_.edges(e, 1)) - positions.row(rest_.edges(e, 0));
    }
    right_hand_sides.resize(rest_.triangles.rows(), 9);
#pragma omp parallel for schedule(static) if (rest_.triangles.rows() > kWorthThreads)
    for (Eigen::Index t = 0; t < rest_.triangles.rows(); ++t) right_hand_sides.row(t) = right_hand_side(t);
    const Energy reached = energy(positions);
    if (!rest_.weighs_targets) {
      length_weights_ = vectors_.rowwise().norm().unaryExpr([this](double l) { return length_weight(l); });
    }
    return reached;
  }

 private:
  /// Eq. 6.
  double length_weight(double length) const {
    const double relative = length / rest_.mean_edge_length;
    return std::max(1.0, relative * relative);
  }

  void list_triangles_of_edges() {
    first_triangles_.resize(static_cast<size_t>(rest_.edges.rows()) + 1);
    for (const int e : rest_.triangle_edges.reshaped()) ++first_triangles_[static_cast<size_t>(e) + 1];
    std::partial_sum(first_triangles_.begin(), first_triangles_.end(), first_triangles_.begin());
    triangles_of_edges_.resize(static_cast<size_t>(rest_.triangle_edges.size()));
    std::vector<int> next(first_triangles_.begin(), first_triangles_.end() - 1);
    for (int t = 0; t < rest_.triangles.rows(); ++t) {
      for (const int e : rest_.triangle_edges.row(t)) {
        triangles_of_edges_[static_cast<size_t>(next[static_cast<size_t>(e)]++)] = t;
      }
    }
  }

  std::span<const int> triangles_beside(Eigen::Index e) const {
    const int first = first_triangles_[static_cast<size_t>(e)], end = first_triangles_[static_cast<size_t>(e) + 1];
    return std::span(triangles_of_edges_).subspan(static_cast<size_t>(first), static_cast<size_t>(end - first));
  }

  void invert(EdgeQuadratics& quadratics) {
    int singular = 0;
#pragma omp parallel for schedule(static) reduction(+ : singular) if (transforms_.rows() > kWorthThreads)
    for (Eigen::Index t = 0; t < transforms_.rows(); ++t) {
      const DampedInverse result = damped_inverse(inverted(t));
      inverses_.row(t) = row(result.matrix);
      singular += result.damped ? 1 : 0;
    }
    quadratics.singular = singular;
  }

  /// What the vertex step inverts of a triangle's transform.
  Matrix3d inverted(Eigen::Index t) const {
    Matrix3d transform = matrix(transforms_, t);
    if (!rest_.maps_normals) return transform;
    const Vector3d normal = rest_.normals.row(t);
    const Vector3d along = normal[0] * transform.col(1).cross(transform.col(2)) +
                           normal[1] * transform.col(2).cross(transform.col(0)) +
                           normal[2] * transform.col(0).cross(transform.col(1));
    const Vector3d image = along / std::sqrt(std::max(along.norm(), 1e-12));
    return transform + (image - transform * normal) * normal.transpose();
  }

  double target_length(Eigen::Index e) const {
    if (rest_.target_lengths.size() != 0) return rest_.target_lengths[e];
    const std::span<const int> beside = triangles_beside(e);
    double sum = 0;
    for (const int t : beside) sum += (matrix(transforms_, t) * rest_.edge_vectors.row(e).transpose()).norm();
    // A transform that flattens an edge must not make its terms infinite.
    return std::max(sum / static_cast<double>(beside.size()), 1e-9 * rest_lengths_[e]);
  }

  /// Eqs. 20, 21 and 34, each triangle beside the edge.
  void fit_edge(Eigen::Index e, EdgeQuadratics& quadratics) const {
    const Vector3d rest_vector = rest_.edge_vectors.row(e);
    const double rest_length = rest_lengths_[e], target = quadratics.target_lengths[e], weight = length_weights_[e];
    const double scale = rest_.scale_weight / rest_.mean_edge_length;
    Matrix3d block = scale * Matrix3d::Identity();
    Vector3d side = scale * rest_vector;
    for (const int t : triangles_beside(e)) {
      const Matrix3d inverse = matrix(inverses_, t);
      const Vector3d normal = rest_.normals.row(t);
      block += weight / (rest_length * rest_length) * inverse.transpose() * inverse;
      block += rest_.normal_weight * weight * rest_length / rest_.mean_edge_length / (target * target) * normal *
               normal.transpose();
      side += weight / (rest_length * rest_length) * inverse.transpose() * rest_vector;
    }
    quadratics.blocks.row(e) << block(0, 0), block(0, 1), block(0, 2), block(1, 1), block(1, 2), block(2, 2);
    quadratics.right_hand_sides.row(e) = side;
  }

  /// Of eq. 24 in the form (1/L) |T e0 - e|² and of eq. 28.
  Row9 right_hand_side(Eigen::Index t) const {
    const Vector3d normal = rest_.normals.row(t);
    Matrix3d sum = rest_.regularizer_weight * Matrix3d::Identity();
    sum += rest_.normal_regularizer_weight * normal * normal.transpose();
    for (int k = 0; k < 3; ++k) {
      const int e = rest_.triangle_edges(t, k);
      sum += vectors_.row(e).transpose() * rest_.edge_vectors.row(e) / rest_.mean_edge_length;
    }
    return row(sum);
  }

  Energy energy(const Positions& positions) const {
    Energy sum;
    sum.scale = rest_.scale_weight / rest_.mean_edge_length * add_up(rest_.edges.rows(), [&](Eigen::Index e) {
                  return (vectors_.row(e) - rest_.edge_vectors.row(e)).squaredNorm();
                });
    sum.transform = add_up(rest_.triangles.rows(), [&](Eigen::Index t) { return transform_term(t); });
    sum.normal = rest_.normal_weight * add_up(rest_.triangles.rows(), [&](Eigen::Index t) { return normal_term(t); });
    sum.transform_normal = add_up(rest_.triangles.rows(), [&](Eigen::Index t) { return transform_normal_term(t); });
    sum.sphericity = add_up(rest_.triangles.rows(), [&](Eigen::Index t) {
      return sphericity_term(t, [&](int from, int to) -> Vector3d {
        return positions.row(rest_.triangles(t, to)) - positions.row(rest_.triangles(t, from));
      });
    });
    sum.transform_sphericity = rest_.transform_sphericity_factor * add_up(rest_.triangles.rows(), [&](Eigen::Index t) {
                                 return sphericity_term(t, [&](int from, int to) -> Vector3d {
                                   return matrix(transforms_, t) * rest_side(t, from, to);
                                 });
                               });
    sum.connect = rest_.connect_weight * add_up(rest_.pairs.rows(), [&](Eigen::Index p) {
                    const int e = rest_.pair_edges[p];
                    return pair_term(p, rest_.edge_vectors.row(e).transpose() / rest_lengths_[e]);
                  });
    sum.similarity = add_up(rest_.pairs.rows(), [&](Eigen::Index p) {
      return rest_.pair_similarities[p] * pair_term(p, rest_.pair_opposites.row(p));
    });
    sum.regularizer = rest_.regularizer_weight * add_up(rest_.triangles.rows(), [&](Eigen::Index t) {
                        return (matrix(transforms_, t) - Matrix3d::Identity()).squaredNorm();
                      });
    sum.regularizer += rest_.normal_regularizer_weight * add_up(rest_.triangles.rows(), [&](Eigen::Index t) {
                         const Vector3d normal = rest_.normals.row(t);
                         return (matrix(transforms_, t) * normal - normal).squaredNorm();
                       });
    return sum;
  }

  /// Eq. 20.
  double transform_term(Eigen::Index t) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const int e = rest_.triangle_edges(t, k);
      const Vector3d mapped = matrix(inverses_, t) * vectors_.row(e).transpose();
      sum += length_weights_[e] * ((mapped - rest_.edge_vectors.row(e).transpose()) / rest_lengths_[e]).squaredNorm();
    }
    return sum;
  }

  /// Eq. 21 with the current length for the target length.
  double normal_term(Eigen::Index t) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const int e = rest_.triangle_edges(t, k);
      const double tilt = rest_.normals.row(t).dot(vectors_.row(e)) / vectors_.row(e).norm();
      sum += length_weights_[e] * rest_lengths_[e] / rest_.mean_edge_length * tilt * tilt;
    }
    return sum;
  }

  /// Eq. 26 without its weights.
  double transform_normal_term(Eigen::Index t) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const int e = rest_.triangle_edges(t, k);
      const Vector3d mapped = matrix(transforms_, t) * rest_.edge_vectors.row(e).transpose() / rest_lengths_[e];
      sum += std::pow(mapped.dot(rest_.normals.row(t)), 2);
    }
    return sum;
  }

  Vector3d rest_side(Eigen::Index t, int from, int to) const {
    return rest_.vertices.row(rest_.triangles(t, to)) - rest_.vertices.row(rest_.triangles(t, from));
  }

  /// Eq. 18 or 27: `side` gives the edited side of two corners.
  template <typename Side>
  double sphericity_term(Eigen::Index t, const Side& side) const {
    if (rest_.sphericities[t] == 0) return 0;
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Vector3d ij = rest_side(t, i, j), ik = rest_side(t, i, k);
      const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(ik, ij);
      sum += (side(i, j) / ij.norm() - turn * (side(i, k) / ik.norm())).squaredNorm();
    }
    return rest_.sphericities[t] * sum;
  }

  double pair_term(Eigen::Index p, const Vector3d& direction) const {
    return ((matrix(transforms_, rest_.pairs(p, 0)) - matrix(transforms_, rest_.pairs(p, 1))) * direction)
        .squaredNorm();
  }

  /// A sum that any number of threads adds up in the same order: blocks side by side, then one after the other.
  template <typename Term>
  static double add_up(Eigen::Index count, const Term& term) {
    constexpr Eigen::Index kBlock = 1024;
    Eigen::VectorXd sums = Eigen::VectorXd::Zero((count + kBlock - 1) / kBlock);
#pragma omp parallel for schedule(static) if (count > kWorthThreads)
    for (Eigen::Index b = 0; b < sums.size(); ++b) {
      double sum = 0;
      for (Eigen::Index i = b * kBlock; i < std::min(count, (b + 1) * kBlock); ++i) sum += term(i);
      sums[b] = sum;
    }
    double total = 0;
    for (const double sum : sums) total += sum;
    return total;
  }

  std::shared_ptr<const Rest> shared_rest_;
  const Rest& rest_;
  std::vector<int> first_triangles_, triangles_of_edges_;
  Eigen::VectorXd rest_lengths_;
  Eigen::VectorXd length_weights_;
  Transforms transforms_;
  Transforms inverses_;
  Positions vectors_;
};

}  // namespace

std::unique_ptr<TransformStep> cpu_transform(std::shared_ptr<const TransformStep::Rest> rest) {
  return std::make_unique<CpuTransform>(std::move(rest));
}

}  // namespace swage

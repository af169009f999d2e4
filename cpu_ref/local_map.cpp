// Maps of neighbourhoods by Eigen.
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "cpu_steps.h"
#include "procrustes.h"

namespace swage {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kStraight = 1e-9;  // Across a line whose edges spread less than this part, nothing is told.

Matrix3d across(const Vector3d& normal) { return Matrix3d::Identity() - normal * normal.transpose(); }

Matrix3d shortest_rotation(const Vector3d& from, const Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

class CpuLocalMap final : public LocalMapStep {
 public:
  explicit CpuLocalMap(const Rest& rest) : rest_(rest) {}

  void fit(const Positions& positions, const Positions& normals, Transforms& maps) override {
    const Eigen::Index count = element_count(rest_.pairs);
    check_rows("LocalMapStep::fit", "positions", positions.rows(), rest_.pairs.vertices.rows());
    check_rows("LocalMapStep::fit", "normals", normals.rows(), count);
    const bool smooths = !rest_.neighbours.empty();
    if (smooths) check_rows("LocalMapStep::fit", "maps", maps.rows(), count);
    const Transforms last = smooths ? maps : Transforms();
    maps.resize(count, 9);
#pragma omp parallel for schedule(static)
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vector3d rest_normal = rest_.pairs.normals.row(i), normal = normals.row(i);
      Matrix3d image = edge_covariance(rest_.pairs, positions, i);
      Matrix3d spread = edge_covariance(rest_.pairs, rest_.pairs.vertices, i);
      if (smooths) add_neighbours(i, normals, last, image, spread);
      const Matrix3d plane = across(rest_normal);
      Eigen::JacobiSVD<Matrix3d> solver(plane * spread * plane, Eigen::ComputeFullU | Eigen::ComputeFullV);
      solver.setThreshold(kStraight);
      const Matrix3d flat = solver.solve(plane * image.transpose() * across(normal)).transpose();
      Eigen::Map<RowMajor3d>(maps.row(i).data()) = normal * rest_normal.transpose() + flat;
    }
  }

 private:
  void add_neighbours(Eigen::Index i, const Positions& normals, const Transforms& last, Matrix3d& image,
                      Matrix3d& spread) const {
    const auto at = static_cast<size_t>(i);
    for (int k = rest_.offsets[at]; k < rest_.offsets[at + 1]; ++k) {
      const int j = rest_.neighbours[static_cast<size_t>(k)];
      const Eigen::Map<const RowMajor3d> map(last.row(j).data());
      const Matrix3d turned = shortest_rotation(normals.row(j), normals.row(i)) * map *
                              shortest_rotation(rest_.pairs.normals.row(i), rest_.pairs.normals.row(j));
      image += rest_.smoothing[k] * turned;
      spread += rest_.smoothing[k] * Matrix3d::Identity();
    }
  }

  Rest rest_;
};

}  // namespace

std::unique_ptr<LocalMapStep> cpu_local_map(const LocalMapStep::Rest& rest) {
  return std::make_unique<CpuLocalMap>(rest);
}

}  // namespace swage

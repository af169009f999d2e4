// How much faces curve along the axes.
#pragma once

#include <vector>

#include "cancel.h"
#include "neighbourhoods.h"
#include "pieces.h"
#include "swage/backend.h"

namespace swage {

/// Of a surface at a point, k1 d1 d1ᵀ + k2 d2 d2ᵀ from its principal curvatures and directions: xx, xy, xz, yy, yz, zz.
/// In single precision: a few digits say all.
using CurvatureTensor = Eigen::Matrix<float, 1, 6>;
using CurvatureTensors = Eigen::Matrix<float, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// |k(u)| for each axis u, of a surface of this unit normal: along u projected onto it, or the largest of all where u
/// is within a degree of the normal.
Eigen::RowVector3d curvatures_along(const CurvatureTensor& tensor, const Eigen::RowVector3d& normal);

/// How vertices of a mesh curve, cut along its creases. `diagonal`: of its box.
class FaceCurvatures {
 public:
  FaceCurvatures(Pieces pieces, double diagonal, const Backend& backend, const Poll& poll);
  FaceCurvatures(const FaceCurvatures&) = delete;
  FaceCurvatures& operator=(const FaceCurvatures&) = delete;

  /// Along each axis: the mean over the triangle's corners, of a large one as far as normals turn over it at all; 0
  /// where it has no area.
  Eigen::RowVector3d along_axes(Eigen::Index triangle) const;

 private:
  void fit(const Backend& backend, const Poll& poll);
  void smooth(const Poll& poll);
  CurvatureTensor by_normals(Eigen::Index triangle, const Eigen::RowVector3d& normal) const;

  Pieces pieces_;
  double diagonal_;
  Neighbourhoods near_;
  CurvatureTensors tensors_;  ///< Of the vertices of the pieces.
};

}  // namespace swage

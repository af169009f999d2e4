// The local steps: what is asked of each, whoever does it. A step owns what never changes; a call brings what does.
// Results must not share memory with what a call brings: devices may read the one while they write the other.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "swage/error.h"
#include "swage/mesh.h"
#include "swage/protective_grid.h"
#include "swage/tape.h"

#pragma GCC visibility push(default)
namespace swage {

/// Throws InvalidInput where an argument of a step has other rows than the step's rest shape. Every step asks this of
/// what a call brings.
inline void check_rows(const char* function, const char* argument, Eigen::Index rows, Eigen::Index due) {
  if (rows == due) return;
  throw InvalidInput(std::string(function) + ": " + argument + ": " + std::to_string(rows) +
                     " rows, but the step has " + std::to_string(due));
}

/// #T × 9: a 3 × 3 matrix a row, row by row.
using Transforms = Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor>;

/// Reshaping, per triangle and edge (reshape.h; paper sections 3.3 and 4.2). From transforms: their inverses, target
/// lengths, and the quadratic that the vertex step minimises. From positions: length weights, the transform step's
/// right-hand sides, and the energy.
class TransformStep {
 public:
  /// The rest shape, in the unit box.
  struct Rest {
    Triangles triangles;
    Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor> edges;           ///< #E × 2 vertices.
    Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor> triangle_edges;  ///< #T × 3: k joins corners k and k + 1.
    Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor> pairs;           ///< #P × 2 triangles beside one edge.
    Eigen::VectorXi pair_edges;                                             ///< #P: that edge.
    Positions edge_vectors;                                                 ///< #E × 3, second vertex minus first.
    Positions normals;                                                      ///< #T × 3, unit.
    Positions pair_opposites;                    ///< #P × 3: unit vector between the vertices opposite the edge.
    Eigen::VectorXd pair_similarities;           ///< #P: similarity weight.
    Eigen::VectorXd sphericities;                ///< #T: sphericity weight (Gamma).
    Positions vertices;                          ///< #V × 3, whose triangles' corners the sphericity term compares.
    Eigen::VectorXd length_weights;              ///< #E to start with, or empty: from the rest lengths (eq. 6).
    Eigen::VectorXd target_lengths;              ///< #E to keep, or empty: from the transforms.
    double mean_edge_length = 0;                 ///< L_avg
    double normal_weight = 0, scale_weight = 0;  ///< Of the vertex step.
    double connect_weight = 0, transform_normal_weight = 0, regularizer_weight = 0;  ///< Of the transform step.
    double normal_regularizer_weight = 0;    ///< The same: of |T n - n|², which counts as part of the regularizer.
    bool maps_normals = false;               ///< Whether what the vertex step inverts takes a triangle's normal to its
                                             ///< image's, as long as the image's mean stretch, wherever T takes it.
    bool weighs_targets = false;             ///< Whether length weights are those of target lengths, whatever length
                                             ///< edges were last placed with. `length_weights` are then unread.
    double transform_sphericity_factor = 1;  ///< Times the sphericity weight: of the transform step.
  };

  /// For each edge e the quadratic e' B e - 2 c' e of the transform, normal and scale terms, e the edge's vector.
  struct EdgeQuadratics {
    Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> blocks;  ///< #E × 6: B as xx, xy, xz, yy, yz, zz.
    Positions right_hand_sides;                                        ///< #E × 3: c.
    Eigen::VectorXd target_lengths;                                    ///< #E
    int singular = 0;  ///< Triangles whose transform is too near singular to invert: a damped inverse stands in.
  };

  /// Terms of the energy, weighted but for transform_normal, with current lengths in place of target lengths.
  struct Energy {
    double transform = 0, normal = 0, scale = 0, sphericity = 0;                    ///< Of the vertex step.
    double connect = 0, similarity = 0, transform_sphericity = 0, regularizer = 0;  ///< Of the transform step.
    double transform_normal = 0;                                                    ///< The same, without its weight.
  };

  virtual ~TransformStep() = default;

  /// Back to the length weights it started with.
  virtual void reset() = 0;

  /// Keeps the transforms and gives the vertex step's quadratics.
  virtual void fit_edges(const Transforms& transforms, EdgeQuadratics& quadratics) = 0;

  /// Gives the right-hand sides of the transform step (#T × 9) and the energy of the positions with the transforms
  /// kept, under the length weights they were placed with. Then takes new length weights from the positions, unless
  /// those are of target lengths.
  virtual Energy fit_transforms(const Positions& positions, Transforms& right_hand_sides) = 0;
};

/// The same matrix as a product, for solves that do not store it: the transform step's left-hand side (the terms of
/// eq. 35), connect and similarity across edges and each triangle's own 9 × 9 block.
class CouplingStep {
 public:
  virtual ~CouplingStep() = default;
  /// product = matrix · transforms, both #T × 9 and not the same.
  virtual void apply(const Transforms& transforms, Transforms& product) = 0;
};

/// Elements (vertices, triangles, tetrahedra: whatever they are) with the pairs of vertices whose edges each fits, and
/// optionally a normal each. The rest side of what rotation and similarity fit.
struct PairsRest {
  Positions vertices;        ///< #V × 3.
  std::vector<int> offsets;  ///< #N + 1: pairs of element n stand at offsets[n] .. offsets[n + 1].
  Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor> pairs;  ///< #P × 2 vertices: an edge from first to second.
  Eigen::VectorXd weights;                                       ///< #P, of any sign (cotangents).
  Positions normals;                                             ///< #N × 3 unit, or no rows: no normal term.
  Eigen::VectorXd normal_weights;                                ///< #N, or none.
};

/// Closest rotations of weighted vector pairs (orthogonal Procrustes). For each element the rotation R, det R = 1, that
/// minimises sum_p w_p |R a_p - b_p|² + w_n |R n - t|², with a the rest edge, b the edge now, n the rest normal and t
/// the target of the normal. A target may have any length, which multiplies its weight: the rotation that brings n
/// nearest to t brings it nearest to t's direction. Where several rotations are equally good (flat, straight or empty
/// elements), one of them. Scale-free. Never a reflection, never NaN for finite input.
class RotationStep {
 public:
  virtual ~RotationStep() = default;
  /// `targets`: #N × 3, or no rows where the rest has no normals. Gives #N × 9 rotations.
  virtual void fit(const Positions& positions, const Positions& targets, Transforms& rotations) = 0;
};

/// Closest similarities (isotropic Procrustes): as RotationStep, for s R with s >= 0 in place of R in the edges' terms,
/// R alone in the normal's. R is the closest rotation, then s = (sum_p w_p b_p · R a_p) / (sum_p w_p |a_p|²), clamped
/// to 0 below; 1 where the denominator vanishes.
class SimilarityStep {
 public:
  virtual ~SimilarityStep() = default;
  /// Gives #N × 9 matrices s R.
  virtual void fit(const Positions& positions, const Positions& targets, Transforms& similarities) = 0;
};

/// Principal curvatures, per vertex, of the quadric that fits its neighbours (curvature.h).
class CurvatureStep {
 public:
  struct Rest {
    Positions positions;
    Positions normals;            ///< #V × 3, unit: the quadric is a height over the plane they are normal to.
    std::vector<int> offsets;     ///< #V + 1: neighbours of v stand at offsets[v] .. offsets[v + 1].
    std::vector<int> neighbours;  ///< Vertices, v itself left out.
  };

  virtual ~CurvatureStep() = default;

  /// #V × 2, k1 >= k2, 1 / unit of the positions. The flattest fitting quadric counts where its neighbours leave one
  /// coefficient undetermined; 0 where more are, or there are fewer than five neighbours.
  virtual void fit(Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& curvatures) = 0;
  /// With `directions`, #V × 3: a unit vector along the surface in which it curves by k1; any, or 0, where both are the
  /// same.
  virtual void fit(Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& curvatures, Positions& directions) = 0;
};

/// Principal directions of the normals around each vertex (stylize.h; paper appendix E): of the second moment
/// sum_t a_t n_t n_tᵀ about the origin, over the triangles t around, a_t their areas and n_t their unit normals.
class NormalFitStep {
 public:
  struct Rest {
    std::vector<int> offsets;    ///< #V + 1: triangles around v stand at offsets[v] .. offsets[v + 1].
    std::vector<int> triangles;  ///< In [0, triangle_count).
    int triangle_count = 0;
  };

  virtual ~NormalFitStep() = default;

  /// `area_vectors`: #T × 3, a normal each, twice as long as the triangle's area; any unit, some may vanish. Gives
  /// `directions`, #V × 9: three rows, unit and at right angles, in order of `spreads`, #V × 3: the eigenvalues,
  /// ascending, in the unit of areas; 0 of vertices without triangles. Of equal spreads the directions are any.
  virtual void fit(const Positions& area_vectors, Transforms& directions, Positions& spreads) = 0;
};

/// The closest of a style's normals (stylize.h: ClosestNormals, and sphere maps by the nearest point).
class ClosestNormalStep {
 public:
  virtual ~ClosestNormalStep() = default;

  /// `units`: #N × 3, of length 1. Gives #N numbers: whose of the style's normals is at the least angle, of several
  /// equally near the first; 0 for a row of zeros.
  virtual void find(const Positions& units, Eigen::VectorXi& closest) = 0;
};

/// Maps of a surface's neighbourhoods (template_edit.h; paper eq. 13, 17): of each element the linear map that takes
/// its rest normal n to its normal now n', and the plane across n to that across n', where it fits the pairs' edges
/// best: n' nᵀ + P' (sum_p w_p b_p a_pᵀ + sum_j w_j T_j) (P (sum_p w_p a_p a_pᵀ + sum_j w_j I) P)⁺, with P = I - n nᵀ,
/// a the rest edges, b the edges now, and T_j a neighbour's last map, turned by the shortest rotations from n to its
/// rest normal and from its normal now to n'.
///
/// Normals now are those given or, where `guidance` is not infinite, of unit length those with which the maps fit best:
/// they and a map of the plane make sum_p w_p |b_p - J a_p|² + g |n' - m|² the least, with m the normal given and g
/// that part of the rest edges' spread across n.
class LocalMapStep {
 public:
  struct Rest {
    PairsRest pairs;              ///< With normals, whose weights do not matter; no weight below 0.
    std::vector<int> offsets;     ///< #N + 1: neighbours of element n stand at offsets[n] .. offsets[n + 1]. Or none.
    std::vector<int> neighbours;  ///< Elements.
    Eigen::VectorXd smoothing;    ///< Their weights, at least 0, of the unit of w |a|².
    double guidance = std::numeric_limits<double>::infinity();  ///< Above 0.
  };

  virtual ~LocalMapStep() = default;
  /// `normals`: #N × 3 unit, now or, with guidance, near those. `maps`: #N × 9, the last ones where there are
  /// neighbours; becomes the new ones.
  virtual void fit(const Positions& positions, const Positions& normals, Transforms& maps) = 0;
};

/// What is known of a template's field at points.
struct FieldValues {
  Eigen::VectorXd values;                                                                ///< #P: negative inside.
  Positions gradients;                                                                   ///< #P × 3, in space.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_parameters;  ///< #P × #parameters.
};

/// How much of it is asked for.
enum class FieldDerivatives { none, in_space, all };

/// A template's field (template.h): its tape run at points, with the derivatives of every instruction.
class FieldStep {
 public:
  virtual ~FieldStep() = default;
  /// `parameters`: as many as the tape has. What is not asked for is left as it is.
  virtual void evaluate(const Positions& points, const Eigen::VectorXd& parameters, FieldDerivatives derivatives,
                        FieldValues& field) = 0;
};

/// Of a list those from `first` to `end`, the latter left out: long ones can be asked for in parts.
struct Slice {
  Eigen::Index first, end;

  Eigen::Index count() const { return end - first; }
};

/// Resizing, per triangle and vertex (resize.h; paper sections 4 and 5): how far scaling takes triangles off their
/// surface, which cells of a grid they touch, and where the grid takes the vertices.
class CarryStep {
 public:
  struct Rest {
    std::shared_ptr<const Mesh> mesh;  ///< Not null, with finite positions.
    /// #T × 3: side 3 t + k of triangle t runs from its corner k to corner k + 1. Of each the next along its edge, in
    /// a ring; a side alone is its own next. No rows: slippage is not asked for.
    Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor> next_sides;
  };

  /// Sides along an edge, after one, that a triangle sees.
  static constexpr int kMostBeside = 64;
  /// Of the longest side, the height up to which a triangle has no normal: such have no slippage, and count nowhere.
  static constexpr double kLeastHeight = 1e-5;

  virtual ~CarryStep() = default;

  /// A row a triangle of the slice: for each axis u the mean of |n' · u| over its three sides and all sides beside
  /// those, n' the normal of a side's triangle, as wound here. Weights: the side's length times max(0, n · n').
  virtual void slippage(Slice triangles, AxisValues& means) = 0;

  /// How many of the grid's cells each triangle of the slice touches: by any common point, on boundaries as within.
  /// Up to rounding: all cells that are touched, none that a cell wider by cell_rounding() to all sides would not be.
  virtual void count_cells(const GridShape& shape, Slice triangles, Eigen::VectorXi& counts) = 0;
  /// Which: of each triangle of the slice, after those of the one before, ascending. `counts`: of the same slice.
  virtual void list_cells(const GridShape& shape, Slice triangles, const Eigen::VectorXi& counts,
                          Eigen::VectorXi& cells) = 0;
  /// In parts of a cell's width: no more than a millionth of the box, and more than rounding does to it far off.
  virtual double cell_rounding(const GridShape&) const { return 1e-6; }

  /// #V × 3: where the trilinear map of its cell takes each vertex; one outside goes as its nearest cell's map,
  /// continued. `grid`: the grid's vertices, #(nx+1)(ny+1)(nz+1) × 3. Along an axis in which the grid has no extent
  /// vertices keep their distance from it.
  virtual void carry(const GridShape& shape, const AxisValues& grid, Positions& carried) = 0;
};

}  // namespace swage
#pragma GCC visibility pop

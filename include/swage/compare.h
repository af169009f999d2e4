// What an edit did to a surface, in numbers.
#pragma once

#include <numbers>
#include <optional>
#include <vector>

#include "swage/handles.h"
#include "swage/mesh.h"
#include "swage/report.h"

#pragma GCC visibility push(default)
namespace swage {

struct CompareOptions {
  double crease_angle = std::numbers::pi * 145 / 180;  ///< Interior dihedral angle, radians, [0, pi]: across sharper
                                                       ///< edges the surface is not smooth.
  std::vector<std::vector<int>> straight_chains;       ///< Chains of vertices that were straight; ReshapeOptions.
  std::optional<Gesture> gesture;                      ///< What was asked for.
  int crossing_limit = 1'000'000;                      ///< At least 0: pairs of crossing triangles searched for.
};

/// Of a number over the surface, weighted by area at rest, so that it does not depend on the triangles.
struct Spread {
  double mean = 0;
  double percentile_95 = 0;  ///< Of 95 % of the area the number is no larger.
  double max = 0;
};

/// #T each; NaN where there is nothing to measure: a triangle without area, before or after; for slippage_loss one
/// whose vertices have too few smooth neighbours.
struct FaceChanges {
  Eigen::VectorXd turn;           ///< Radians, [0, pi], between the normals before and after.
  Eigen::MatrixX2d stretches;     ///< #T × 2: singular values of the triangle's map within its plane, larger first.
  Eigen::VectorXd uneven;         ///< ln(s1 / s2), scale that is not uniform: 0 where the triangle keeps its shape.
  Eigen::VectorXd shear;          ///< Radians, [0, pi): the most by which the angle between two directions changes,
                                  ///< 2 asin((s1 - s2) / (s1 + s2)).
  Eigen::VectorXd size;           ///< ln sqrt(s1 s2): 0 where the triangle keeps its area.
  Eigen::VectorXd slippage_loss;  ///< See compare().
};

/// A smooth part of the rest surface, bounded by creases, that is a sphere, a cylinder or a cone to 1 % of its radius.
struct RoundPart {
  bool is_sphere = false;
  int first_triangle = 0;  ///< The lowest of its triangles.
  int triangles = 0;       ///< How many it has.
  double area = 0;         ///< At rest, mesh units squared.
  double radius = 0;       ///< At rest, mesh units; the mean one.
  /// Out of round: root mean square, in mean radii, of what its vertices' distances from the centre or axis that fit
  /// best differ from a constant (sphere) or from one whose square is quadratic along the axis.
  double before = 0, after = 0;
};

struct Comparison {
  Spread turn, uneven, shear;  ///< FaceChanges'.
  Spread size;                 ///< Of the magnitude of FaceChanges::size.
  Spread slippage_loss;
  double slippage_measured = 0;                        ///< The part of the area where it could be, [0, 1].
  double area_before = 0, area_after = 0;              ///< Mesh units squared.
  std::optional<double> volume_before, volume_after;   ///< Where the mesh is closed and consistently oriented.
  int flipped = 0;                                     ///< Triangles turned by more than a right angle.
  int collapsed = 0;                                   ///< Triangles without area after that had one before.
  std::optional<int> crossings_before, new_crossings;  ///< Pairs of triangles; none where beyond the limit.
  std::vector<RoundPart> round_parts;                  ///< By first triangle.
  std::optional<double> out_of_round;                  ///< What RoundPart::after is above before, mean over their area.
  std::optional<double> bend_before, bend_after;       ///< Of straight chains: the farthest that a vertex strays from
                                                       ///< the line between its chain's ends, in diagonals at rest.
  std::optional<double> handle_error;                  ///< Largest miss of a target, in diagonals at rest.
  FaceChanges faces;
  bool complete = true;  ///< False where `progress` ended it: what comes later in this list is not measured then.
};

/// Measures the map that takes the triangles of `rest` to those of `edit`.
///
/// Slippage loss tells how a smooth surface's map changes from place to place: a plane, cylinder or other surface that
/// slides along itself goes on doing so where the map's linear part is everywhere the same. At each vertex, over the
/// tangent plane with coordinates p, rest height h and edited positions y are fitted by quadratics in p to two rings
/// of smooth neighbours; the loss is D |d²y/dp² - c d²h/dp²| (Frobenius), with D the diagonal of the rest box and c
/// the image of the normal that makes it least, no longer than 10 times the vertex's larger stretch. It is 0 of every
/// linear map, whatever the surface, and D / r of a plane rolled to a cylinder of radius r. A triangle's is the mean
/// of its vertices'.
///
/// `progress` is asked between the parts of it, about every second at a million triangles.
/// Throws InvalidInput as check() does for either mesh, where they differ in vertices or all of `rest` are at one
/// place, for an option out of its range, a chain of vertices that do not exist, and as check(gesture, ...) does.
Comparison compare(const PositionsRef& rest, const PositionsRef& edit, const TrianglesRef& triangles,
                   const CompareOptions& options = {}, const ProgressFn& progress = {});

}  // namespace swage
#pragma GCC visibility pop

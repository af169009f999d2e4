// Lines that a person sees on a surface: feature edges, and straight chains of them.
#pragma once

#include <numbers>
#include <vector>

#include "swage/mesh.h"

#pragma GCC visibility push(default)
namespace swage {

/// #E × 2: the two vertices of each edge, first below second, ascending.
using FeatureEdges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// The edges where the interior dihedral angle (radians, pi where flat) is below `feature_angle`, where the surface
/// ends, and where three or more triangles meet. How triangles wind does not matter, and a triangle repeated counts
/// once. Edges are seen across triangles too flat to have a plane, lower than 1e-6 of the box diagonal; edges shorter
/// than that are none.
///
/// Throws InvalidInput as check() does, and for a feature angle outside [0, pi].
FeatureEdges feature_edges(const PositionsRef& positions, const TrianglesRef& triangles, double feature_angle);

/// The defaults find most of the chains that the paper's authors marked on their models (recall 0.76 to 1) and few
/// more on three of the four (precision 0.8); on the fourth they marked two of some twenty straight edges.
struct StraightOptions {
  double feature_angle = std::numbers::pi * 160 / 180;  ///< Interior dihedral angle, radians, [0, pi]: chains follow
                                                        ///< sharper edges.
  double turn = std::numbers::pi * 4 / 180;             ///< Radians, [0, pi / 2]: the most a chain turns at a vertex.
  double deviation = 0.003;  ///< In lengths of the chain, [0, 1]: the farthest a chain strays from the line between its
                             ///< ends; less in proportion where it is a part of a feature line that turns no more.
  double shortest = 0.05;    ///< In box diagonals, [0, 1].
};

/// Finds straight chains of feature edges, as ReshapeOptions::straight_chains takes them: of three vertices or more,
/// as long as they are straight, none closed, each edge in one at most, ascending. At a junction a chain goes on along
/// the edge that continues it straightest; at a vertex of more than 100 feature edges it ends.
///
/// Curves have none, however finely they are sampled: a part of an arc is straight only where the whole arc is, and
/// three or more straight stretches in a row, alike in length within a factor of two, that turn by less than 35 degrees
/// from one to the next are sides of a curve.
///
/// Throws InvalidInput as check() does, and for an option outside its range.
std::vector<std::vector<int>> straight_chains(const PositionsRef& positions, const TrianglesRef& triangles,
                                              const StraightOptions& options = {});

}  // namespace swage
#pragma GCC visibility pop

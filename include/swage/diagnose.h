// What is wrong or special with a mesh, in numbers.
#pragma once

#include <array>
#include <optional>

#include "swage/mesh.h"
#include "swage/report.h"

#pragma GCC visibility push(default)
namespace swage {

/// Vertices or triangles of one kind.
struct FoundElements {
  int count = 0;
  int first = -1;  ///< The lowest index; -1 where there is none.
};

/// Edges of one kind, by their two vertices; or pairs of triangles.
struct FoundPairs {
  int count = 0;
  std::array<int, 2> first{-1, -1};  ///< The lowest one found, lower index first; -1 where there is none.
};

/// A triangle that names a vertex twice is degenerate, has an angle of 0, may be a duplicate, and counts for nothing
/// else.
struct Diagnosis {
  int vertices = 0;
  int triangles = 0;
  int components = 0;         ///< Connected by common vertices. Isolated vertices left out, as in the next.
  int welded_components = 0;  ///< The same where vertices at one place are one.

  FoundPairs boundary_edges;            ///< Of one triangle.
  int boundary_loops = 0;               ///< Loops that share a vertex count as one.
  FoundPairs non_manifold_edges;        ///< Of three or more triangles.
  FoundElements non_manifold_vertices;  ///< Whose triangles form more than one fan.
  FoundPairs inconsistent_edges;        ///< Whose two triangles run along them in the same direction.
  FoundElements degenerate_triangles;   ///< Of a height up to 1e-10 of their longest side, or with a vertex twice.
  FoundElements duplicate_triangles;    ///< With an earlier one's vertices, those at one place being one.
  FoundElements duplicate_vertices;     ///< At the place of an earlier one.
  FoundElements isolated_vertices;      ///< Of no triangle.

  /// Pairs of triangles with a point in common beyond the vertex or edge they share, vertices at one place being one;
  /// exact. Duplicates are such a pair; triangles whose corners are exactly collinear take no part.
  FoundPairs self_intersections;
  bool self_intersections_complete = false;  ///< Whether these are all.

  double mean_edge = 0;  ///< Mesh units, as the next two. 0 where all triangles name a vertex twice.
  double shortest_edge = 0;
  double longest_edge = 0;
  double longest_to_mean_edge = 0;
  double smallest_angle = 0;   ///< Radians: of all triangles' corners, degenerate ones left out, as in the next.
  double low_angle = 0;        ///< Radians: the 5th percentile of each triangle's smallest angle.
  double needle_fraction = 0;  ///< Of all triangles, in [0, 1]: degenerate, or with an angle below 10 degrees.

  Eigen::Vector3d low = Eigen::Vector3d::Zero();  ///< Corner of the bounding box, mesh units, as the next.
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  std::optional<double> volume;  ///< Where the mesh is closed and consistently oriented; negative inside out.
};

/// `progress` is asked during the search for self-intersections, which lasts about two seconds at a million triangles;
/// the answer no ends that search. So do more than `crossing_limit` of them: as many are told; 0 looks for none.
/// The same for any number of threads. Throws InvalidInput as check() does, and for a limit below 0.
Diagnosis diagnose(const PositionsRef& positions, const TrianglesRef& triangles, const ProgressFn& progress = {},
                   int crossing_limit = 1'000'000);

}  // namespace swage
#pragma GCC visibility pop

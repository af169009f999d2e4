// Lengths, directions, angles and the like, of a mesh or an edit of it.
#pragma once

#include "adjacency.h"
#include "swage/mesh.h"

namespace swage {

/// #E × 3: second vertex minus first.
Positions edge_vectors(const Positions& positions, const Edges& edges);

/// #T × 3: twice the area long, along the normal.
Positions area_vectors(const Positions& positions, const Triangles& triangles);

/// Each row of length 1, but for those of length 0.
Positions normalised(Positions rows);

/// #T × 3, unit; zero where a triangle has no area.
Positions unit_normals(const Positions& positions, const Triangles& triangles);

/// #V × 3, unit: means of the triangles around, weighted by area; zero where there is none or they cancel.
Positions vertex_normals(const Positions& positions, const Triangles& triangles);

/// #V: a third of the areas of the triangles around.
Eigen::VectorXd barycentric_areas(const Positions& positions, const Triangles& triangles);

/// Radians, [0, pi], at each corner.
Eigen::Vector3d corner_angles(const Eigen::Matrix3d& corners);

/// Whether the height over the longest side is above 1e-10: below that, rounding alone may have made the normal.
bool has_area(const Positions& positions, const Eigen::RowVector3i& triangle);

/// Mean over all triangles of their three edge lengths: an interior edge counts twice. The paper's L_avg.
double mean_edge_length(const Positions& positions, const Triangles& triangles);

/// Angle between the surfaces of two triangles with these unit normals, in [0, pi], pi where flat.
double dihedral_angle(const Eigen::Vector3d& normal, const Eigen::Vector3d& other);

/// Angle in [0, pi] by which a polyline over three vertices turns at the second, 0 where straight.
double turn_at(const PositionsRef& positions, int before, int vertex, int after);

/// Where a mesh lies: subtract `corner`, divide by `extent`, and it fits the unit box.
struct UnitBox {
  Eigen::RowVector3d corner;
  double extent;

  Positions into(const PositionsRef& positions) const { return (positions.rowwise() - corner) / extent; }
  Positions back(const Positions& positions) const { return (positions * extent).rowwise() + corner; }
};

/// Throws InvalidInput where all positions are the same.
UnitBox unit_box(const PositionsRef& positions);

}  // namespace swage

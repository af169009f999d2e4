// What stylizing did to a mesh, in numbers.
#pragma once

#include "swage/mesh.h"
#include "swage/style.h"

namespace swage::test {

/// The cube's six, from the rest shape's normals or, dynamic, again and again.
ClosestNormals cube_normals(bool dynamic = true);

/// Turned about no axis of the cube: no two of its normals are as near.
Mesh askew(Mesh mesh);

/// A sphere with bumps of about so many radii.
Mesh bumpy_sphere(double height, int subdivisions = 4);

/// Largest distance of a vertex, in diagonals of the first.
double far_apart(const Positions& one, const Positions& other);

/// Degrees between triangles and the nearest of the normals, mean by area.
double mean_angle(const Mesh& mesh, const Positions& positions, const Positions& normals);

/// Share of the area within so many degrees of the nearest of the normals.
double share_near(const Mesh& mesh, const Positions& positions, const Positions& normals, double degrees);

/// Of each vertex what its angles lack of 2 pi.
Eigen::VectorXd angle_defects(const Mesh& mesh, const Positions& positions);

/// Share of vertices whose angles sum to 2 pi, to 1e-3.
double flat_share(const Mesh& mesh, const Positions& positions);

/// Least angle of any triangle, degrees.
double least_angle(const Mesh& mesh, const Positions& positions);

/// Triangles that look away from where they did.
int turned_over(const Mesh& mesh, const Positions& positions);

}  // namespace swage::test

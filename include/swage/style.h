// Styles: where the normals of a stylized shape are to point (stylize.h), and shapes to take styles from.
//
// Liu, Jacobson: Normal-Driven Spherical Shape Analogies. Computer Graphics Forum 40(5), 2021.
// Sphere maps: Kazhdan, Solomon, Ben-Chen: Can Mean-Curvature Flow be Modified to be Non-singular? SGP 2012.
#pragma once

#include <variant>

#include "swage/mesh.h"

#pragma GCC visibility push(default)
namespace swage {

/// To the nearest of a few directions, those that a simple style's faces have.
struct ClosestNormals {
  Positions normals;    ///< #N × 3, of any length above 0; at least one.
  bool dynamic = true;  ///< Whether the nearest is looked up again after each pass, or once, from the rest shape.
};

/// A direction for each vertex or triangle of the shape itself.
struct GivenNormals {
  Positions normals;          ///< #V × 3 or #T × 3, of any length; of length 0 where any direction will do.
  bool of_triangles = false;  ///< Whether they are triangles'. Energies of vertices take the mean around each.
};

/// The analogy of a sphere and a style: where the rest shape's normal meets the sphere, the style's normal.
struct SphereMap {
  Positions directions;  ///< #S × 3, unit: points of the sphere.
  Triangles triangles;   ///< Of these points; they cover the sphere once, seen counter-clockwise from outside.
  Positions normals;     ///< #S × 3, unit: the style's at each point.
  bool nearest = false;  ///< Whether the nearest point's normal is taken, as the authors' program does, not one
                         ///< between those of the triangle that is met. `triangles` may then be empty.
};

/// To where the normals around each vertex lie in a plane or a line: a surface that unrolls without stretching but for
/// creases. As the paper has it for StylizeEnergy::farap and a lambda of 1000.
struct Developable {
  double tau = 0.25;  ///< At least 0: where the second spread of the normals around a vertex is a smaller part of all
                      ///< three than so many times the mean at rest, they are to be one, else to lie in a plane. So
                      ///< it does not depend on how fine a mesh is. 0 bends wherever it can, 1 makes few creases.
  double threshold = 0;  ///< Above 0 in place of tau: the second spread itself, mesh units squared, of twice the
                         ///< areas, as the authors' program compares it.
};

using Style = std::variant<ClosestNormals, GivenNormals, SphereMap, Developable>;

/// The distinct normals of a mesh's triangles, farther apart than `tolerance`, degrees. Throws InvalidInput where
/// check(positions, triangles) does or no triangle has an area.
ClosestNormals closest_normals(const Mesh& style, double tolerance = 1e-3);

/// A style that flows to a sphere by conformalised mean curvature flow. Throws InvalidInput where check(positions,
/// triangles) does, and Unsolvable where the style is not one closed surface without holes or tunnels, or the flow does
/// not reach a sphere within 300 steps.
SphereMap sphere_map(const Mesh& style, bool nearest = false);

/// Closed convex shapes about the origin, of radius 1 to their vertices.
enum class StyleShape { tetrahedron, cube, octahedron, dodecahedron, icosahedron };
Mesh style_shape(StyleShape shape);

/// A right prism about the z axis over a regular polygon of `sides`, at least 3, half as high as wide: z = -1/2 .. 1/2.
/// Throws InvalidInput.
Mesh prism(int sides);

/// Two pyramids over a regular polygon of `sides`, at least 3, tips at z = -1 and 1. Throws InvalidInput.
Mesh bipyramid(int sides);

/// A cube [-1, 1]³ with edges rounded by `radius`, in (0, 1], its sides of `cells` × `cells` squares, at least 2.
/// Throws InvalidInput.
Mesh rounded_cube(double radius = 0.3, int cells = 20);

}  // namespace swage
#pragma GCC visibility pop

// The shapes that tests run on, generated.
#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <string>

#include "swage/handles.h"
#include "swage/mesh.h"

namespace swage::test {

inline constexpr double kDegree = std::numbers::pi / 180;

/// About no axis of the coordinates.
inline const Eigen::Matrix3d kTurn =
    Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.3, 1, -0.4).normalized()).toRotationMatrix();

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

/// A closed sphere from an icosahedron subdivided `subdivisions` times.
Mesh sphere(double radius = 1, int subdivisions = 3);
/// A closed cylinder about the y axis with caps, 0 <= y <= height. Well-shaped where segments / rings suits the size.
Mesh cylinder(double radius = 0.5, double height = 1, int segments = 32, int rings = 10);
/// A torus about the z axis.
Mesh torus(double major_radius = 1, double minor_radius = 0.4, int major_segments = 48, int minor_segments = 24);
/// A closed axis-aligned box from the origin, each side of `cells` × `cells` squares.
Mesh box(const Eigen::Vector3d& size = {1, 1, 1}, int cells = 4);
/// An open square sheet [0, 1]² at z = 0.
Mesh sheet(int cells = 8);

/// Each triangle in four, at the middles of its sides. Old vertices come first; the children of triangle t are 4 t to
/// 4 t + 3, the middle one last.
Mesh subdivided(const Mesh& mesh);

/// Holds the lowest vertex and moves the highest.
Gesture move_top(const Mesh& mesh, const Eigen::Vector3d& by);

/// All triangles of both, b's vertices after a's.
Mesh joined(const Mesh& a, const Mesh& b);
Mesh transformed(const Mesh& mesh, double scale, const Eigen::Vector3d& translation);

/// Three sheets that share an edge, one of them wound the other way, with a triangle twice, one without area, and a
/// vertex of none.
Mesh awkward();

/// Enclosed by a closed mesh; negative where it winds inside out.
double volume(const Mesh& mesh);

}  // namespace swage::test

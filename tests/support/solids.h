// Closed solids, to put models together from as CAD does: each part a component of its own.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "swage/mesh.h"

namespace swage::test {

/// Points of the plane, in order.
using Outline = std::vector<Eigen::Vector2d>;
/// Points of space, in order.
using Path = std::vector<Eigen::Vector3d>;

/// `steps` + 1 points of an ellipse about a centre, between two angles in radians.
Outline arc(const Eigen::Vector2d& centre, const Eigen::Vector2d& radii, double from, double to, int steps);
/// A rectangle about the origin with round corners, counter-clockwise, of `steps` each.
Outline rounded_rectangle(const Eigen::Vector2d& size, double radius, int steps);
/// Straight pieces between the points of an outline cut in `steps`.
Outline cut(const Outline& outline, int steps);

/// (radius, height) turned about the y axis. Both ends of the profile have the radius 0, or neither: then the last
/// point is joined to the first.
Mesh turned(const Outline& profile, int around);
/// A round rod along a path; flat ends, or none where the path is `closed`.
Mesh rod(const Path& path, double radius, int around, bool closed = false);
/// Through rings of as many points each; the ends are closed from their middles.
Mesh loft(const std::vector<Path>& rings);
/// An outline of the xy plane, pulled along z from -depth / 2 to depth / 2 in `steps`.
Mesh pulled(const Outline& outline, double depth, int steps = 1);
/// A box about the origin whose edges are cut off by `bevel`.
Mesh slab(const Eigen::Vector3d& size, double bevel);
/// An ellipsoid about the origin, its poles along y.
Mesh ball(const Eigen::Vector3d& radii, int around);
/// A ring about the y axis through the origin.
Mesh ring(double radius, double thickness, int around, int across);
/// A plate about the origin of `columns` × `rows` squares of a side, in the xz plane. Those that `holed` names (x
/// first) have a round hole in the middle, `around` points (a multiple of 4) each.
Mesh plate(int columns, int rows, double side, double thickness, const std::vector<Eigen::Vector2i>& holed,
           double hole_radius, int around);

Mesh placed(const Mesh& mesh, const Eigen::Affine3d& by);
Mesh moved(const Mesh& mesh, const Eigen::Vector3d& by);
/// A quarter turn about an axis, counter-clockwise.
Mesh quarter_turned(int axis, const Mesh& mesh);
/// From about the y axis to about another, 0 or 2.
Mesh about(int axis, const Mesh& mesh);

/// Vertices of a part.
struct Part {
  std::string name;
  Eigen::Index first = 0, count = 0;
};

/// A model of parts that each are one component.
struct Assembled {
  Mesh mesh;
  std::vector<Part> parts;

  /// Those whose names begin so.
  std::vector<Part> named(const std::string& beginning) const;
};

/// Collects parts.
class Assembler {
 public:
  /// `detail` times as many steps along curves as at first.
  explicit Assembler(double detail) : detail_(detail) {}

  int steps(int count) const;
  void add(const std::string& name, Mesh part);
  /// And its image at the other side of the plane z = 0, or x = 0.
  void add_mirrored(const std::string& name, const Mesh& part, int axis = 2);
  Assembled assembled() const;

 private:
  double detail_;
  std::vector<std::string> names_;
  std::vector<Mesh> meshes_;
};

}  // namespace swage::test

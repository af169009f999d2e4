// Fields of shapes, and of shapes made of others, as formulas.
//
// Distances where that is cheap, else fields of the same sign that grow about as fast near the surface.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "scalar.h"

namespace swage {

/// Flat shapes read the first two.
using Point = std::array<Scalar, 3>;
using Shape = std::function<Scalar(const Point&)>;

Scalar length(const std::vector<Scalar>& of);

// Around the origin, about the axis where they have one.
Shape sphere(Scalar radius);
Shape ellipsoid(const Point& radii);
/// `rounding`: the radius of edges, within the size.
Shape box(const Point& size, Scalar rounding);
Shape cylinder(int axis, Scalar radius, Scalar height, Scalar rounding);
Shape capsule(const Point& from, const Point& to, Scalar radius);
Shape cone(int axis, Scalar bottom, Scalar top, Scalar height);
Shape torus(int axis, Scalar radius, Scalar tube);
Shape plane(const Point& normal, Scalar offset);
/// A body whose radius runs smoothly through `radii` at `heights`, which ascend, and ends flat at the first and last.
Shape lathe(int axis, const std::vector<Scalar>& heights, const std::vector<Scalar>& radii);

// Flat.
Shape circle(Scalar radius);
Shape rectangle(Scalar width, Scalar height, Scalar rounding);
using Corner = std::array<Scalar, 2>;
Shape polygon(const std::vector<Corner>& corners);

// From flat ones: their first coordinate is along the axis after `axis`, their second along the one after that.
Shape extrude(const Shape& flat, int axis, Scalar height);
/// The first coordinate is the distance from the axis, less `offset`; the second is along it.
Shape revolve(const Shape& flat, int axis, Scalar offset);

// Edges between parts are rounded by fillets of about `radius`.
Shape unite(const std::vector<Shape>& parts, Scalar radius);
Shape intersect(const std::vector<Shape>& parts, Scalar radius);
/// The first less all others.
Shape subtract(const std::vector<Shape>& parts, Scalar radius);
Shape morph(const Shape& from, const Shape& to, Scalar weight);
Shape shell(const Shape& of, Scalar thickness);
Shape offset(const Shape& of, Scalar by);

Shape translate(const Shape& of, const Point& by);
/// `angle`: degrees, counter-clockwise seen against the direction.
Shape rotate(const Shape& of, const Point& direction, Scalar angle);
Shape scale(const Shape& of, const Point& by);
/// The part at positive coordinates, and its mirror image.
Shape mirror(const Shape& of, int axis);
/// So many copies side by side, the middle of them at the origin.
Shape repeat(const Shape& of, int axis, int count, Scalar spacing);
/// So many copies about the axis.
Shape repeat_around(const Shape& of, int axis, int count);
/// Across the axis it is scaled by `bottom` below `from`, by `top` above `to`, and in between in proportion.
Shape taper(const Shape& of, int axis, Scalar from, Scalar to, Scalar bottom, Scalar top);
/// `rate`: degrees by which it turns a unit on along the axis.
Shape twist(const Shape& of, int axis, Scalar rate);
/// The same, towards another axis.
Shape bend(const Shape& of, int axis, int towards, Scalar rate);
/// Moves it along one axis by so much a unit on along another.
Shape shear(const Shape& of, int axis, int along, Scalar amount);

}  // namespace swage

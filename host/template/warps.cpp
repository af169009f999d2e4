// Shapes moved, turned, repeated and bent: by the field at the place that goes there.
#include <cmath>
#include <cstddef>
#include <numbers>

#include "axes.h"
#include "shapes.h"

namespace swage {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Turns the plane of two axes by minus the angle, from the first towards the second.
Point turned_back(Point p, int first, int second, Scalar cosine, Scalar sine) {
  const Scalar a = p[at(first)], b = p[at(second)];
  p[at(first)] = cosine * a + sine * b;
  p[at(second)] = cosine * b - sine * a;
  return p;
}

Scalar least(const Point& of) { return min(min(of[0], of[1]), of[2]); }

}  // namespace

Shape translate(const Shape& of, const Point& by) {
  return [=](const Point& p) { return of({p[0] - by[0], p[1] - by[1], p[2] - by[2]}); };
}

/// Rodrigues' formula, by minus the angle.
Shape rotate(const Shape& of, const Point& direction, Scalar angle) {
  return [=](const Point& p) {
    const Scalar size = length({direction[0], direction[1], direction[2]});
    const Point n = {direction[0] / size, direction[1] / size, direction[2] / size};
    const Scalar cosine = cos(angle * kDegree), sine = sin(angle * kDegree);
    const Scalar dot = p[0] * n[0] + p[1] * n[1] + p[2] * n[2];
    Point turned = p;
    for (int u = 0; u < 3; ++u) {
      const std::size_t v = at(next(u)), w = at(next(next(u)));
      const Scalar cross = n[v] * p[w] - n[w] * p[v];
      turned[at(u)] = p[at(u)] * cosine - cross * sine + n[at(u)] * dot * (1 - cosine);
    }
    return of(turned);
  };
}

Shape scale(const Shape& of, const Point& by) {
  return [=](const Point& p) { return of({p[0] / by[0], p[1] / by[1], p[2] / by[2]}) * least(by); };
}

Shape mirror(const Shape& of, int axis) {
  return [=](Point p) {
    p[at(axis)] = abs(p[at(axis)]);
    return of(p);
  };
}

/// As a union: folding space would leap where copies are not symmetric.
Shape repeat(const Shape& of, int axis, int count, Scalar spacing) {
  std::vector<Shape> copies;
  copies.reserve(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    copies.emplace_back([=](Point p) {
      p[at(axis)] = p[at(axis)] - spacing * (i - 0.5 * (count - 1));
      return of(p);
    });
  }
  return unite(copies, spacing.builder->constant(0));
}

Shape repeat_around(const Shape& of, int axis, int count) {
  return [=](const Point& p) {
    Scalar result = of(p);
    for (int i = 1; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      TapeBuilder& builder = *result.builder;
      const Point turned = turned_back(p, next(axis), next(next(axis)), builder.constant(std::cos(angle)),
                                       builder.constant(std::sin(angle)));
      result = min(result, of(turned));
    }
    return result;
  };
}

Shape taper(const Shape& of, int axis, Scalar from, Scalar to, Scalar bottom, Scalar top) {
  return [=](Point p) {
    TapeBuilder& builder = *from.builder;
    const Scalar part = clamp((p[at(axis)] - from) / max(to - from, 1e-9), builder.constant(0), builder.constant(1));
    const Scalar by = mix(bottom, top, part);
    for (const int u : {next(axis), next(next(axis))}) p[at(u)] = p[at(u)] / by;
    return of(p) * min(min(bottom, top), 1);
  };
}

Shape twist(const Shape& of, int axis, Scalar rate) { return bend(of, axis, axis, rate); }

Shape bend(const Shape& of, int axis, int towards, Scalar rate) {
  const bool twists = axis == towards;
  const int first = twists ? next(axis) : axis, second = twists ? next(next(axis)) : towards;
  return [=](const Point& p) {
    const Scalar angle = p[at(axis)] * rate * kDegree;
    return of(turned_back(p, first, second, cos(angle), sin(angle)));
  };
}

Shape shear(const Shape& of, int axis, int along, Scalar amount) {
  return [=](Point p) {
    p[at(axis)] = p[at(axis)] - amount * p[at(along)];
    return of(p);
  };
}

}  // namespace swage

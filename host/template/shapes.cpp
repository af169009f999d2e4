#include "shapes.h"

#include <cstddef>

#include "axes.h"

namespace swage {
namespace {

struct AboutAxis {
  Scalar radial, along;
};

AboutAxis about(const Point& p, int axis) {
  return {length({p[at(next(axis))], p[at(next(next(axis)))]}), p[at(axis)]};
}

/// The distance from a corner: of a box whose sides the arguments are the distances of.
Scalar rounded_corner(const std::vector<Scalar>& sides, Scalar rounding) {
  std::vector<Scalar> outside;
  Scalar inside = sides[0] + rounding;
  for (const Scalar side : sides) {
    outside.push_back(max(side + rounding, 0));
    inside = max(inside, side + rounding);
  }
  return length(outside) + min(inside, 0) - rounding;
}

Scalar zero(Scalar like) { return like.builder->constant(0); }

}  // namespace

Scalar length(const std::vector<Scalar>& of) {
  Scalar sum = of[0] * of[0];
  for (std::size_t i = 1; i < of.size(); ++i) sum = sum + of[i] * of[i];
  return sqrt(sum);
}

Shape sphere(Scalar radius) {
  return [=](const Point& p) { return length({p[0], p[1], p[2]}) - radius; };
}

Shape ellipsoid(const Point& radii) {
  return [=](const Point& p) {
    const Scalar least = min(min(radii[0], radii[1]), radii[2]);
    return (length({p[0] / radii[0], p[1] / radii[1], p[2] / radii[2]}) - 1) * least;
  };
}

Shape box(const Point& size, Scalar rounding) {
  return [=](const Point& p) {
    return rounded_corner({abs(p[0]) - size[0] / 2, abs(p[1]) - size[1] / 2, abs(p[2]) - size[2] / 2}, rounding);
  };
}

Shape cylinder(int axis, Scalar radius, Scalar height, Scalar rounding) {
  return [=](const Point& p) {
    const AboutAxis q = about(p, axis);
    return rounded_corner({q.radial - radius, abs(q.along) - height / 2}, rounding);
  };
}

Shape capsule(const Point& from, const Point& to, Scalar radius) {
  return [=](const Point& p) {
    Scalar along = zero(radius), square = zero(radius);
    for (std::size_t u = 0; u < 3; ++u) {
      const Scalar way = to[u] - from[u];
      along = along + (p[u] - from[u]) * way;
      square = square + way * way;
    }
    const Scalar part = clamp(along / max(square, 1e-30), zero(radius), radius.builder->constant(1));
    std::vector<Scalar> off;
    for (std::size_t u = 0; u < 3; ++u) off.push_back(p[u] - from[u] - part * (to[u] - from[u]));
    return length(off) - radius;
  };
}

Shape cone(int axis, Scalar bottom, Scalar top, Scalar height) {
  return [=](const Point& p) {
    const AboutAxis q = about(p, axis);
    const Scalar radius = mix(bottom, top, q.along / height + 0.5);
    const Scalar slant = length({top - bottom, height});
    const Scalar side = (q.radial - radius) * (height / slant);
    // Of a flat cone the side alone hardly grows.
    return max(max(side, q.radial - max(bottom, top)), abs(q.along) - height / 2);
  };
}

Shape torus(int axis, Scalar radius, Scalar tube) {
  return [=](const Point& p) {
    const AboutAxis q = about(p, axis);
    return length({q.radial - radius, q.along}) - tube;
  };
}

Shape plane(const Point& normal, Scalar offset) {
  return [=](const Point& p) {
    const Scalar dot = p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2];
    return dot / length({normal[0], normal[1], normal[2]}) - offset;
  };
}

Shape lathe(int axis, const std::vector<Scalar>& heights, const std::vector<Scalar>& radii) {
  return [=](const Point& p) {
    const AboutAxis q = about(p, axis);
    Scalar radius = radii[0];
    for (std::size_t i = 0; i + 1 < radii.size(); ++i) {
      const Scalar part = clamp((q.along - heights[i]) / max(heights[i + 1] - heights[i], 1e-9), zero(radius),
                                radius.builder->constant(1));
      radius = radius + (radii[i + 1] - radii[i]) * (part * part * (3 - 2 * part));
    }
    const Scalar middle = (heights.front() + heights.back()) / 2, half = (heights.back() - heights.front()) / 2;
    return max(q.radial - radius, abs(q.along - middle) - half);
  };
}

Shape circle(Scalar radius) {
  return [=](const Point& p) { return length({p[0], p[1]}) - radius; };
}

Shape rectangle(Scalar width, Scalar height, Scalar rounding) {
  return [=](const Point& p) { return rounded_corner({abs(p[0]) - width / 2, abs(p[1]) - height / 2}, rounding); };
}

/// Within where a ray crosses sides an odd number of times.
Shape polygon(const std::vector<Corner>& corners) {
  return [=](const Point& p) {
    const Scalar one = p[0].builder->constant(1);
    Scalar square = p[0].builder->constant(1e30), sign = one;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Corner &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const Scalar x = b[0] - a[0], y = b[1] - a[1], u = p[0] - a[0], v = p[1] - a[1];
      const Scalar part = clamp((u * x + v * y) / max(x * x + y * y, 1e-30), zero(one), one);
      const Scalar off_x = u - part * x, off_y = v - part * y;
      square = min(square, off_x * off_x + off_y * off_y);
      const Scalar above = less(v, zero(one)), below = less(p[1], b[1]), left = less(y * u, x * v);
      const Scalar up = (1 - above) * below * left, down = above * (1 - below) * (1 - left);
      sign = sign * (1 - 2 * (up + down));
    }
    return sign * sqrt(square);
  };
}

Shape extrude(const Shape& flat, int axis, Scalar height) {
  return [=](const Point& p) {
    const Scalar inner = flat({p[at(next(axis))], p[at(next(next(axis)))], zero(height)});
    return rounded_corner({inner, abs(p[at(axis)]) - height / 2}, zero(height));
  };
}

Shape revolve(const Shape& flat, int axis, Scalar offset) {
  return [=](const Point& p) {
    const AboutAxis q = about(p, axis);
    return flat({q.radial - offset, q.along, zero(offset)});
  };
}

namespace {

Scalar smooth_min(Scalar a, Scalar b, Scalar radius) {
  const Scalar width = max(radius, 1e-9) * 4;  // As wide as a fillet of the radius between planes at right angles.
  const Scalar near = max(width - abs(a - b), 0);
  return min(a, b) - near * near / (4 * width);
}

bool is_sharp(Scalar radius) { return radius.id == zero(radius).id; }

Scalar nearer(Scalar a, Scalar b, Scalar radius) { return is_sharp(radius) ? min(a, b) : smooth_min(a, b, radius); }

}  // namespace

Shape unite(const std::vector<Shape>& parts, Scalar radius) {
  return [=](const Point& p) {
    Scalar result = parts[0](p);
    for (std::size_t i = 1; i < parts.size(); ++i) result = nearer(result, parts[i](p), radius);
    return result;
  };
}

Shape intersect(const std::vector<Shape>& parts, Scalar radius) {
  return [=](const Point& p) {
    Scalar result = -parts[0](p);
    for (std::size_t i = 1; i < parts.size(); ++i) result = nearer(result, -parts[i](p), radius);
    return -result;
  };
}

Shape subtract(const std::vector<Shape>& parts, Scalar radius) {
  return [=](const Point& p) {
    Scalar result = -parts[0](p);
    for (std::size_t i = 1; i < parts.size(); ++i) result = nearer(result, parts[i](p), radius);
    return -result;
  };
}

Shape morph(const Shape& from, const Shape& to, Scalar weight) {
  return [=](const Point& p) { return mix(from(p), to(p), weight); };
}

Shape shell(const Shape& of, Scalar thickness) {
  return [=](const Point& p) { return abs(of(p)) - thickness / 2; };
}

Shape offset(const Shape& of, Scalar by) {
  return [=](const Point& p) { return of(p) - by; };
}

}  // namespace swage

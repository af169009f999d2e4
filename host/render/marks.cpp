#include "marks.h"

#include <cmath>

#include "draw.h"
#include "text.h"

namespace swage {
namespace {

void draw_dot(Image& image, const Eigen::Vector2d& at, double radius, const Colour& colour) {
  draw_disc(image, at, 1.35 * radius, palette::kPaper);
  draw_disc(image, at, radius, colour);
}

/// With a white rim, so that it is seen on any colour. Its head is no longer than the arrow.
void draw_arrow(Image& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius) {
  const double length = (to - from).norm(), head = std::min(3.4 * radius, length), width = 0.75 * radius;
  if (length < 1) return;
  const Eigen::Vector2d along = (to - from) / length, across(-along.y(), along.x());
  const Eigen::Vector2d neck = to - head * along;
  const double rim = 0.35 * radius;
  const Eigen::Vector2d wing = 0.42 * head * across, rim_wing = wing + 1.6 * rim * across;
  draw_line(image, from, neck, width + 2 * rim, palette::kPaper);
  draw_triangle(image, to + 1.8 * rim * along, neck - rim * along + rim_wing, neck - rim * along - rim_wing,
                palette::kPaper);
  draw_line(image, from, neck + 0.1 * head * along, width, palette::kMoved);
  draw_triangle(image, to, neck + wing, neck - wing, palette::kMoved);
}

bool is_held(const HandleMark& mark) { return mark.from == mark.to; }

}  // namespace

void draw_marks(Image& image, const std::vector<HandleMark>& marks,
                const std::function<Eigen::Vector2d(const Eigen::Vector3d&)>& pixel_of, double radius) {
  for (const HandleMark& mark : marks) {
    if (!is_held(mark) && !mark.reached) draw_arrow(image, pixel_of(mark.from), pixel_of(mark.to), radius);
  }
  for (const HandleMark& mark : marks) {
    draw_dot(image, pixel_of(mark.reached ? mark.to : mark.from), radius,
             is_held(mark) ? palette::kHeld : palette::kMoved);
  }
}

double mark_radius(size_t count, double unit) {
  return unit * std::clamp(6.5 * std::pow(20.0 / static_cast<double>(std::max<size_t>(count, 1)), 0.25), 2.5, 6.5);
}

void MarkKinds::add(const std::vector<HandleMark>& marks) {
  for (const HandleMark& mark : marks) (is_held(mark) ? held : moved) = true;
}

void draw_mark_legend(Image& image, const Eigen::Vector2d& at, const MarkKinds& kinds, double unit) {
  const double radius = 5.5 * unit, size = 18 * unit;
  double x = at.x() + radius;
  const auto add = [&](const char* text, double width) {
    draw_text(image, {x + width, at.y() + 0.36 * size}, text, size, palette::kFaintText);
    x += width + text_width(text, size) + 28 * unit;
  };
  if (kinds.held) {
    draw_dot(image, {x, at.y()}, radius, palette::kHeld);
    add("held", 14 * unit);
  }
  if (kinds.moved) {
    draw_arrow(image, {x, at.y()}, {x + 38 * unit, at.y()}, radius);
    draw_dot(image, {x, at.y()}, radius, palette::kMoved);
    add("moved", 48 * unit);
  }
}

std::vector<HandleMark> handle_marks(const Gesture& gesture, const PositionsRef& rest, bool reached) {
  std::vector<HandleMark> marks;
  for (const auto& [vertex, target] : gesture.targets) marks.push_back({rest.row(vertex), target, reached});
  return marks;
}

}  // namespace swage

#include "lines.h"

#include <cmath>
#include <numeric>

#include "draw.h"
#include "swage/thrown.h"
#include "tile.h"

namespace swage {
namespace {

constexpr double kStep = 1.5;      // Pixels: along a line, every so far it is asked whether it is hidden.
constexpr int kLongest = 20'000;   // Steps.
constexpr int kPiece = 16;         // Steps drawn at a time.
constexpr float kInk = 0.85F;      // Where lines are sparse.
constexpr float kDensest = 0.25F;  // Of the surface's pixels: what is more is paler.

/// A line of the scene in pixels of the panel.
struct Stroke {
  Eigen::Vector3d start, end;  ///< In the scene.
  Eigen::Vector2d from, to;
  int steps;
};

Stroke stroke_of(const SurfaceView& view, const std::array<int, 2>& line) {
  const Positions& positions = view.scene.mesh.positions;
  Stroke stroke{positions.row(line[0]), positions.row(line[1]), {}, {}, 0};
  const Eigen::Vector2d middle(view.box.width / 2.0, view.box.height / 2.0);
  stroke.from = middle + view.camera.project(stroke.start);
  stroke.to = middle + view.camera.project(stroke.end);
  stroke.steps =
      static_cast<int>(std::clamp(std::ceil((stroke.to - stroke.from).norm() / kStep), 1.0, double(kLongest)));
  return stroke;
}

/// Of each step whether something hides its middle, a pixel before the surface.
std::vector<char> hidden_steps(const SurfaceView& view, const Stroke& stroke) {
  std::vector<Ray> rays;
  const Eigen::Vector3d before = view.camera.toward / view.camera.scale;
  for (int k = 0; k < stroke.steps; ++k) {
    const double part = (k + 0.5) / stroke.steps;
    const Eigen::Vector3d origin = (1 - part) * stroke.start + part * stroke.end + before;
    rays.push_back({origin.cast<float>(), view.camera.toward.cast<float>(), 2 * kEyeDistance});
  }
  return view.scene.rays->occluded(rays);
}

/// How much of each pixel of the panel lines cover: where several do, the most of them, so that joints are not darker.
class Mask {
 public:
  explicit Mask(const PixelBox& box) : box_(box), ink_(place(0, box.height, box.width), 0) {}

  void draw(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width) {
    visit_around(box_.width, box_.height, from, to, width / 2 + 1, [&](int x, int y) {
      const float coverage = line_coverage({x + 0.5, y + 0.5}, from, to, width);
      unsigned char& ink = ink_[place(x, y, box_.width)];
      ink = std::max(ink, static_cast<unsigned char>(std::lround(255 * coverage)));
    });
  }

  void apply(Image& image, long covered) const {
    const auto sum = static_cast<float>(std::accumulate(ink_.begin(), ink_.end(), 0L)) / 255;
    const float alpha = kInk * std::min(1.0F, kDensest * static_cast<float>(covered) / std::max(1.0F, sum));
    for (size_t i = 0; i < ink_.size(); ++i) {
      if (ink_[i] == 0) continue;
      const int x = static_cast<int>(i % static_cast<size_t>(box_.width)),
                y = static_cast<int>(i / static_cast<size_t>(box_.width));
      blend(image, box_.x + x, box_.y + y, palette::kLine, alpha * static_cast<float>(ink_[i]) / 255);
    }
  }

 private:
  PixelBox box_;
  std::vector<unsigned char> ink_;
};

/// The stretches of steps that nothing hides, in pieces, as the pixels around a long slanting one are many.
void draw_visible(Mask& mask, const Stroke& stroke, const std::vector<char>& hidden, double width) {
  const auto at = [&](int k) -> Eigen::Vector2d { return stroke.from + (stroke.to - stroke.from) * k / stroke.steps; };
  for (int k = 0; k < stroke.steps; ++k) {
    if (hidden[static_cast<size_t>(k)]) continue;
    const int first = k;
    while (k + 1 < stroke.steps && k - first < kPiece && !hidden[static_cast<size_t>(k) + 1]) ++k;
    mask.draw(at(first), at(k + 1), width);
  }
}

}  // namespace

bool draw_lines(Image& image, const SurfaceView& view, long covered, double width, const Watch& watch) {
  constexpr int kLinesATime = 8192;
  Mask mask(view.box);
  const auto count = static_cast<int>(view.scene.lines.size());
  std::vector<Stroke> strokes(kLinesATime);
  std::vector<std::vector<char>> hidden(kLinesATime);
  for (int first = 0; first < count; first += kLinesATime) {
    if (!watch.goes_on("lines", double(first) / count)) return false;
    const int last = std::min(count, first + kLinesATime);
    Thrown thrown;
#pragma omp parallel for schedule(dynamic, 64)
    for (int l = first; l < last; ++l) {
      thrown.keep([&] {
        const auto i = static_cast<size_t>(l - first);
        strokes[i] = stroke_of(view, view.scene.lines[static_cast<size_t>(l)]);
        hidden[i] = hidden_steps(view, strokes[i]);
      });
    }
    thrown.rethrow();
    for (int l = first; l < last; ++l) draw_visible(mask, strokes[size_t(l - first)], hidden[size_t(l - first)], width);
  }
  mask.apply(image, covered);
  return true;
}

}  // namespace swage

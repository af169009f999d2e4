#include "tile.h"

#include "draw.h"

namespace swage {
namespace {

constexpr int kMargin = 4;           // Pixels: as far as shadows are evened out over, and outlines are wide.
constexpr float kJump = 0.006F;      // In unit boxes: what lies farther behind is outlined against.
constexpr float kOutlineInk = 0.8F;  // Of the colour of lines.

}  // namespace

Tile::Tile(const SurfaceView& view, const PixelBox& inner)
    : view_(view),
      inner_(inner),
      outer_{inner.x - kMargin, inner.y - kMargin, inner.width + 2 * kMargin, inner.height + 2 * kMargin},
      columns_(outer_.width * view.supersampling),
      pixel_(static_cast<float>(1 / (view.camera.scale * view.supersampling))) {
  const int rows = outer_.height * view.supersampling;
  std::vector<Ray> rays;
  rays.reserve(place(0, rows, columns_));
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns_; ++x) {
      const Eigen::Vector2d at = Eigen::Vector2d(x + 0.5, y + 0.5) / view.supersampling;
      rays.push_back(view.ray_at(at + Eigen::Vector2d(outer_.x, outer_.y)));
    }
  }
  const std::vector<RayHit> hits = view.scene.rays->first_hits(rays);
  is_empty_ = std::all_of(hits.begin(), hits.end(), [](const RayHit& hit) { return hit.triangle < 0; });
  if (is_empty_) return;
  samples_.reserve(rays.size());
  for (size_t i = 0; i < rays.size(); ++i) samples_.push_back(sample_of(rays[i], hits[i]));
}

Tile::Sample Tile::sample_of(const Ray& ray, const RayHit& hit) const {
  Sample sample;
  if (hit.triangle < 0) return sample;
  const auto t = static_cast<size_t>(hit.triangle);
  const Eigen::Vector3f* corners = &view_.scene.corner_normals[3 * t];
  const Eigen::Vector3f smooth = (1 - hit.u - hit.v) * corners[0] + hit.u * corners[1] + hit.v * corners[2];
  const float side = view_.scene.normals[t].dot(ray.direction) > 0 ? -1.0F : 1.0F;
  sample.triangle = hit.triangle;
  sample.depth = kEyeDistance - hit.distance;
  sample.point = ray.origin + hit.distance * ray.direction;
  sample.flat = side * view_.scene.normals[t];
  sample.normal = side * smooth.stableNormalized();
  // A smooth normal may look away at a rim.
  const float away = sample.normal.dot(ray.direction);
  if (away > 0) sample.normal = (sample.normal - away * ray.direction).stableNormalized();
  return sample;
}

/// The one nearest to the middle that meets the surface.
const Tile::Sample* Tile::first_sample(int x, int y) const {
  const int side = view_.supersampling, middle = side / 2;
  for (int k = 0; k < side * side; ++k) {
    const int dx = (middle + k % side) % side, dy = (middle + k / side) % side;
    const Sample& candidate = sample(x * side + dx, y * side + dy);
    if (candidate.triangle >= 0) return &candidate;
  }
  return nullptr;
}

void Tile::find_ambience(const Ambience& ambience) {
  open_.resize(place(0, outer_.height, outer_.width));
  std::vector<Ray> rays;
  std::vector<Open*> owners;
  for (int y = 0; y < outer_.height; ++y) {
    for (int x = 0; x < outer_.width; ++x) {
      Open& open = open_[place(x, y, outer_.width)];
      open.at = first_sample(x, y);
      if (!open.at || view_.ambient_rays == 0) continue;
      const int pattern = ((outer_.y + y) & 7) * 8 + ((outer_.x + x) & 7);
      const std::vector<Ray> more = ambience.rays_from(open.at->point, open.at->flat, pattern);
      rays.insert(rays.end(), more.begin(), more.end());
      owners.push_back(&open);
    }
  }
  const std::vector<char> met = view_.scene.rays->occluded(rays);
  const auto count = static_cast<std::ptrdiff_t>(view_.ambient_rays);
  for (size_t i = 0; i < owners.size(); ++i) {
    const auto first = met.begin() + static_cast<std::ptrdiff_t>(i) * count;
    owners[i]->part = 1 - static_cast<float>(std::count(first, first + count, 1)) / static_cast<float>(count);
  }
}

/// Whether two samples, a few pixels apart, lie on the same part of the surface.
bool Tile::are_alike(const Sample& a, const Sample& b) const {
  return a.flat.dot(b.flat) > 0.8F && std::abs((a.point - b.point).dot(b.flat)) < 8 * pixel_;
}

/// The mean over the pixels around, each of another pattern, that lie on the same part of the surface.
float Tile::ambience_at(const Sample& sample, int x, int y) const {
  float sum = 0, weights = 0;
  for (int py = y - kMargin; py < y + kMargin; ++py) {
    for (int px = x - kMargin; px < x + kMargin; ++px) {
      const Open& open = open_[place(px, py, outer_.width)];
      if (!open.at || !are_alike(*open.at, sample)) continue;
      sum += open.part;
      weights += 1;
    }
  }
  return weights > 0 ? sum / weights : 1;
}

/// How much nearer to the eye the sample's plane is (x, y) samples on.
float Tile::slope(const Sample& sample, int x, int y) const {
  const Camera& camera = view_.camera;
  const float toward = std::max(0.02F, sample.flat.dot(camera.toward.cast<float>()));
  const Eigen::Vector3f step = (camera.right * x - camera.up * y).cast<float>();
  return -pixel_ * sample.flat.dot(step) / toward;
}

/// Whether what is (dx, dy) samples on lies behind, by more than the slopes there explain.
bool Tile::is_before(const Sample& here, int x, int y, int dx, int dy) const {
  const Sample& other = sample(x + dx, y + dy);
  if (other.triangle < 0) return true;
  const float behind = here.depth - other.depth - kJump - 4 * pixel_;
  return behind > 0 && behind + slope(here, dx, dy) > 0 && behind + slope(other, dx, dy) > 0;
}

bool Tile::is_outline(int x, int y) const {
  const Sample& here = sample(x, y);
  const int reach =
      std::min(kMargin * view_.supersampling, static_cast<int>(std::lround(view_.outline * view_.supersampling)));
  for (int d = 1; d <= reach; ++d) {
    if (is_before(here, x, y, d, 0) || is_before(here, x, y, -d, 0) || is_before(here, x, y, 0, d) ||
        is_before(here, x, y, 0, -d)) {
      return true;
    }
  }
  return false;
}

/// `middle` is the pixel's sample whose ambience is known.
Colour Tile::colour_of(int x, int y, const Open& middle) const {
  const Sample& here = sample(x, y);
  if (here.triangle < 0) return palette::kPaper;
  const float open =
      are_alike(*middle.at, here) ? middle.part : ambience_at(here, x / view_.supersampling, y / view_.supersampling);
  const Colour& own = view_.scene.colours[static_cast<size_t>(here.triangle)];
  const Colour seen = (own * light_at(view_, here.normal, open)).cwiseMin(1);
  return is_outline(x, y) ? Colour((1 - kOutlineInk) * seen + kOutlineInk * palette::kLine) : seen;
}

long Tile::paint(Image& image) const {
  const int side = view_.supersampling;
  long covered = 0;
  for (int y = kMargin; y < kMargin + inner_.height; ++y) {
    for (int x = kMargin; x < kMargin + inner_.width; ++x) {
      const Sample* first = open_[place(x, y, outer_.width)].at;
      if (!first) continue;
      ++covered;
      const Open middle{first, ambience_at(*first, x, y)};
      Colour sum = Colour::Zero();
      for (int k = 0; k < side * side; ++k) sum += colour_of(x * side + k % side, y * side + k / side, middle);
      blend(image, view_.box.x + outer_.x + x, view_.box.y + outer_.y + y, sum / static_cast<float>(side * side), 1);
    }
  }
  return covered;
}

}  // namespace swage

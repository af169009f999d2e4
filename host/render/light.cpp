#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "draw.h"
#include "surface_view.h"

namespace swage {
namespace {

constexpr float kAmbientReach = 0.35F;  // In unit boxes: nearer than that, a surface casts shadow.
constexpr float kOffSurface = 2e-4F;    // Rays start that far off what they shall not meet.
constexpr float kDarkest = 0.2F;        // Of the ambient light, what comes even into the deepest hollow.
constexpr float kBrightest = 1.1F;
constexpr float kHeatShade = 0.6F;  // Of what shading takes from colours, where they mean something.
constexpr int kPatterns = 64;

float fraction(double value) { return static_cast<float>(value - std::floor(value)); }

/// Lights from the upper left and, weaker, from the right, in the camera's axes, and the sky.
float lit(const Eigen::Vector3f& normal, float ambience) {
  static const Eigen::Vector3f kKey = Eigen::Vector3f(-0.45F, 0.70F, 0.65F).normalized();
  static const Eigen::Vector3f kFill = Eigen::Vector3f(0.85F, 0.05F, 0.50F).normalized();
  const float sky = 0.44F + 0.08F * normal.y();
  // Light from one side is blocked less than that from all.
  return sky * ambience + (0.38F * std::max(0.0F, normal.dot(kKey)) + 0.16F * std::max(0.0F, normal.dot(kFill))) *
                              (0.35F + 0.65F * ambience);
}

}  // namespace

Ambience::Ambience(int rays) : count_(rays) {
  // The R2 sequence (Roberts 2018): any stretch of it is even.
  for (int i = 0; i < kPatterns * rays; ++i) {
    const float height = fraction(0.5 + i * 0.7548776662466927), turn = fraction(0.5 + i * 0.5698402909980532);
    const float radius = std::sqrt(height), angle = 2 * std::numbers::pi_v<float> * turn;
    directions_.emplace_back(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - height));
  }
}

std::vector<Ray> Ambience::rays_from(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, int pattern) const {
  const Eigen::Vector3f across = normal.unitOrthogonal(), along = normal.cross(across);
  const Eigen::Vector3f origin = point + kOffSurface * normal;
  std::vector<Ray> rays;
  rays.reserve(static_cast<size_t>(count_));
  for (int k = 0; k < count_; ++k) {
    const Eigen::Vector3f& to = directions_[place(k, pattern, count_)];
    rays.push_back({origin, (to.x() * across + to.y() * along + to.z() * normal).normalized(), kAmbientReach});
  }
  return rays;
}

float light_at(const SurfaceView& view, const Eigen::Vector3f& normal, float ambience) {
  static const float kFacing = lit(Eigen::Vector3f::UnitZ(), 1);
  const Camera& camera = view.camera;
  const Eigen::Vector3f seen(camera.right.cast<float>().dot(normal), camera.up.cast<float>().dot(normal),
                             camera.toward.cast<float>().dot(normal));
  const float light = lit(seen, kDarkest + (1 - kDarkest) * ambience) / kFacing;
  return view.scene.is_heat_map ? std::min(1.0F, 1 - kHeatShade * (1 - light))
                                : std::min(kBrightest, light > 1 ? (1 + light) / 2 : light);
}

}  // namespace swage

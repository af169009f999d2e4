#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "framing.h"
#include "rays_embree.h"
#include "swage/error.h"
#include "tile.h"

namespace swage {
namespace {

constexpr int kGrid = 96;                                                        // Rays along each side.
constexpr std::array<double, 8> kTurns{30, -30, 55, -55, 150, -150, 125, -125};  // Degrees about up, from the front.
constexpr double kRise = 22;                                                     // Degrees above the horizon.

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

struct Candidate {
  const RayScene& rays;
  const Positions& normals;
  const std::vector<HandleMark>& handles;
  Framing framing;
};

std::vector<Ray> grid_of(const Framing& framing) {
  std::vector<Ray> rays;
  const Camera& camera = framing.camera;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const int column = i % kGrid, row = i / kGrid;
    const Eigen::Vector2d part((column + 0.5) / kGrid - 0.5, (row + 0.5) / kGrid - 0.5);
    const Eigen::Vector2d at = camera.centre + part.cwiseProduct(framing.extent);
    const Eigen::Vector3d origin = at.x() * camera.right + at.y() * camera.up + kEyeDistance * camera.toward;
    rays.push_back({origin.cast<float>(), -camera.toward.cast<float>(), 2 * kEyeDistance});
  }
  return rays;
}

/// The area seen, in unit boxes, times how various its normals are: 0 where all look one way.
double surface_score(const Candidate& candidate) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  int seen = 0;
  for (const RayHit& hit : candidate.rays.first_hits(grid_of(candidate.framing))) {
    if (hit.triangle < 0) continue;
    const Eigen::Vector3d normal = candidate.normals.row(hit.triangle);
    mean += normal.dot(candidate.framing.camera.toward) < 0 ? -normal : normal;
    ++seen;
  }
  if (seen == 0) return 0;
  const double area = candidate.framing.extent.prod() * seen / (kGrid * kGrid);
  return area * (1.2 - mean.norm() / seen);
}

/// The part of handles that nothing hides, and of the length of arrows that is in the picture's plane; 1 of none.
double handle_score(const Candidate& candidate) {
  if (candidate.handles.empty()) return 1;
  const Camera& camera = candidate.framing.camera;
  std::vector<Ray> rays;
  double length = 0, seen = 0;
  for (const HandleMark& mark : candidate.handles) {
    const Eigen::Vector3d at = into(candidate.framing.box, mark.reached ? mark.to : mark.from);
    rays.push_back({(at + 0.01 * camera.toward).cast<float>(), camera.toward.cast<float>(), 2 * kEyeDistance});
    const Eigen::Vector3d arrow = (mark.to - mark.from) / candidate.framing.box.extent;
    length += arrow.norm();
    seen += (arrow - camera.toward * camera.toward.dot(arrow)).norm();
  }
  const std::vector<char> hidden = candidate.rays.occluded(rays);
  const double open = 1 - double(std::count(hidden.begin(), hidden.end(), 1)) / double(hidden.size());
  return (0.5 + 0.5 * open) * (length > 0 ? seen / length : 1);
}

/// Where azimuth 0 is: towards z where y or x is up, towards -y where z is.
Eigen::Vector3d front_of(const Eigen::Vector3d& up) {
  const Eigen::Vector3d wanted = std::abs(up.z()) > 0.9 ? Eigen::Vector3d(0, -1, 0) : Eigen::Vector3d(0, 0, 1);
  return (wanted - up * up.dot(wanted)).normalized();
}

}  // namespace

View automatic_view(const Mesh& mesh, const std::vector<HandleMark>& handles, const Eigen::Vector3d& up) {
  const char* function = "automatic_view";
  const std::vector<Panel> panels{{mesh, {}, handles, {}, {}}};
  check_panel(panels.front(), 0, function);
  if (!up.allFinite() || !(up.norm() > 0))
    throw InvalidInput("automatic_view: up: it is zero or not finite; give a direction");
  const Eigen::Vector3d upward = up.stableNormalized(), front = front_of(upward);
  const Positions inside = unit_box(seen_positions(panels, function)).into(mesh.positions);
  const RayScene rays(inside, mesh.triangles);
  const Positions normals = unit_normals(inside, mesh.triangles);
  View best{front, upward};
  double most = -1;
  for (const double turn : kTurns) {
    const Eigen::Vector3d level = Eigen::AngleAxisd(radians(turn), upward) * front;
    const View view{std::cos(radians(kRise)) * level + std::sin(radians(kRise)) * upward, upward};
    const Candidate candidate{rays, normals, handles, framing_of(panels, view, function)};
    // People look at the front first.
    const double score = surface_score(candidate) * handle_score(candidate) * (1 + 0.12 * std::cos(radians(turn)));
    if (score > most * (1 + 1e-9)) {
      most = score;
      best = view;
    }
  }
  return best;
}

}  // namespace swage

// Stands in for host/external/rays_embree.cpp where the build leaves it out.
#include "rays_embree.h"

#include "swage/error.h"

namespace swage {
namespace {

[[noreturn]] void refuse(const char* function) {
  throw Unavailable(std::string(function) + ": this build has no Embree; configure with -DSWAGE_EMBREE=ON");
}

}  // namespace

bool has_embree() { return false; }

struct RayScene::Embree {};

RayScene::RayScene(const Positions&, const Triangles&) { refuse("RayScene"); }

RayScene::~RayScene() = default;

int RayScene::first_hit(const Eigen::Vector3d&, const Eigen::Vector3d&, double, const Accepts&) const {
  refuse("RayScene::first_hit");
}

std::vector<RayHit> RayScene::first_hits(std::span<const Ray>) const { refuse("RayScene::first_hits"); }

std::vector<char> RayScene::occluded(std::span<const Ray>) const { refuse("RayScene::occluded"); }

void RayScene::visit_near(const Eigen::Vector3d&, double, const Visit&) const { refuse("RayScene::visit_near"); }

}  // namespace swage

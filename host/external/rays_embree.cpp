#include "rays_embree.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <new>
#include <string>

#include "swage/error.h"

namespace swage {
namespace {

constexpr float kSlack = 1e-5F;  // Well above what rounding to single precision moves a point or a hit by.

/// A context that the filter finds its question in.
struct Context {
  RTCIntersectContext embree;  // First: Embree hands back its address.
  const RayScene::Accepts* accepts;
};

void filter(const RTCFilterFunctionNArguments* arguments) {
  const auto* context = reinterpret_cast<const Context*>(arguments->context);
  const auto triangle = static_cast<int>(RTCHitN_primID(arguments->hit, arguments->N, 0));
  if (!(*context->accepts)(triangle)) arguments->valid[0] = 0;
}

Context context_for(const RayScene::Accepts& accepts) {
  Context context;
  rtcInitIntersectContext(&context.embree);
  context.accepts = &accepts;
  if (accepts) context.embree.filter = filter;
  return context;
}

RTCRay embree_ray(const Ray& ray) {
  RTCRay out;
  out.org_x = ray.origin.x();
  out.org_y = ray.origin.y();
  out.org_z = ray.origin.z();
  out.tnear = 0;
  out.dir_x = ray.direction.x();
  out.dir_y = ray.direction.y();
  out.dir_z = ray.direction.z();
  out.time = 0;
  out.tfar = ray.reach;
  out.mask = std::numeric_limits<unsigned>::max();
  out.id = 0;
  out.flags = 0;
  return out;
}

RTCHit no_hit() {
  RTCHit out;
  out.geomID = RTC_INVALID_GEOMETRY_ID;
  out.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return out;
}

RTCIntersectContext context_of_neighbours() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

float rounded_up(double reach) { return static_cast<float>(std::min(reach * (1 + 1e-6), 1e30)) + kSlack; }

bool visit_one(RTCPointQueryFunctionArguments* arguments) {
  const auto& visit = *static_cast<const RayScene::Visit*>(arguments->userPtr);
  const float reach = rounded_up(visit(static_cast<int>(arguments->primID)));
  if (!(reach < arguments->query->radius)) return false;
  arguments->query->radius = reach;
  return true;
}

template <typename Scalar, typename Rows>
void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const Rows& rows) {
  // Embree's own buffer: one that is shared would have to be padded.
  auto* buffer = static_cast<Scalar*>(
      rtcSetNewGeometryBuffer(geometry, type, 0, format, 3 * sizeof(Scalar), static_cast<size_t>(rows.rows())));
  if (!buffer) throw std::bad_alloc();
  std::transform(rows.data(), rows.data() + rows.size(), buffer, [](auto value) { return static_cast<Scalar>(value); });
}

}  // namespace

bool has_embree() { return true; }

struct RayScene::Embree {
  // With as many threads as Embree likes: a smaller number would hold for all of the process's use of TBB.
  Embree() : device(rtcNewDevice(nullptr)), scene(device ? rtcNewScene(device) : nullptr) {
    if (!scene) throw std::bad_alloc();
  }
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  RTCDevice device;
  RTCScene scene;
};

RayScene::RayScene(const Positions& positions, const Triangles& triangles) : embree_(std::make_unique<Embree>()) {
  const RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcAttachGeometry(embree_->scene, geometry);
  rtcReleaseGeometry(geometry);
  fill<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, positions);
  fill<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  rtcCommitGeometry(geometry);
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  rtcCommitScene(embree_->scene);
  if (rtcGetDeviceError(embree_->device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

RayScene::~RayScene() = default;

int RayScene::first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double reach,
                        const Accepts& accepts) const {
  Context context = context_for(accepts);
  const Eigen::Vector3f to = direction.cast<float>(), from = origin.cast<float>() - kSlack * to;
  RTCRayHit ray = {embree_ray({from, to, kSlack + rounded_up(reach)}), no_hit()};
  rtcIntersect1(embree_->scene, &context.embree, &ray);
  return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1 : static_cast<int>(ray.hit.primID);
}

std::vector<RayHit> RayScene::first_hits(std::span<const Ray> rays) const {
  std::vector<RTCRayHit> traced(rays.size());
  std::transform(rays.begin(), rays.end(), traced.begin(), [](const Ray& ray) {
    return RTCRayHit{embree_ray(ray), no_hit()};
  });
  RTCIntersectContext context = context_of_neighbours();
  rtcIntersect1M(embree_->scene, &context, traced.data(), static_cast<unsigned>(traced.size()), sizeof(RTCRayHit));
  std::vector<RayHit> hits(rays.size());
  std::transform(traced.begin(), traced.end(), hits.begin(), [](const RTCRayHit& one) {
    if (one.hit.geomID == RTC_INVALID_GEOMETRY_ID) return RayHit();
    return RayHit{static_cast<int>(one.hit.primID), one.ray.tfar, one.hit.u, one.hit.v};
  });
  return hits;
}

std::vector<char> RayScene::occluded(std::span<const Ray> rays) const {
  std::vector<RTCRay> traced(rays.size());
  std::transform(rays.begin(), rays.end(), traced.begin(), embree_ray);
  RTCIntersectContext context = context_of_neighbours();
  rtcOccluded1M(embree_->scene, &context, traced.data(), static_cast<unsigned>(traced.size()), sizeof(RTCRay));
  std::vector<char> met(rays.size());
  std::transform(traced.begin(), traced.end(), met.begin(), [](const RTCRay& ray) { return ray.tfar < 0 ? 1 : 0; });
  return met;
}

void RayScene::visit_near(const Eigen::Vector3d& point, double reach, const Visit& visit) const {
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  RTCPointQuery query;
  query.x = static_cast<float>(point.x());
  query.y = static_cast<float>(point.y());
  query.z = static_cast<float>(point.z());
  query.time = 0;
  query.radius = rounded_up(reach);
  rtcPointQuery(embree_->scene, &query, &context, visit_one, const_cast<Visit*>(&visit));
}

}  // namespace swage

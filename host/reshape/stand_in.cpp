#include "stand_in.h"

#include <utility>

#include "decimate.h"
#include "swage/error.h"
#include "swage/remesh.h"

namespace swage {
namespace {

// Remeshing takes seconds for as many; what is far finer than the stand-in is decimated first.
constexpr Eigen::Index kMany = 200'000;

bool needs_one(const ReshapePlan& plan, std::string& told) {
  const ReshapeOptions& options = plan.options;
  if (options.remesh == When::never) return false;
  if (options.remesh == When::always) return true;
  if (options.unit_box_curvatures || (!options.straight_chains.empty() && !options.find_chains)) {
    told = "as given: curvatures or straight chains are given for it";
    return false;
  }
  if (badly_shaped(plan.quality)) return true;
  told = "as given: its triangles are well shaped";
  return false;
}

Mesh remeshed(const Mesh& given, int triangles, const ProgressFn& progress) {
  Mesh mesh = given;
  if (mesh.triangles.rows() > kMany) {
    mesh = decimate(given, static_cast<int>(kMany), {}, [&](double part) {
             return !progress || progress({"decimate", 0, 0, 0.1 * part * kPrepared, 0});
           }).mesh;
  }
  RemeshOptions options;
  options.triangles = triangles;
  if (mesh.triangles.rows() == 0) return mesh;
  const UnitBox box = unit_box(mesh.positions);  // Else the mesh's unit would decide by rounding.
  mesh = remesh(box.into(mesh.positions), mesh.triangles, options, progress);
  return {box.back(mesh.positions), mesh.triangles};
}

std::shared_ptr<StandIn> make(const ReshapePlan& plan, const Mesh& given, const ProgressFn& progress) {
  auto stand_in = std::make_shared<StandIn>();
  const ProgressFn told = [&](const Progress& now) {
    return !progress || progress({now.stage, 0, plan.options.pass_limit, 0, 0});
  };
  stand_in->mesh = remeshed(given, plan.options.stand_in_triangles, told);
  if (stand_in->mesh.triangles.rows() == 0) throw Cancelled();
  stand_in->attachments = attach(given.positions, stand_in->mesh.positions, stand_in->mesh.triangles, {}, told);
  if (stand_in->attachments.triangles.size() == 0) throw Cancelled();
  ReshapeOptions options = plan.options;
  options.remesh = When::never;
  options.unit_box_curvatures.reset();
  options.straight_chains.clear();
  stand_in->plan = plan_of(stand_in->mesh, options);
  if (!prepare(*stand_in->plan, progress)) throw Cancelled();
  return stand_in;
}

/// Of points of the mesh.
std::vector<Hold> on_stand_in(const StandIn& stand_in, const std::vector<Hold>& holds) {
  std::vector<Hold> result;
  for (const Hold& hold : holds) {
    const int v = hold.vertex(), t = stand_in.attachments.triangles[v];
    const Eigen::RowVector3i corners = stand_in.mesh.triangles.row(t);
    result.push_back({{corners[0], corners[1], corners[2]},
                      stand_in.attachments.barycentric.row(v),
                      hold.target - stand_in.attachments.offsets.row(v),
                      hold.share});
  }
  return result;
}

/// Its result as one of the mesh.
ReshapeResult carried_back(const StandIn& stand_in, const Mesh& mesh, ReshapeResult result) {
  const Attachments& attachments = stand_in.attachments;
  ReshapeResult back;
  const auto carried = [&](const Positions& moved) {
    return carry(attachments, stand_in.mesh.triangles, stand_in.mesh.positions, moved, &result.transforms);
  };
  back.positions = carried(result.positions);
  back.unfinished = carried(result.unfinished);
  back.transforms = Transforms::Zero(mesh.triangles.rows(), 9);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      back.transforms.row(t) += result.transforms.row(attachments.triangles[mesh.triangles(t, k)]) / 3;
    }
  }
  back.finalised = result.finalised;
  back.straight_chains = result.straight_chains;
  back.report = result.report;
  back.stand_in = std::make_shared<const ReshapeResult>(std::move(result));
  return back;
}

}  // namespace

std::shared_ptr<StandIn> stand_in_for(const ReshapePlan& plan, const ProgressFn& progress, std::string& told) {
  const Mesh& given = plan.given ? plan.given->mesh() : plan.mesh;
  if (!needs_one(plan, told)) return nullptr;
  const bool must = plan.options.remesh == When::always;
  try {
    std::shared_ptr<StandIn> stand_in = make(plan, given, progress);
    told = "stand-in: remeshed to " + std::to_string(stand_in->mesh.triangles.rows()) + " triangles";
    return stand_in;
  } catch (const Unavailable& why) {
    if (must) throw;
    told = std::string("as given, badly shaped as it is: ") + why.what();
  } catch (const Unsolvable& why) {
    if (must) throw;
    told = std::string("as given, badly shaped as it is: ") + why.what();
  }
  return nullptr;
}

ReshapeResult solve_stand_in(const ReshapePlan& plan, const Mesh& mesh, const std::vector<Hold>& holds,
                             const ReshapeResult* start, const ProgressFn& progress) {
  StandIn& stand_in = *plan.stand_in;
  const ReshapeResult* from = start ? start->stand_in.get() : nullptr;
  ReshapeResult result =
      carried_back(stand_in, mesh, solve_holds(*stand_in.plan, on_stand_in(stand_in, holds), from, progress));
  result.report.paths["mesh"] = plan.paths.mesh;
  result.report.seconds["precompute"] = plan.prepare_seconds;
  return result;
}

}  // namespace swage

// Coarse to fine: the answer hardly depends on the resolution, so that of a coarse stand-in is where a large mesh's
// passes start.
#include "coarse.h"

#include "swage/error.h"

namespace swage {
namespace {

/// Means of those of the triangles that each stands for.
Curvatures mean_curvatures(const Proxy& proxy, const Curvatures& fine) {
  Curvatures means = Curvatures::Zero(proxy.mesh.triangles.rows(), 2);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(means.rows());
  for (size_t t = 0; t < proxy.triangle_of.size(); ++t) {
    means.row(proxy.triangle_of[t]) += fine.row(static_cast<Eigen::Index>(t));
    counts[proxy.triangle_of[t]] += 1;
  }
  return counts.cwiseMax(1).cwiseInverse().asDiagonal() * means;
}

/// Handed from few triangles to many, transforms jump where the stand-in's triangles meet: passes would take that for
/// shape, and be long in undoing it.
Transforms smoothed(Transforms transforms, const Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>& pairs) {
  constexpr int kSmoothings = 10;
  for (int round = 0; round < kSmoothings; ++round) {
    Transforms sums = transforms;
    Eigen::VectorXd counts = Eigen::VectorXd::Ones(sums.rows());
    for (const auto& pair : pairs.rowwise()) {
      sums.row(pair[0]) += transforms.row(pair[1]);
      sums.row(pair[1]) += transforms.row(pair[0]);
      counts[pair[0]] += 1;
      counts[pair[1]] += 1;
    }
    transforms = counts.cwiseInverse().asDiagonal() * sums;
  }
  return transforms;
}

/// Each handle moves the vertex that its nearest was collapsed into; where those are one, by the mean.
Gesture coarse_gesture(const Proxy& proxy, const Positions& rest, const std::vector<Hold>& holds) {
  std::map<int, std::pair<Eigen::RowVector3d, int>> sums;
  for (const Hold& hold : holds) {
    const int coarse = proxy.vertex_of[static_cast<size_t>(hold.vertex())];
    auto& [sum, count] = sums.try_emplace(coarse, Eigen::RowVector3d::Zero(), 0).first->second;
    sum += hold.target - hold.point(rest);
    ++count;
  }
  Gesture result;
  for (const auto& [vertex, sum] : sums) {
    result.add(vertex, (proxy.mesh.positions.row(vertex) + sum.first / sum.second).transpose());
  }
  return result;
}

}  // namespace

std::size_t CoarsePlan::bytes() const {
  return (proxy.vertex_of.size() + proxy.triangle_of.size() + proxy.vertices.size()) * sizeof(int) +
         static_cast<std::size_t>(proxy.mesh.positions.size()) * sizeof(double) +
         static_cast<std::size_t>(proxy.mesh.triangles.size()) * sizeof(int);
}

std::unique_ptr<CoarsePlan> coarse_plan(const ReshapePlan& plan, const Curvatures& unit_box_curvatures,
                                        const Poll& poll, std::string& why_none) {
  constexpr int kCoarse = 10'000;      // Solved in a second.
  constexpr int kWorthwhile = 40'000;  // Below, the passes it saves take as long.
  const Eigen::Index count = plan.mesh.triangles.rows();
  if (!plan.options.coarse_start || plan.options.solver == ReshapeSolver::published) {
    why_none = "no coarse start asked for";
  } else if (count < kWorthwhile) {
    why_none = std::to_string(count) + " triangles";
  }
  if (!why_none.empty()) return nullptr;
  Proxy proxy = decimate(plan.mesh, kCoarse, {}, [&](double) {
    poll();
    return true;
  });
  why_none = "the surface has no coarse stand-in";
  if (2 * proxy.mesh.triangles.rows() > count) return nullptr;
  ReshapeOptions options = plan.options;
  options.unit_box_curvatures = mean_curvatures(proxy, unit_box_curvatures);
  options.straight_chains.clear();
  options.finalise = options.coarse_start = false;
  try {
    auto coarse = std::make_unique<CoarsePlan>();
    coarse->reshape = std::make_unique<Reshape>(proxy.mesh.positions, proxy.mesh.triangles, options);
    coarse->reshape->prepare();
    coarse->proxy = std::move(proxy);
    why_none.clear();
    return coarse;
  } catch (const InvalidInput&) {
  } catch (const Unsolvable&) {
  }
  return nullptr;  // A stand-in that cannot be reshaped is none.
}

std::optional<Transforms> coarse_transforms(const CoarsePlan& coarse, const ReshapePlan& plan,
                                            const std::vector<Hold>& holds, const ProgressFn& progress) {
  const Gesture handles = coarse_gesture(coarse.proxy, plan.mesh.positions, holds);
  ProgressFn told;  // As before the first pass of the mesh itself.
  if (progress) told = [&](const Progress&) { return progress({"coarse", 0, plan.options.pass_limit, 0, 0}); };
  try {
    const ReshapeResult result = coarse.reshape->solve(handles, told);
    if (result.report.stop == Termination::cancelled) return std::nullopt;
    return smoothed(result.transforms(coarse.proxy.triangle_of, Eigen::all), plan.rest->pairs);
  } catch (const Unsolvable&) {
    return identities(plan.mesh.triangles.rows());
  }
}

}  // namespace swage

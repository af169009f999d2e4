// Stylizing, on a torus by its vertices, to the normals of a cube. `prepare`: all that depends on the rest shape.
// `passes`: what is prepared, solved for ten passes: local step, global step, targets looked up again and both
// energies. `local` and `global`: those steps of a pass alone. `passes/cgal_arap`: as many of ARAP by CGAL, of the same
// neighbourhoods, spokes and rims, but without normals or energies; in one thread, as it has it.
// A million vertices only where SWAGE_BENCH_LARGE=1 is set.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench_main.h"
#include "matrices.h"
#include "peak_memory.h"
#include "plan.h"
#include "shapes.h"
#ifdef SWAGE_BENCH_CGAL
#include "cgal_arap.h"
#endif

namespace swage::bench {
namespace {

constexpr int kPasses = 10;

/// Askew, so that no two of the style's normals are equally near.
Mesh torus_of(int vertices) {
  const int around = static_cast<int>(std::lround(std::sqrt(vertices)));
  Mesh mesh = test::torus(1, 0.4, around, around);
  mesh.positions *= Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 0.4, 0.3).normalized()).toRotationMatrix();
  return mesh;
}

StylizeOptions options_of(StylizeEnergy energy, const NamedBackend& choice) {
  StylizeOptions options;
  options.energy = energy;
  options.pass_limit = kPasses;
  options.movement = 0;
  options.backend = choice.backend();
  return options;
}

ClosestNormals cube() { return closest_normals(style_shape(StyleShape::cube)); }

void prepare(benchmark::State& state, StylizeEnergy energy, const NamedBackend& choice) {
  const Mesh mesh = torus_of(static_cast<int>(state.range(0)));
  const StylizeOptions options = options_of(energy, choice);
  for (auto _ : state) {
    Stylize plan(mesh.positions, mesh.triangles, options);
    benchmark::DoNotOptimize(plan.prepare());
  }
}

void passes(benchmark::State& state, StylizeEnergy energy, const NamedBackend& choice) {
  const Mesh mesh = torus_of(static_cast<int>(state.range(0)));
  Stylize plan(mesh.positions, mesh.triangles, options_of(energy, choice));
  plan.solve(cube());
  for (auto _ : state) benchmark::DoNotOptimize(plan.solve(cube()).positions.sum());
  state.counters["passes/s"] = benchmark::Counter(kPasses, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["peak_mb"] = peak_memory();
}

std::unique_ptr<StylizePlan> prepared(benchmark::State& state, StylizeEnergy energy, const NamedBackend& choice) {
  std::unique_ptr<StylizePlan> plan = plan_of(torus_of(static_cast<int>(state.range(0))), options_of(energy, choice));
  swage::prepare(*plan, {});
  return plan;
}

void local_step(benchmark::State& state, StylizeEnergy energy, const NamedBackend& choice) {
  const std::unique_ptr<StylizePlan> plan = prepared(state, energy, choice);
  const std::unique_ptr<StylizeSteps> steps = steps_of(*plan);
  const Positions moved = (2 * plan->elements.pairs.vertices).array().sin();
  StylizeFit fitted = unmoved(plan->system.element_count());
  for (auto _ : state) fit(*plan, *steps, moved, plan->elements.pairs.normals, 1, fitted);
}

void global_step(benchmark::State& state, StylizeEnergy energy, const NamedBackend& choice) {
  const std::unique_ptr<StylizePlan> plan = prepared(state, energy, choice);
  const HeldPoints points = points_held(*plan, {});
  const HeldLaplacian held(plan->system, points);
  const Transforms rotations = identities(plan->system.element_count());
  for (auto _ : state) {
    benchmark::DoNotOptimize(held.solve(plan->system.right_hand_sides(rotations), points).sum());
  }
}

#ifdef SWAGE_BENCH_CGAL
void prepare_cgal(benchmark::State& state) {
  const Mesh mesh = torus_of(static_cast<int>(state.range(0)));
  Gesture held;
  held.add(0, mesh.positions.row(0).transpose());
  for (auto _ : state) test::CgalArap(mesh, held);
}

void passes_of_cgal(benchmark::State& state) {
  const Mesh mesh = torus_of(static_cast<int>(state.range(0)));
  Gesture held;
  held.add(0, mesh.positions.row(0).transpose());
  held.add(1, mesh.positions.row(1).transpose() * 1.01);
  test::CgalArap plan(mesh, held);
  for (auto _ : state) plan.solve(kPasses);
  state.counters["passes/s"] = benchmark::Counter(kPasses, benchmark::Counter::kIsIterationInvariantRate);
}
#endif

/// On meshes of up to so many vertices.
void add_sizes(const std::string& name, const std::function<void(benchmark::State&)>& run,
               int most_vertices = 1'000'000) {
  auto* benchmark = add_benchmark(name, run);
  const int most = std::getenv("SWAGE_BENCH_LARGE") ? most_vertices : std::min(most_vertices, 200'000);
  for (const int vertices : {3'000, 10'000, 20'000, 50'000, 200'000, 1'000'000}) {
    if (vertices <= most) benchmark->Arg(vertices);
  }
}

}  // namespace

void register_all() {
  using enum StylizeEnergy;
  for (const StylizeEnergy energy : {arap, farap, acap}) {
    const std::string name = to_string(energy);
    const NamedBackend reference = named_backends().front();
    add_sizes("prepare/" + name, [=](benchmark::State& state) { prepare(state, energy, reference); });
    add_sizes("global/" + name, [=](benchmark::State& state) { global_step(state, energy, reference); });
    for (const NamedBackend& choice : named_backends()) {
      const std::string by = "/" + name + "/" + choice.name;
      add_sizes("local" + by, [=](benchmark::State& state) { local_step(state, energy, choice); });
      add_sizes("passes" + by, [=](benchmark::State& state) { passes(state, energy, choice); });
    }
  }
#ifdef SWAGE_BENCH_CGAL
  add_sizes("prepare/cgal_arap", prepare_cgal, 50'000);
  add_sizes("passes/cgal_arap", passes_of_cgal, 200'000);
#endif
}

}  // namespace swage::bench

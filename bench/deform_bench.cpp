// The deformations that reshaping is compared with, on a torus by its triangles with 32 handles. `first`: from nothing
// to one pass, so preparing and factoring; `passes`: ten plain passes more on what is prepared. `cgal_arap` is the same
// as `arap` by CGAL, whose results are equal pass by pass, in one thread.
#include <benchmark/benchmark.h>

#include <cmath>
#include <limits>
#include <string>

#include "bench_main.h"
#include "shapes.h"
#include "swage/deform.h"
#ifdef SWAGE_BENCH_CGAL
#include "cgal_arap.h"
#endif

namespace swage::bench {
namespace {

constexpr int kPasses = 10;

Mesh torus_of(int triangles) {
  const int around = static_cast<int>(std::sqrt(triangles / 2.0));
  return test::torus(1, 0.4, around, around);
}

Gesture handles_of(const Mesh& mesh) {
  Gesture gesture;
  const int stride = static_cast<int>(mesh.positions.rows()) / 32;
  for (int i = 0; i < 32; ++i) {
    gesture.add(i * stride, mesh.positions.row(i * stride).transpose() + 0.1 * Eigen::Vector3d(std::sin(i), 0, 1));
  }
  return gesture;
}

DeformOptions options_of(DeformMethod method, int passes) {
  DeformOptions options;
  options.method = method;
  options.pass_limit = passes;
  options.movement = std::numeric_limits<double>::min();
  options.acceleration_window = 0;
  return options;
}

void first(benchmark::State& state, DeformMethod method) {
  const Mesh mesh = torus_of(static_cast<int>(state.range(0)));
  const Gesture gesture = handles_of(mesh);
  for (auto _ : state) {
    benchmark::DoNotOptimize(deform(mesh.positions, mesh.triangles, gesture, options_of(method, 1)).positions.sum());
  }
}

void passes(benchmark::State& state, DeformMethod method) {
  const Mesh mesh = torus_of(static_cast<int>(state.range(0)));
  const Gesture gesture = handles_of(mesh);
  Deform plan(mesh.positions, mesh.triangles, options_of(method, kPasses));
  plan.solve(gesture);
  for (auto _ : state) benchmark::DoNotOptimize(plan.solve(gesture).positions.sum());
  state.counters["passes/s"] = benchmark::Counter(kPasses, benchmark::Counter::kIsIterationInvariantRate);
}

#ifdef SWAGE_BENCH_CGAL
void first_by_cgal(benchmark::State& state) {
  const Mesh mesh = torus_of(static_cast<int>(state.range(0)));
  const Gesture gesture = handles_of(mesh);
  for (auto _ : state) test::CgalArap(mesh, gesture).solve(1);
}

void passes_by_cgal(benchmark::State& state) {
  const Mesh mesh = torus_of(static_cast<int>(state.range(0)));
  test::CgalArap plan(mesh, handles_of(mesh));
  for (auto _ : state) plan.solve(kPasses);
  state.counters["passes/s"] = benchmark::Counter(kPasses, benchmark::Counter::kIsIterationInvariantRate);
}
#endif

template <class Run>
void add(const std::string& name, const Run& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Arg(10'000)
      ->Arg(50'000)
      ->Arg(200'000)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace

void register_all() {
  using enum DeformMethod;
  for (const DeformMethod method : {poisson, arap, arap_volume, conformal}) {
    add(std::string("first/") + to_string(method), [=](benchmark::State& state) { first(state, method); });
    if (method == poisson) continue;
    add(std::string("passes/") + to_string(method), [=](benchmark::State& state) { passes(state, method); });
  }
#ifdef SWAGE_BENCH_CGAL
  add("first/cgal_arap", first_by_cgal);
  add("passes/cgal_arap", passes_by_cgal);
#endif
}

}  // namespace swage::bench

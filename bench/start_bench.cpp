// What a first use of the device costs: a process that runs every step once on a small mesh, with caches of built
// kernels that are empty (cold) or full (warm), and without any device. `build_s` of it went into building kernels.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "bench_main.h"
#include "element_pairs.h"
#include "plan.h"
#include "shapes.h"
#include "swage/backend.h"
#include "swage/curvature.h"

namespace swage::bench {
namespace {

/// In the child: the backend that does the steps.
constexpr const char* kChild = "SWAGE_START_BENCH_BACKEND";

void run_every_step(const Backend& backend) {
  const Mesh mesh = test::torus();
  const PairsRest pairs = test::triangle_pairs(mesh);
  const TransformStep::Rest rest =
      rest_shape({}, mesh, edges_of(mesh.triangles), curvature(mesh.positions, mesh.triangles, {}, backend));
  const Transforms transforms = identities(static_cast<int>(mesh.triangles.rows()));
  Transforms result;
  TransformStep::EdgeQuadratics quadratics;
  backend.rotation(pairs)->fit(mesh.positions, Positions(0, 3), result);
  backend.similarity(pairs)->fit(mesh.positions, Positions(0, 3), result);
  const auto transform = backend.transform(rest);
  transform->fit_edges(transforms, quadratics);
  transform->fit_transforms(rest.vertices, result);
  backend.coupling(rest)->apply(transforms, result);
}

/// Gives what the child spent in building kernels.
double run_child(benchmark::State& state) {
  static const std::string kCommand = "exec '" + std::filesystem::read_symlink("/proc/self/exe").string() + '\'';
  double build_seconds = 0;
  FILE* const child = popen(kCommand.c_str(), "r");
  const bool told = child != nullptr && std::fscanf(child, "%lf", &build_seconds) == 1;
  if (child == nullptr || pclose(child) != 0 || !told) state.SkipWithError("the child failed");
  return build_seconds;
}

void start(benchmark::State& state, const std::string& backend, bool cold) {
  const auto caches = std::filesystem::temp_directory_path() / ("swage-start-bench-" + std::to_string(getpid()));
  setenv(kChild, backend.c_str(), 1);
  for (const char* name : {"XDG_CACHE_HOME", "POCL_CACHE_DIR"}) setenv(name, caches.c_str(), 1);
  run_child(state);
  double build_seconds = 0;
  for (auto _ : state) {
    state.PauseTiming();
    if (cold) std::filesystem::remove_all(caches);
    state.ResumeTiming();
    build_seconds += run_child(state);
  }
  state.counters["build_s"] = {build_seconds, benchmark::Counter::kAvgIterations};
  std::filesystem::remove_all(caches);
}

void add(const std::string& name, const std::string& backend, bool cold) {
  benchmark::RegisterBenchmark(("start/" + name).c_str(), start, backend, cold)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace

void register_all() {
  if (const char* name = std::getenv(kChild)) {
    const auto backend = std::strcmp(name, "cpu") == 0 ? cpu_backend() : opencl_backend();
    run_every_step(*backend);
    std::printf("%.9f\n", backend->traffic().build_seconds);
    std::exit(0);
  }
  add("cpu", "cpu", false);
  add("opencl/cold", "opencl", true);
  add("opencl/warm", "opencl", false);
}

}  // namespace swage::bench

// What a first use of the device costs: a process that runs every step once on a small mesh, with a cache of built
// kernels that is empty (cold) or full (warm), and without any device.
#include <benchmark/benchmark.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

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

void run_child(benchmark::State& state, const std::string& backend, const std::string& cache) {
  setenv(kChild, backend.c_str(), 1);
  setenv("POCL_CACHE_DIR", cache.c_str(), 1);
  char name[] = "start_bench";
  char* arguments[] = {name, nullptr};
  pid_t child = 0;
  int status = 0;
  if (posix_spawn(&child, "/proc/self/exe", nullptr, nullptr, arguments, environ) != 0 ||
      waitpid(child, &status, 0) != child || status != 0) {
    state.SkipWithError("the child failed");
  }
}

void add(const std::string& name, const std::string& backend, bool cold) {
  benchmark::RegisterBenchmark(("start/" + name).c_str(),
                               [=](benchmark::State& state) {
                                 const auto cache = std::filesystem::temp_directory_path() /
                                                    ("swage-start-bench-" + std::to_string(getpid()));
                                 run_child(state, backend, cache.string());
                                 for (auto _ : state) {
                                   state.PauseTiming();
                                   if (cold) std::filesystem::remove_all(cache);
                                   state.ResumeTiming();
                                   run_child(state, backend, cache.string());
                                 }
                                 std::filesystem::remove_all(cache);
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace

void register_all() {
  if (const char* backend = std::getenv(kChild)) {
    run_every_step(*(std::strcmp(backend, "cpu") == 0 ? cpu_backend() : opencl_backend()));
    std::exit(0);
  }
  add("cpu", "cpu", false);
  add("opencl/cold", "opencl", true);
  add("opencl/warm", "opencl", false);
}

}  // namespace swage::bench

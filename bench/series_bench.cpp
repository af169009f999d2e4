// How reshaping grows with the mesh: first solves of one gesture on a model whose triangles are cut in four at the
// middles of their sides, 0 to 3 times. The shape stays the same, facets and all, so the series tells of size, not of
// detail. The authors' models inherit their curvatures; the generated one's are computed, and that time counts.
//
// Each is solved once. `prepare_s` and `solve_s` are its seconds, `peak_MB` the most memory that the process held
// meanwhile (of its whole life so far where /proc/self/clear_refs may not be written).
//
// Meshes above 500,000 triangles are left out unless SWAGE_BENCH_LARGE=1 stands in the environment: they take many
// minutes and 5 GB.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench_main.h"
#include "peak_memory.h"
#include "reference_models.h"
#include "stopwatch.h"
#include "swage/error.h"

namespace swage::bench {
namespace {

struct Seconds {
  double prepare = 0, solve = 0;
};

ReshapeResult solve_once(const Model& model, Seconds& seconds) {
  std::optional<Reshape> prepared;
  {
    const Stopwatch watch(seconds.prepare);
    prepared.emplace(model.mesh.positions, model.mesh.triangles, model.options).prepare();
  }
  const Stopwatch watch(seconds.solve);
  return prepared->solve(model.gestures.front());
}

void measure(benchmark::State& state, const Model& model) {
  state.counters["triangles"] = static_cast<double>(model.mesh.triangles.rows());
  for (auto _ : state) {
    reset_peak_memory();
    Seconds seconds;
    try {
      state.counters["passes"] = solve_once(model, seconds).report.passes;
    } catch (const Unsolvable& error) {
      state.SkipWithError(error.what());
      break;
    }
    state.SetIterationTime(seconds.prepare + seconds.solve);
    state.counters["peak_MB"] = peak_memory();
    state.counters["prepare_s"] = seconds.prepare;
    state.counters["solve_s"] = seconds.solve;
  }
}

Model subdivided(Model model, int times) {
  for (int i = 0; i < times; ++i) model = bench::subdivided(model);
  return model;
}

bool wants_large() {
  const char* large = std::getenv("SWAGE_BENCH_LARGE");
  return large != nullptr && std::string_view(large) == "1";
}

}  // namespace

void register_all() {
  static std::vector<Model> models = {lifted_cylinder(64, 20)};
  for (const char* name : {"m0839_sofa", "f5-1_antique_chair"}) {
    for (Model& model : reference_model(name)) models.push_back(std::move(model));
  }
  for (const Model& model : models) {
    for (int times = 0; times <= 3; ++times) {
      const double triangles = static_cast<double>(model.mesh.triangles.rows()) * std::pow(4, times);
      if (triangles > 500'000 && !wants_large()) continue;
      const std::string name = "series/" + model.name + "/subdivided:" + std::to_string(times);
      // Made only when its turn comes: a mesh that waits would count as memory.
      benchmark::RegisterBenchmark(
          name.c_str(), [&model, times](benchmark::State& state) { measure(state, subdivided(model, times)); })
          ->Unit(benchmark::kSecond)
          ->Iterations(1)
          ->UseManualTime();
    }
  }
}

}  // namespace swage::bench

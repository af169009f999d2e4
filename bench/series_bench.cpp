// How reshaping grows with the mesh: first solves of one gesture on a model whose triangles are cut in four at the
// middles of their sides, 0 to 3 times. The shape stays the same, facets and all, so the series tells of size, not of
// detail. The authors' models inherit their curvatures; the generated one's are computed, and that time counts.
//
// Each is prepared once and solved twice. `prepare_s`, `solve_s` and `again_s` are its seconds, `silence_s` the longest
// time between two calls of `progress` in preparing and solving, where cancelling waits; `peak_MB` the most memory that
// the process held meanwhile (of its whole life so far where /proc/self/clear_refs may not be written).
//
// Meshes above 500,000 triangles are left out unless SWAGE_BENCH_LARGE=1 stands in the environment: they take many
// minutes and 5 GB.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
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

/// Longest time between two calls.
class Silence {
 public:
  bool operator()() {
    const auto now = Clock::now();
    longest_ = std::max(longest_, std::chrono::duration<double>(now - last_).count());
    last_ = now;
    return true;
  }
  double longest() const { return longest_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
  double longest_ = 0;
};

void solve_twice(benchmark::State& state, const Model& model) {
  double prepare = 0, solve = 0, again = 0;
  std::optional<Reshape> prepared;
  {
    const Stopwatch watch(prepare);
    prepared.emplace(model.mesh.positions, model.mesh.triangles, model.options);
  }
  Silence silence;
  const ProgressFn progress = [&](const Progress&) { return silence(); };
  {
    const Stopwatch watch(prepare);
    prepared->prepare(progress);
  }
  {
    const Stopwatch watch(solve);
    state.counters["passes"] = prepared->solve(model.gestures.front(), progress).report.passes;
  }
  silence();
  state.counters["silence_s"] = silence.longest();
  {
    const Stopwatch watch(again);
    prepared->solve(model.gestures.front());
  }
  state.SetIterationTime(prepare + solve);
  state.counters["prepare_s"] = prepare;
  state.counters["solve_s"] = solve;
  state.counters["again_s"] = again;
}

void measure(benchmark::State& state, const Model& model) {
  state.counters["triangles"] = static_cast<double>(model.mesh.triangles.rows());
  for (auto _ : state) {
    reset_peak_memory();
    try {
      solve_twice(state, model);
    } catch (const Unsolvable& error) {
      state.SkipWithError(error.what());
      break;
    }
    state.counters["peak_MB"] = peak_memory();
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

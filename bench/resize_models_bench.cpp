// Whole resizings: models of our own making with as many faces and components as those of the paper's table 1, on its
// grids and by its factors, and where SWAGE_BENCH_LARGE=1 is set one of 10 million faces (3 GB).
//
// `prepare_s`: the analysis, from the model to its grid's map. `solve_s`: the first solve; `scales`, `assembly`,
// `carry`: seconds of its stages. `again_s`: one by half as much again, on what is prepared. `peak_MB`: the most memory
// that the process held meanwhile (of its whole life so far where /proc/self/clear_refs may not be written), model in
// it. The time of a run is that of preparing and of the first solve.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "bench_main.h"
#include "peak_memory.h"
#include "resize_models.h"
#include "stopwatch.h"
#include "swage/error.h"
#include "swage/resize.h"

namespace swage::bench {
namespace {

struct Choice {
  std::string name;
  std::shared_ptr<Backend> (*backend)();
};

std::vector<Choice> choices() {
  return {{"cpu/double", [] { return cpu_backend(); }},
          {"opencl/double", [] { return opencl_backend("", Precision::twice); }}};
}

ResizeTarget by(const Eigen::RowVector3d& factors) {
  ResizeTarget target;
  target.factors = factors;
  return target;
}

void resize_once(benchmark::State& state, const test::TableLine& line, const Mesh& mesh,
                 const std::shared_ptr<Backend>& backend) {
  double prepare = 0, solve = 0, again = 0;
  ResizeOptions options;
  options.cells = line.cells;
  options.backend = backend;
  std::unique_ptr<Resize> plan;
  {
    const Stopwatch watch(prepare);
    plan = std::make_unique<Resize>(mesh.positions, mesh.triangles, options);
    plan->prepare();
  }
  {
    const Stopwatch watch(solve);
    const Report report = plan->solve(by(line.factors)).report;
    for (const char* stage : {"scales", "assembly", "carry"}) state.counters[stage] = report.seconds.at(stage);
  }
  {
    const Stopwatch watch(again);
    plan->solve(by(line.factors + (line.factors.array() - 1).matrix() / 2));
  }
  state.SetIterationTime(prepare + solve);
  state.counters["prepare_s"] = prepare;
  state.counters["solve_s"] = solve;
  state.counters["again_s"] = again;
}

void measure(benchmark::State& state, const test::TableLine& line, const Choice& choice) {
  const test::Assembled model = line.make(line.detail);
  try {
    const std::shared_ptr<Backend> backend = choice.backend();
    for (auto _ : state) {
      reset_peak_memory();
      resize_once(state, line, model.mesh, backend);
      state.counters["peak_MB"] = peak_memory();
    }
  } catch (const Unavailable& reason) {
    state.SkipWithError(reason.what());
  }
  state.counters["faces"] = static_cast<double>(model.mesh.triangles.rows());
  state.counters["components"] = static_cast<double>(model.parts.size());
  for (size_t u = 0; u < 3; ++u) state.counters[std::string("cells_") + "xyz"[u]] = line.cells[u];
  state.counters["stretch"] = line.factors.prod();
  state.counters["paper_first_s"] = line.first_seconds;
  state.counters["paper_run_s"] = line.run_seconds;
}

void add(const test::TableLine& line) {
  std::string name = line.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  for (const Choice& choice : choices()) {
    benchmark::RegisterBenchmark(("resize/" + name + "/" + choice.name).c_str(),
                                 [=](benchmark::State& state) { measure(state, line, choice); })
        ->Unit(benchmark::kSecond)
        ->Iterations(1)
        ->UseManualTime();
  }
}

bool wants_large() {
  const char* large = std::getenv("SWAGE_BENCH_LARGE");
  return large != nullptr && std::string_view(large) == "1";
}

}  // namespace

void register_all() {
  for (const test::TableLine& line : test::table_1()) add(line);
  if (!wants_large()) return;
  add({"fan_of_10_million", test::fan, 10.5, 0, 0, {20, 57, 20}, {1, 0.65, 1}, 0, 0});
}

}  // namespace swage::bench

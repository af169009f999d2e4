// Reshape, stage by stage (once a model) and whole (once a gesture). Beside each first solve, and each further one of a
// prepared mesh, stands the same gesture as the authors' program solves it: published passes to the published stop,
// both systems refactored in every pass, column by column. It is our code that does so, not the authors' program.
// `times_slower_than_…` is how much longer that takes, by medians of the same run; of the slow one there is one
// solve. `summary` has the medians of these ratios, and the smallest, over the authors' gestures on models above 3,800
// triangles: a gesture counts once, so a model with four of them counts four times.
#include <benchmark/benchmark.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "bench_main.h"
#include "plan.h"
#include "reference_models.h"

namespace swage::bench {
namespace {

void prepare(benchmark::State& state, const Model& model) {
  for (auto _ : state) Reshape(model.mesh.positions, model.mesh.triangles, model.options).prepare();
  state.counters["triangles"] = static_cast<double>(model.mesh.triangles.rows());
}

/// What a plan holds, taken apart so that each step can be timed alone.
struct Parts {
  Edges edges;
  TransformStep::Rest rest;
  std::unique_ptr<TransformStep> step;
  VertexSystem vertices;
  BlockSystem transforms;
  Holds handles;

  /// Vertices by multigrid where `kind` is none.
  explicit Parts(const Model& model, std::optional<FactorKind> kind = {})
      : edges(edges_of(model.mesh.triangles)),
        rest(rest_shape(
            model.options, unit(model), edges,
            model.options.unit_box_curvatures.value_or(curvature(unit(model).positions, model.mesh.triangles)))),
        step(cpu_backend()->transform(rest)),
        vertices(vertex_system(rest, {}, kind)),
        transforms(transform_system(rest)),
        handles{{Hold::at(0, rest.vertices.row(0)), Hold::at(1, rest.vertices.row(1))},
                step_weights(model.options, unit(model)).handle} {}

  static Mesh unit(const Model& model) {
    return {unit_box(model.mesh.positions).into(model.mesh.positions), model.mesh.triangles};
  }
};

void vertex_step_of(benchmark::State& state, Parts parts) {
  TransformStep::EdgeQuadratics quadratics;
  const Transforms transforms = identities(parts.rest.triangles.rows());
  for (auto _ : state) {
    parts.step->fit_edges(transforms, quadratics);
    benchmark::DoNotOptimize(
        place_vertices(parts.vertices, parts.rest, quadratics, {}, {parts.handles}, parts.rest.vertices));
  }
  state.counters["unknowns"] = static_cast<double>(parts.vertices.system.unknowns());
  state.counters["factor_entries"] = static_cast<double>(parts.vertices.system.factor_entries());
}

void vertex_step_factored(benchmark::State& state, const Model& model) { vertex_step_of(state, Parts(model)); }

void vertex_step_multigrid(benchmark::State& state, const Model& model) {
  vertex_step_of(state, Parts(model, FactorKind::none));
}

void transform_step(benchmark::State& state, const Model& model) {
  Parts parts(model);
  parts.transforms.factor();
  Transforms sides;
  for (auto _ : state) {
    parts.step->fit_transforms(parts.rest.vertices, sides);
    benchmark::DoNotOptimize(solve_transforms(parts.transforms, sides));
  }
  state.counters["unknowns"] = static_cast<double>(parts.transforms.unknowns());
  state.counters["factor_entries"] = static_cast<double>(parts.transforms.factor_entries());
}

void transform_factor(benchmark::State& state, const Model& model) {
  Parts parts(model);
  for (auto _ : state) parts.transforms.factor();
  state.counters["unknowns"] = static_cast<double>(parts.transforms.unknowns());
  state.counters["factor_entries"] = static_cast<double>(parts.transforms.factor_entries());
}

/// Seconds of the solves so far, by benchmark.
std::map<std::string, std::vector<double>>& seconds_of_solves() {
  static std::map<std::string, std::vector<double>> seconds;
  return seconds;
}

/// How many times slower the published solves were, by what they are compared with: what summary() is about.
std::map<std::string, std::vector<double>>& ratios() {
  static std::map<std::string, std::vector<double>> ratios;
  return ratios;
}

/// A gesture of a model.
struct Edit {
  const Model& model;
  const Gesture& gesture;
  std::string name() const { return model.name + '/' + gesture.label; }
};

/// Times `solve`, which gives its result, and keeps the times under `name`.
template <typename Solve>
void time_solves(benchmark::State& state, const std::string& name, const Solve& solve) {
  std::vector<double>& all = seconds_of_solves()[name];
  for (auto _ : state) {
    double seconds = 0;
    {
      const Stopwatch watch(seconds);
      state.counters["passes"] = solve().report.passes;
    }
    state.SetIterationTime(seconds);
    all.push_back(seconds);
  }
  state.counters["median_s"] = median(all);
}

bool is_reference(const Model& model) {
  return std::find(reference_names().begin(), reference_names().end(), model.name) != reference_names().end();
}

ReshapeResult solve_once(const Edit& edit, const ReshapeOptions& options) {
  return reshape(edit.model.mesh.positions, edit.model.mesh.triangles, edit.gesture, options);
}

void solve_first(benchmark::State& state, const Edit& edit) {
  time_solves(state, "first/" + edit.name(), [&] { return solve_once(edit, edit.model.options); });
}

void solve_again(benchmark::State& state, const Edit& edit) {
  Reshape prepared(edit.model.mesh.positions, edit.model.mesh.triangles, edit.model.options);
  prepared.prepare();
  time_solves(state, "again/" + edit.name(), [&] { return prepared.solve(edit.gesture); });
}

/// The gesture on its way from rest: `part` of each target's movement.
Gesture part_of(const Edit& edit, double part) {
  Gesture partial;
  for (const auto& [vertex, target] : edit.gesture.targets) {
    const Eigen::Vector3d rest = edit.model.mesh.positions.row(vertex);
    partial.add(vertex, rest + part * (target - rest));
  }
  return partial;
}

/// Ten steps from rest to the gesture, each from the result of the last; beside them the passes of each from rest.
void solve_dragged(benchmark::State& state, const Edit& edit) {
  constexpr int kSteps = 10;
  Reshape prepared(edit.model.mesh.positions, edit.model.mesh.triangles, edit.model.options);
  double cold_passes = 0;
  for (int step = 1; step <= kSteps; ++step) {
    cold_passes += prepared.solve(part_of(edit, static_cast<double>(step) / kSteps)).report.passes;
  }
  double passes = 0, seconds = 0;
  for (auto _ : state) {
    double of_drag = 0;
    {
      const Stopwatch watch(of_drag);
      ReshapeResult last = prepared.solve(part_of(edit, 1.0 / kSteps));
      passes += last.report.passes;
      for (int step = 2; step <= kSteps; ++step) {
        last = prepared.solve(part_of(edit, static_cast<double>(step) / kSteps), last);
        passes += last.report.passes;
      }
    }
    state.SetIterationTime(of_drag);
    seconds += of_drag;
  }
  const double steps = kSteps * static_cast<double>(state.iterations());
  state.counters["passes_a_step"] = passes / steps;
  state.counters["passes_a_step_from_rest"] = cold_passes / kSteps;
  state.counters["ms_a_step"] = 1e3 * seconds / steps;
}

double seconds_of(const std::function<void()>& work) {
  double seconds = 0;
  {
    const Stopwatch watch(seconds);
    work();
  }
  return seconds;
}

/// As many solves at once as there are cores, each in one thread, beside as many one after the other in all threads.
void solve_parallel(benchmark::State& state, const Edit& edit) {
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  Reshape prepared(edit.model.mesh.positions, edit.model.mesh.triangles, edit.model.options);
  const auto at_once = [&] {
    std::vector<std::thread> threads;
    for (unsigned c = 0; c < cores; ++c) {
      threads.emplace_back([&] {
#ifdef _OPENMP
        omp_set_num_threads(1);
#endif
        prepared.solve(edit.gesture);
      });
    }
    for (std::thread& thread : threads) thread.join();
  };
  at_once();  // Makes what later solves go on with.
  std::vector<double> together, in_turn;
  for (auto _ : state) {
    together.push_back(seconds_of(at_once));
    in_turn.push_back(seconds_of([&] {
      for (unsigned c = 0; c < cores; ++c) prepared.solve(edit.gesture);
    }));
    state.SetIterationTime(together.back());
  }
  state.counters["at_once"] = cores;
  state.counters["gestures_a_second"] = cores / median(together);
  state.counters["gestures_a_second_in_turn"] = cores / median(in_turn);
}

void solve_as_published(benchmark::State& state, const Edit& edit) {
  ReshapeOptions options = edit.model.options;
  options.solver = ReshapeSolver::published;
  options.refactor_every_pass = true;
  const std::string name = "published/" + edit.name();
  time_solves(state, name, [&] { return solve_once(edit, options); });
  for (const std::string stage : {"first", "again"}) {
    const std::vector<double>& ours = seconds_of_solves()[stage + '/' + edit.name()];
    if (ours.empty()) continue;
    const double ratio = median(seconds_of_solves()[name]) / median(ours);
    state.counters["times_slower_than_" + stage] = ratio;
    if (edit.model.mesh.triangles.rows() > 3800 && is_reference(edit.model)) ratios()[stage].push_back(ratio);
  }
}

/// Of the ratios of this run; must come last.
void summary(benchmark::State& state) {
  for (auto _ : state) {
  }
  for (const auto& [stage, values] : ratios()) {
    state.counters["gestures_" + stage] = static_cast<double>(values.size());
    state.counters["median_" + stage] = median(values);
    state.counters["smallest_" + stage] = *std::min_element(values.begin(), values.end());
  }
}

}  // namespace

void register_all() {
  static std::vector<Model> models = reference_models();
  const bool have_references = !models.empty();
  models.push_back(lifted_cylinder(64, 20));
  for (const Model& model : models) {
    auto add = [&](const std::string& stage, auto run) {
      benchmark::RegisterBenchmark((stage + "/" + model.name).c_str(), [&model, run](benchmark::State& state) {
        run(state, model);
      })->Unit(benchmark::kMillisecond);
    };
    add("prepare", prepare);
    add("vertex_step_factored", vertex_step_factored);
    add("vertex_step_multigrid", vertex_step_multigrid);
    add("transform_factor", transform_factor);
    add("transform_step", transform_step);
    for (const Gesture& gesture : model.gestures) {
      const Edit edit{model, gesture};
      auto add_solve = [&](const std::string& stage, int times, auto run) {
        benchmark::RegisterBenchmark((stage + "/" + edit.name()).c_str(),
                                     [edit, run](benchmark::State& state) { run(state, edit); })
            ->Unit(benchmark::kMillisecond)
            ->Iterations(times)
            ->UseManualTime();
      };
      add_solve("solve_first", 5, solve_first);
      add_solve("solve_again", 5, solve_again);
      add_solve("solve_dragged", 3, solve_dragged);
      add_solve("solve_parallel", 3, solve_parallel);
      add_solve("solve_as_published", 1, solve_as_published);
    }
  }
  if (have_references) benchmark::RegisterBenchmark("summary", summary)->Iterations(1);
}

}  // namespace swage::bench

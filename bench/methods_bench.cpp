// Reshape, stage by stage and whole. Beside each first solve, and each further one of a prepared mesh, stands the same
// gesture as the authors' program solves it: published passes to the published stop, both systems refactored in every
// pass, column by column. `times_slower_than_…` is how much longer that takes, by medians of the same run.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench_main.h"
#include "plan.h"
#include "shapes.h"

namespace swage::bench {
namespace {

struct Model {
  std::string name;
  Mesh mesh;
  ReshapeOptions options;
  Gesture gesture;
};

Model lifted_cylinder(int segments, int rings) {
  Model model{"generated_cylinder", test::cylinder(0.5, 1, segments, rings), {}, {}};
  model.gesture.add(0, model.mesh.positions.row(0));
  model.gesture.add(1, model.mesh.positions.row(1) + Eigen::RowVector3d(0, 0.5, 0));
  return model;
}

/// The authors' gestures, where they are.
std::vector<Model> reference_models() {
  std::vector<Model> models;
  for (const auto& [name, label] : {std::pair<std::string, std::string>{"cylinder_1kF", "def_v1"},
                                    {"phone", "def_v1"},
                                    {"cutlery_s26-1", "def_v1"},
                                    {"e_car_extruded", "def_v1"},
                                    {"espresso", "def_v1"}}) {
    const std::filesystem::path stem = std::filesystem::path(SWAGE_SHARED) / "oracle/reshape" / name / name;
    auto with = [&](const char* extension) { return stem.string() + extension; };
    if (!std::filesystem::exists(with(".obj"))) continue;
    Model model{name, read_mesh(with(".obj")).mesh, {}, {}};
    model.options.unit_box_curvatures =
        read_unit_box_curvatures(with(".fk"), static_cast<int>(model.mesh.triangles.rows()));
    if (std::filesystem::exists(with(".straight"))) {
      model.options.straight_chains =
          read_straight_chains(with(".straight"), static_cast<int>(model.mesh.positions.rows()));
    }
    for (Gesture& gesture : read_gestures(with(".deform"), model.mesh.positions)) {
      if (gesture.label == label) model.gesture = std::move(gesture);
    }
    models.push_back(std::move(model));
  }
  return models;
}

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
  std::vector<StraightTriple> straight;
  Holds handles;

  explicit Parts(const Model& model)
      : edges(edges_of(model.mesh.triangles)),
        rest(rest_shape(
            model.options, unit(model), edges,
            model.options.unit_box_curvatures.value_or(curvature(unit(model).positions, model.mesh.triangles)))),
        step(cpu_backend()->transform(rest)),
        vertices(vertex_system(rest, {})),
        transforms(transform_system(rest)),
        handles{{0, 1}, rest.vertices.topRows(2), step_weights(model.options, unit(model)).handle} {}

  static Mesh unit(const Model& model) {
    return {unit_box(model.mesh.positions).into(model.mesh.positions), model.mesh.triangles};
  }
};

void vertex_step(benchmark::State& state, const Model& model) {
  Parts parts(model);
  TransformStep::EdgeQuadratics quadratics;
  const Transforms transforms = identities(parts.rest.triangles.rows());
  for (auto _ : state) {
    parts.step->fit_edges(transforms, quadratics);
    benchmark::DoNotOptimize(
        place_vertices(parts.vertices, parts.rest, quadratics, parts.straight, 0, {parts.handles}));
  }
  state.counters["unknowns"] = static_cast<double>(parts.vertices.system.unknowns());
  state.counters["factor_entries"] = static_cast<double>(parts.vertices.system.factor_entries());
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

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

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
}

ReshapeResult solve_once(const Model& model, const ReshapeOptions& options) {
  return reshape(model.mesh.positions, model.mesh.triangles, model.gesture, options);
}

void solve_first(benchmark::State& state, const Model& model) {
  time_solves(state, "first/" + model.name, [&] { return solve_once(model, model.options); });
}

void solve_again(benchmark::State& state, const Model& model) {
  Reshape prepared(model.mesh.positions, model.mesh.triangles, model.options);
  prepared.prepare();
  time_solves(state, "again/" + model.name, [&] { return prepared.solve(model.gesture); });
}

void solve_as_published(benchmark::State& state, const Model& model) {
  ReshapeOptions options = model.options;
  options.solver = ReshapeSolver::published;
  options.refactor_every_pass = true;
  const std::string name = "published/" + model.name;
  time_solves(state, name, [&] { return solve_once(model, options); });
  for (const std::string stage : {"first", "again"}) {
    const std::vector<double>& ours = seconds_of_solves()[stage + '/' + model.name];
    if (ours.empty()) continue;
    state.counters["times_slower_than_" + stage] = median(seconds_of_solves()[name]) / median(ours);
  }
}

}  // namespace

void register_all() {
  static std::vector<Model> models = reference_models();
  models.push_back(lifted_cylinder(64, 20));
  for (const Model& model : models) {
    auto add = [&](const std::string& stage, auto run) {
      return benchmark::RegisterBenchmark((stage + "/" + model.name).c_str(), run)->Unit(benchmark::kMillisecond);
    };
    add("prepare", [&model](benchmark::State& state) { prepare(state, model); });
    add("vertex_step", [&model](benchmark::State& state) { vertex_step(state, model); });
    add("transform_factor", [&model](benchmark::State& state) { transform_factor(state, model); });
    add("transform_step", [&model](benchmark::State& state) { transform_step(state, model); });
    auto add_solve = [&](const std::string& stage, int times, auto run) {
      add(stage, [&model, run](benchmark::State& state) { run(state, model); })->Iterations(times)->UseManualTime();
    };
    add_solve("solve_first", 5, solve_first);
    add_solve("solve_again", 5, solve_again);
    add_solve("solve_as_published", 1, solve_as_published);
  }
}

}  // namespace swage::bench

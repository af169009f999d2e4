// Resizing, of grids alone: a car's map on the grids of the paper's table 1. `first`: from the map to the vertices.
// `again`: by other factors, on what is prepared; `scales` and `assembly` of it. Counters: iterations of conjugate
// gradients, rounds at the bounds.
#include <benchmark/benchmark.h>

#include <array>
#include <string>

#include "assemble.h"
#include "bench_main.h"
#include "cell_maps.h"
#include "scales.h"

namespace swage::bench {
namespace {

using Factors = Eigen::RowVector3d;

struct Setting {
  std::array<int, 3> cells;
  Factors factors;
};

GridShape shape_of(const Setting& setting) {
  return test::unit_cells(setting.cells[0], setting.cells[1], setting.cells[2]);
}

void count(benchmark::State& state, const std::string& of, int iterations, int rounds) {
  state.counters[of + "_iterations"] = iterations;
  state.counters[of + "_rounds"] = rounds;
}

void first(benchmark::State& state, const Setting& setting) {
  const GridShape shape = shape_of(setting);
  const CellMap map = test::car_map(shape);
  for (auto _ : state) {
    const ScaleSolve solve(shape, map);
    const Assembly assembly(shape, map);
    benchmark::DoNotOptimize(assembly.place(solve.solve(setting.factors).values, setting.factors).positions.sum());
  }
}

void again(benchmark::State& state, const Setting& setting) {
  const GridShape shape = shape_of(setting);
  const CellMap map = test::car_map(shape);
  const ScaleSolve solve(shape, map);
  const Assembly assembly(shape, map);
  for (auto _ : state) {
    benchmark::DoNotOptimize(assembly.place(solve.solve(setting.factors).values, setting.factors).positions.sum());
  }
}

void scales(benchmark::State& state, const Setting& setting) {
  const GridShape shape = shape_of(setting);
  const ScaleSolve solve(shape, test::car_map(shape));
  Scales found;
  for (auto _ : state) found = solve.solve(setting.factors);
  count(state, "scale", found.iterations, found.rounds);
}

void assembly(benchmark::State& state, const Setting& setting) {
  const GridShape shape = shape_of(setting);
  const CellMap map = test::car_map(shape);
  const Scales scales = ScaleSolve(shape, map).solve(setting.factors);
  const Assembly assembly(shape, map);
  GridVertices found;
  for (auto _ : state) found = assembly.place(scales.values, setting.factors);
  count(state, "assembly", found.iterations, found.rounds);
  state.counters["stiffened"] = found.stiffened;
}

}  // namespace

void register_all() {
  const std::array<std::array<int, 3>, 3> grids = {{{80, 52, 50}, {20, 20, 57}, {60, 60, 60}}};
  const std::array<std::pair<const char*, Factors>, 4> stretches = {
      {{"1.4", {1.4, 1, 1}}, {"2", {2, 1, 1}}, {"half", {1, 0.5, 1}}, {"third_and_thrice", {0.3, 1, 3}}}};
  for (const auto& [x, y, z] : grids) {
    for (const auto& [name, factors] : stretches) {
      const Setting setting = {{x, y, z}, factors};
      std::string of;
      for (const int along : {x, y, z}) of += (of.empty() ? '/' : 'x') + std::to_string(along);
      of.append("/").append(name);
      const auto add = [&](const char* what, auto run) {
        benchmark::RegisterBenchmark((std::string(what) + of).c_str(),
                                     [=](benchmark::State& state) { run(state, setting); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
      };
      add("first", first);
      add("again", again);
      add("scales", scales);
      add("assembly", assembly);
    }
  }
}

}  // namespace swage::bench

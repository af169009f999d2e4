// Resizing, of grids alone: a car's map on the grids of the paper's table 1. `first`: from the map to the vertices.
// `again`: by other factors, on what is prepared; `scales` and `assembly` of it. Counters: iterations of conjugate
// gradients, rounds at the bounds, entries there.
#include <benchmark/benchmark.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

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

/// `found`: Scales or GridVertices.
template <typename Found>
void count(benchmark::State& state, const std::string& of, const Found& found) {
  state.counters[of + "_iterations"] = found.iterations;
  state.counters[of + "_rounds"] = found.rounds;
  state.counters[of + "_at_bound"] = static_cast<double>(found.at_bound);
  state.counters[of + "_converged"] = found.converged ? 1 : 0;
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
  count(state, "scale", found);
}

void assembly(benchmark::State& state, const Setting& setting) {
  const GridShape shape = shape_of(setting);
  const CellMap map = test::car_map(shape);
  const Scales scales = ScaleSolve(shape, map).solve(setting.factors);
  const Assembly assembly(shape, map);
  GridVertices found;
  for (auto _ : state) found = assembly.place(scales.values, setting.factors);
  count(state, "assembly", found);
  state.counters["stiffened"] = found.stiffened;
}

void add(const std::string& grid, const std::string& name, const Setting& setting) {
  const auto one = [&](const char* what, auto run) {
    benchmark::RegisterBenchmark((what + grid + "/" + name).c_str(),
                                 [=](benchmark::State& state) { run(state, setting); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  one("first", first);
  one("again", again);
  one("scales", scales);
  one("assembly", assembly);
}

using Stretch = std::pair<std::string, Factors>;

}  // namespace

void register_all() {
  const std::vector<Stretch> mild = {
      {"1.4", {1.4, 1, 1}}, {"2", {2, 1, 1}}, {"half", {1, 0.5, 1}}, {"third_and_thrice", {0.3, 1, 3}}};
  std::vector<Stretch> strong = {mild.back()};
  for (int u = 0; u < 3; ++u) {
    for (const auto& [name, factor] : {std::pair{"twentieth_", 0.05}, {"twenty_", 20.0}}) {
      Factors factors(1, 1, 1);
      factors[u] = factor;
      strong.emplace_back(std::string(name) + "xyz"[u], factors);
    }
  }
  const auto add_all = [](const std::array<int, 3>& cells, const std::vector<Stretch>& stretches) {
    std::string grid;
    for (const int along : cells) grid += (grid.empty() ? '/' : 'x') + std::to_string(along);
    for (const auto& [name, factors] : stretches) add(grid, name, {cells, factors});
  };
  add_all({80, 52, 50}, mild);
  add_all({20, 20, 57}, mild);
  add_all({60, 60, 60}, mild);
  add_all({60, 40, 30}, strong);
}

}  // namespace swage::bench

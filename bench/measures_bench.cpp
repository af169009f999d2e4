// compare(): the measures of a smooth edit of a torus, by its triangles; `self_intersections` is the search for
// crossing triangles alone, done twice by the former. `peak_MB` is the most memory that the process held meanwhile (of
// its whole life so far where /proc/self/clear_refs may not be written), meshes in it.
#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <string>

#include "bench_main.h"
#include "intersections.h"
#include "peak_memory.h"
#include "shapes.h"
#include "swage/compare.h"

namespace swage::bench {
namespace {

/// Of about as many triangles.
Mesh torus_of(int triangles) {
  const int around = static_cast<int>(std::sqrt(triangles / 2.0));
  return test::torus(1, 0.4, around, around);
}

void add(const std::string& name, int triangles, const std::function<void(const Mesh&, const Positions&)>& run) {
  benchmark::RegisterBenchmark((name + "/" + std::to_string(triangles)).c_str(),
                               [=](benchmark::State& state) {
                                 const Mesh mesh = torus_of(triangles);
                                 const Positions edit = mesh.positions.array() + 0.1 * mesh.positions.array().sin();
                                 reset_peak_memory();
                                 for (auto _ : state) run(mesh, edit);
                                 state.SetItemsProcessed(state.iterations() * mesh.triangles.rows());
                                 state.counters["peak_MB"] = peak_memory();
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace

void register_all() {
  for (const int triangles : {10'000, 100'000, 1'000'000}) {
    add("compare", triangles, [](const Mesh& mesh, const Positions& edit) {
      benchmark::DoNotOptimize(compare(mesh.positions, edit, mesh.triangles).slippage_loss.mean);
    });
    add("self_intersections", triangles, [](const Mesh& mesh, const Positions&) {
      benchmark::DoNotOptimize(self_intersections(mesh.positions, mesh.triangles, 1).pairs.data());
    });
  }
}

}  // namespace swage::bench

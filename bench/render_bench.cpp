// Pictures: two panels of a torus of 50,000 triangles, an edit of it with a heat map, 1600 × 900 as by default.
// `no_shadows` is what all else takes.
#include <benchmark/benchmark.h>

#include <cmath>

#include "bench_main.h"
#include "shapes.h"
#include "swage/render.h"

namespace swage::bench {
namespace {

/// Of about as many triangles.
Mesh torus_of(int triangles) {
  const int around = static_cast<int>(std::sqrt(triangles / 2.0));
  return test::torus(1, 0.4, around, around);
}

std::vector<Panel> panels_of(int triangles) {
  Panel rest, edit;
  rest.mesh = edit.mesh = torus_of(triangles);
  edit.mesh.positions.array() += 0.1 * rest.mesh.positions.array().sin();
  edit.face_values = rest.mesh.positions(rest.mesh.triangles.col(0), 0);
  rest.title = "before";
  edit.title = "after";
  return {rest, edit};
}

void add(const std::string& name, int triangles, const RenderOptions& options) {
  benchmark::RegisterBenchmark((name + "/" + std::to_string(triangles)).c_str(),
                               [=](benchmark::State& state) {
                                 const std::vector<Panel> panels = panels_of(triangles);
                                 for (auto _ : state) benchmark::DoNotOptimize(render(panels, options).rgb.data());
                               })
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

}  // namespace

void register_all() {
  if (!can_render()) return;
  RenderOptions without_shadows;
  without_shadows.ambient_rays = 0;
  for (const int triangles : {50'000, 1'000'000}) {
    add("render", triangles, {});
    add("render/no_shadows", triangles, without_shadows);
  }
  benchmark::RegisterBenchmark("png", [](benchmark::State& state) {
    const Image image = render(panels_of(50'000));
    for (auto _ : state) benchmark::DoNotOptimize(png(image).data());
  })->Unit(benchmark::kMillisecond);
}

}  // namespace swage::bench

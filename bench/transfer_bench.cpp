// Transfer: points hung on a bumpy sphere of 81,920 triangles, and carried when it moves. `attach/16` casts 16 rays a
// point, `attach/0` none: closest points alone; the surface's preparation is in the times. `rays_per_second` counts
// them over the whole time; `rays` casts the same rays at their full length and does nothing else. `peak_MB` is the
// most memory that the process held meanwhile (of its whole life so far where /proc/self/clear_refs may not be
// written), points and attachments in it.
#include <benchmark/benchmark.h>

#include <functional>
#include <limits>
#include <string>

#include "bench_main.h"
#include "foot_search.h"
#include "peak_memory.h"
#include "points_near.h"
#include "swage/error.h"
#include "swage/transfer.h"

namespace swage::bench {
namespace {

const std::vector<int> kCounts = {10'000, 100'000, 1'000'000};

const Mesh& surface() {
  static const Mesh kSurface = test::bumpy_sphere(6);
  return kSurface;
}

Positions points_near_surface(int count) { return test::points_near(surface(), count, 1); }

void count_rays(benchmark::State& state, double rays) {
  const double all = rays * static_cast<double>(state.iterations());
  state.counters["rays_per_second"] = benchmark::Counter(all, benchmark::Counter::kIsRate);
}

void add(const std::string& name, int count, const std::function<void(benchmark::State&, const Positions&)>& run) {
  benchmark::RegisterBenchmark((name + "/" + std::to_string(count)).c_str(),
                               [=](benchmark::State& state) {
                                 const Positions points = points_near_surface(count);
                                 reset_peak_memory();
                                 try {
                                   run(state, points);
                                 } catch (const Unavailable& reason) {
                                   state.SkipWithError(reason.what());
                                 }
                                 state.SetItemsProcessed(state.iterations() * count);
                                 state.counters["peak_MB"] = peak_memory();
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

void add_attach(int directions, int count) {
  add("attach/" + std::to_string(directions), count, [=](benchmark::State& state, const Positions& points) {
    for (auto _ : state) {
      benchmark::DoNotOptimize(
          attach(points, surface().positions, surface().triangles, {.directions = directions}).triangles.data());
    }
    count_rays(state, static_cast<double>(points.rows()) * directions);
  });
}

void add_rays(int directions, int count) {
  add("rays/" + std::to_string(directions), count, [=](benchmark::State& state, const Positions& points) {
    const RayScene scene(surface().positions, surface().triangles);
    const std::vector<Eigen::Vector3d> ways = sphere_directions(directions);
    for (auto _ : state) {
      long hits = 0;
#pragma omp parallel for schedule(static) reduction(+ : hits)
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        for (const Eigen::Vector3d& way : ways) {
          hits += scene.first_hit(points.row(i), way, std::numeric_limits<double>::infinity()) >= 0;
        }
      }
      benchmark::DoNotOptimize(hits);
    }
    count_rays(state, static_cast<double>(points.rows()) * directions);
  });
}

/// By the surface's own deformation gradients.
void add_carry(int count) {
  add("carry", count, [=](benchmark::State& state, const Positions& points) {
    const Attachments attachments = attach(points, surface().positions, surface().triangles);
    const Positions moved = surface().positions.array().sin();
    for (auto _ : state) {
      benchmark::DoNotOptimize(carry(attachments, surface().triangles, surface().positions, moved).data());
    }
  });
}

}  // namespace

void register_all() {
  for (const int count : kCounts) {
    for (const int directions : {0, 16, 64}) add_attach(directions, count);
  }
  for (const int count : kCounts) add_rays(16, count);
  for (const int count : kCounts) add_carry(count);
}

}  // namespace swage::bench

// The local steps: step × backend × precision × elements. `copy_share` is what a step's kernels read and write, each
// array once a kernel, per second, in parts of what a plain copy reaches in the same run. What crosses to the device
// and back is in the steps' times, `up_per_element` and `down_per_element` are its bytes; upload and download also
// stand apart. Building kernels is in none: `build_s`. `flop_share` is a device's arithmetic in parts of what it
// reaches in the same run where nothing waits.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench_main.h"
#include "element_pairs.h"
#include "flops.h"
#include "measures.h"
#include "plan.h"
#include "procrustes.h"
#include "sides.h"
#include "spokes_and_rims.h"
#include "step_inputs.h"
#include "swage/curvature.h"
#include "swage/template.h"
#ifdef SWAGE_BENCH_OPENCL
#include "device_peak.h"
#include "devices.h"
#include "kernel.h"
#endif

namespace swage::bench {
namespace {

using Eigen::Index;

/// What a benchmark repeats.
struct Work {
  std::function<void()> run;
  double bytes_per_element;
  Flops flops_per_element = {};
};

#ifdef SWAGE_BENCH_OPENCL
Queue queue_on(Precision precision) {
  const FoundDevice& device = choose_device("", precision);
  return Queue(std::make_shared<Context>(device.handle, precision, ProgramCache()));
}

double peak_on_device(Precision precision) { return peak_flops(queue_on(precision)); }

std::string opencl_device() {
  if (found_devices().empty()) return "none";
  const Device& device = found_devices().front().facts;
  return device.name + ", " + device.platform + ' ' + device.driver;
}
#else
std::string opencl_device() { return "none"; }
double peak_on_device(Precision) { return 0; }
#endif

struct Choice {
  std::string name;
  std::function<std::shared_ptr<Backend>()> backend;
  double real_size;  // Bytes.
  std::function<double()> peak_flops;
};

std::vector<Choice> choices() {
  auto on_device = [](const std::string& name, Precision precision, double real_size) {
    return Choice{"opencl/" + name, [=] { return opencl_backend("", precision); }, real_size,
                  [=] { return peak_on_device(precision); }};
  };
  return {{"cpu/double", [] { return cpu_backend(); }, 8, [] { return 0; }},
          on_device("single", Precision::single, 4),
          on_device("double", Precision::twice, 8)};
}

const std::vector<int> kSizes = {10'000, 100'000, 1'000'000};

/// Bytes per second, read and written, of the best of a few copies by all threads.
double copy_bandwidth() {
  static const double kBandwidth = [] {
    const Eigen::VectorXf from = Eigen::VectorXf::Ones(1 << 25);
    Eigen::VectorXf to = Eigen::VectorXf::Zero(from.size());
    double best = 0;
    for (int i = 0; i < 7; ++i) {
      const auto start = std::chrono::steady_clock::now();
#pragma omp parallel for schedule(static)
      for (Index k = 0; k < 64; ++k) to.segment(k << 19, 1 << 19) = from.segment(k << 19, 1 << 19);
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      best = std::max(best, 2 * 4 * static_cast<double>(from.size()) / seconds.count());
    }
    return best;
  }();
  return kBandwidth;
}

void repeat(benchmark::State& state, const Work& work, int elements) {
  work.run();  // Kernels are built, pages touched.
  for (auto _ : state) work.run();
  state.SetItemsProcessed(state.iterations() * elements);
  const double bytes = work.bytes_per_element * elements * static_cast<double>(state.iterations());
  state.counters["bytes_per_element"] = work.bytes_per_element;
  state.counters["copy_share"] = benchmark::Counter(bytes / copy_bandwidth(), benchmark::Counter::kIsRate);
}

void count_flops(benchmark::State& state, const Flops& per_element, int elements, double peak) {
  if (per_element.all() == 0 || peak == 0) return;
  const double flops = static_cast<double>(per_element.all()) * elements * static_cast<double>(state.iterations());
  state.counters["flops_per_element"] = per_element.all();
  state.counters["roots_and_quotients"] = per_element.roots + per_element.quotients;
  state.counters["flops"] = benchmark::Counter(flops, benchmark::Counter::kIsRate);
  state.counters["flop_share"] = benchmark::Counter(flops / peak, benchmark::Counter::kIsRate);
}

using Prepare = std::function<Work(const Backend& backend, int elements, double real_size)>;

void add_step(const std::string& step, const Prepare& prepare) {
  for (const Choice& choice : choices()) {
    for (const int elements : kSizes) {
      add_benchmark(step + "/" + choice.name + "/" + std::to_string(elements), [=](benchmark::State& state) {
        const std::shared_ptr<Backend> backend = choice.backend();
        const Work work = prepare(*backend, elements, choice.real_size);
        const Traffic before = backend->traffic();
        repeat(state, work, elements);
        const Traffic after = backend->traffic();
        const double results = elements * static_cast<double>(state.iterations() + 1);
        state.counters["up_per_element"] = static_cast<double>(after.uploaded - before.uploaded) / results;
        state.counters["down_per_element"] = static_cast<double>(after.downloaded - before.downloaded) / results;
        state.counters["build_s"] = after.build_seconds;
        count_flops(state, work.flops_per_element, elements, choice.peak_flops());
      });
    }
  }
}

constexpr double kIndex = 4, kHost = 8;  // Bytes of an index and of a number of the host's.

/// An element a triangle: its place in the list, three pairs with their edges, half a vertex, and a matrix.
Work pairs_work(const Backend& backend, int elements, double real_size, bool similarity) {
  const Mesh mesh = mesh_of(elements);
  const PairsRest rest = test::triangle_pairs(mesh);
  const Positions moved = (2 * mesh.positions).array().sin();
  const auto result = std::make_shared<Transforms>();
  const double bytes = 7 * kIndex + 9 * real_size + (1.5 + 9) * kHost;
  if (similarity) {
    const std::shared_ptr<SimilarityStep> step = backend.similarity(rest);
    return {[=] { step->fit(moved, Positions(0, 3), *result); }, bytes + real_size, flops_of_similarity(3)};
  }
  const std::shared_ptr<RotationStep> step = backend.rotation(rest);
  return {[=] { step->fit(moved, Positions(0, 3), *result); }, bytes, flops_of_rotation(3)};
}

void add_rotation() {
  add_step("rotation", [](const Backend& backend, int elements, double real_size) {
    return pairs_work(backend, elements, real_size, false);
  });
}

void add_similarity() {
  add_step("similarity", [](const Backend& backend, int elements, double real_size) {
    return pairs_work(backend, elements, real_size, true);
  });
}

/// A pass of reshaping. An element a triangle: its transform, read twice, its inverse, written and read twice, normal,
/// edges' vectors, right-hand side and half a vertex; one and a half edges with their rest, weights and quadratics.
void add_transform() {
  add_step("transform", [](const Backend& backend, int elements, double real_size) {
    const TransformStep::Rest rest = reshape_rest(elements);
    const std::shared_ptr<TransformStep> step = backend.transform(rest);
    const Transforms transforms = 1.1 * identities(elements);
    const Positions moved = (2 * rest.vertices).array().sin();
    const auto quadratics = std::make_shared<TransformStep::EdgeQuadratics>();
    const auto sides = std::make_shared<Transforms>();
    return Work{[=] {
                  step->fit_edges(transforms, *quadratics);
                  step->fit_transforms(moved, *sides);
                },
                (2 * 9 + 9 + 1.5 + 1.5 * 10) * kHost + (3 * 9 + 2 * 3 + 12 + 2 * 3 + 1.5 * (8 + 1)) * real_size +
                    (1.5 * 3 + 3) * kIndex,
                flops_of_transform()};
  });
}

/// An element a triangle: two matrices, its own block and what it shares with three neighbours.
void add_coupling() {
  add_step("coupling", [](const Backend& backend, int elements, double real_size) {
    const std::shared_ptr<CouplingStep> step = backend.coupling(reshape_rest(elements));
    const Transforms transforms = 1.1 * identities(elements);
    const auto product = std::make_shared<Transforms>();
    return Work{[=] { step->apply(transforms, *product); }, 2 * 9 * kHost + 33 * real_size + 3 * kIndex,
                flops_of_coupling()};
  });
}

/// An element a vertex: its neighbours, a position and a normal, and two curvatures.
void add_curvature() {
  add_step("curvature", [](const Backend& backend, int elements, double real_size) {
    const CurvatureStep::Rest rest = curvature_rest(elements);
    const std::shared_ptr<CurvatureStep> step = backend.curvature(rest);
    const auto result = std::make_shared<Curvatures>();
    const double neighbours = static_cast<double>(rest.neighbours.size()) / elements;
    return Work{[=] { step->fit(*result); }, 2 * kIndex + neighbours * kIndex + (3 + 3) * real_size + 2 * kHost,
                flops_of_curvature(static_cast<int>(neighbours), real_size)};
  });
}

/// An element a vertex: six triangles with an area vector between two vertices each, and what is found.
void add_normal_fit() {
  add_step("normal_fit", [](const Backend& backend, int elements, double) {
    const Mesh mesh = mesh_of(2 * elements);
    const std::shared_ptr<NormalFitStep> step = backend.normal_fit(test::triangles_around(mesh));
    const Positions areas = area_vectors(mesh.positions, mesh.triangles);
    const auto directions = std::make_shared<Transforms>();
    const auto spreads = std::make_shared<Positions>();
    return Work{[=] { step->fit(areas, *directions, *spreads); }, 7 * kIndex + (2 * 3 + 12) * kHost};
  });
}

/// An element a vertex: its normal and the number of the closest of ten thousand.
void add_closest_normal() {
  add_step("closest_normal", [](const Backend& backend, int elements, double) {
    const Positions styles = normalised(Positions::Random(10'000, 3));
    const Positions units = normalised(Positions::Random(elements, 3));
    const std::shared_ptr<ClosestNormalStep> step = backend.closest_normal(styles);
    const auto closest = std::make_shared<Eigen::VectorXi>();
    return Work{[=] { step->find(units, *closest); }, 3 * kHost + kIndex};
  });
}

/// An element a triangle: its corners four times, its sides' rings, half a vertex five times, its slippage, and a cell
/// or two; half a vertex more to carry.
void add_carry() {
  add_step("carry", [](const Backend& backend, int elements, double) {
    const auto mesh = std::make_shared<Mesh>(mesh_of(elements));
    const Lists corners = corners_of_vertices(mesh->triangles, static_cast<int>(mesh->positions.rows()));
    const std::shared_ptr<CarryStep> step = backend.carry({mesh, next_sides(mesh->triangles, corners)});
    const Eigen::RowVector3d low = mesh->positions.colwise().minCoeff(), high = mesh->positions.colwise().maxCoeff();
    const GridShape shape = {{{60, 60, 18}}, low, high - low};
    const auto means = std::make_shared<AxisValues>();
    const auto counts = std::make_shared<Eigen::VectorXi>(), cells = std::make_shared<Eigen::VectorXi>();
    const auto carried = std::make_shared<Positions>();
    const AxisValues grid = 1.1 * rest_vertices(shape);
    return Work{[=] {
                  const Slice all = {0, mesh->triangles.rows()};
                  step->slippage(all, *means);
                  step->count_cells(shape, all, *counts);
                  step->list_cells(shape, all, *counts, *cells);
                  step->carry(shape, grid, *carried);
                },
                (4 * 3 + 3 + 2 + 1.5) * kIndex + (2.5 * 3 + 3 + 1.5) * kHost};
  });
}

/// A point in and around a couch: its place, the field's value and gradient there.
void add_field() {
  add_step("field", [](const Backend& backend, int elements, double) {
    const Template couch = shipped_template("couch");
    const Positions points = 1.5 * Positions::Random(elements, 3);
    const std::shared_ptr<FieldStep> step = couch.field(backend);
    const auto field = std::make_shared<FieldValues>();
    return Work{
        [=, parameters = couch.defaults()] { step->evaluate(points, parameters, FieldDerivatives::in_space, *field); },
        (3 + 1 + 3) * kHost};
  });
}

/// An element a vertex: its spokes and rims with their edges, two normals, a position, and a map. Normals are fitted,
/// as in edits by templates.
void add_local_map() {
  add_step("local_map", [](const Backend& backend, int elements, double real_size) {
    const Mesh mesh = mesh_of(2 * elements);
    LocalMapStep::Rest rest;
    rest.pairs = vertex_elements(mesh, Positions::Ones(mesh.triangles.rows(), 3)).pairs;
    rest.pairs.normals = vertex_normals(mesh.positions, mesh.triangles);
    rest.guidance = 0.1;
    const double pairs = static_cast<double>(rest.pairs.pairs.rows()) / elements;
    const std::shared_ptr<LocalMapStep> step = backend.local_map(rest);
    const Mesh moved = {(2 * mesh.positions).array().sin(), mesh.triangles};
    const Positions normals = vertex_normals(moved.positions, moved.triangles);
    const auto maps = std::make_shared<Transforms>();
    return Work{[=] { step->fit(moved.positions, normals, *maps); },
                kIndex + pairs * (2 * kIndex + 4 * real_size) + 3 * real_size + (2 * 3 + 9) * kHost};
  });
}

/// The closest rotations alone, of matrices that lie where they are needed.
void add_closest_rotation_by_cpu() {
  for (const int elements : kSizes) {
    add_benchmark("closest_rotation/cpu/double/" + std::to_string(elements), [=](benchmark::State& state) {
      const Transforms matrices = Transforms::Random(elements, 9);
      Transforms rotations(elements, 9);
      const Work work{[&] {
#pragma omp parallel for schedule(static)
                        for (Index i = 0; i < elements; ++i) {
                          store(closest_rotation(test::matrix(matrices, i)), rotations, i);
                        }
                      },
                      2 * 9 * 8};
      repeat(state, work, elements);
    });
  }
}

#ifdef SWAGE_BENCH_OPENCL
using DeviceRun = std::function<void(benchmark::State& state, const Queue& queue, int elements, double real_size)>;

void add_device(const std::string& name, const DeviceRun& run) {
  for (const auto& [label, precision, real_size] :
       {std::tuple{"single", Precision::single, 4.0}, std::tuple{"double", Precision::twice, 8.0}}) {
    for (const int elements : kSizes) {
      add_benchmark(name + "/opencl/" + label + "/" + std::to_string(elements),
                    [=, precision = precision, real_size = real_size](benchmark::State& state) {
                      run(state, queue_on(precision), elements, real_size);
                    });
    }
  }
}

void add_closest_rotation_by_device() {
  add_device("closest_rotation", [](benchmark::State& state, Queue queue, int elements, double real_size) {
    const Reals matrices(queue, Transforms::Random(elements, 9)), rotations(queue, Index{9} * elements);
    Kernel fit(queue, "rotation", "closest_rotations");
    const int lanes = queue.context->lanes("rotation");  // Divides all sizes.
    const Work work{[&] {
                      fit.launch(elements / lanes, elements, matrices, rotations);
                      queue.handle.finish();
                    },
                    2 * 9 * real_size};
    repeat(state, work, elements);
    count_flops(state, flops_of_closest_rotation(), elements, peak_flops(queue));
  });
}

/// What a step with a position and a matrix an element sends over.
void add_crossings() {
  add_device("upload", [](benchmark::State& state, const Queue& queue, int elements, double real_size) {
    const Positions positions = Positions::Random(elements, 3);
    Reals array(queue, positions.size());
    repeat(state, {[&] { array.upload(positions, Layout::rows); }, 3 * (8 + real_size)}, elements);
  });
  add_device("download", [](benchmark::State& state, const Queue& queue, int elements, double real_size) {
    Transforms matrices = Transforms::Random(elements, 9);
    const Reals array(queue, matrices);
    repeat(state, {[&] { array.download(matrices); }, 9 * (8 + real_size)}, elements);
  });
}
#endif

}  // namespace

void register_all() {
  benchmark::AddCustomContext("copy_bytes_per_second", std::to_string(copy_bandwidth()));
  benchmark::AddCustomContext("opencl_device", opencl_device());
  add_rotation();
  add_similarity();
  add_transform();
  add_coupling();
  add_curvature();
  add_normal_fit();
  add_closest_normal();
  add_carry();
  add_field();
  add_local_map();
  add_closest_rotation_by_cpu();
#ifdef SWAGE_BENCH_OPENCL
  add_closest_rotation_by_device();
  add_crossings();
#endif
}

}  // namespace swage::bench

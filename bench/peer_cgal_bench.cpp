// ARAP (as rigid as possible: Sorkine and Alexa 2007) by CGAL's Surface_mesh_deformation, for scale: the meshes and
// handles of methods_bench, every vertex but the handles free, 10 iterations whether they suffice or not. ARAP does
// other work than reshaping: it keeps the size of everything, where reshaping keeps what slips and stretches the rest;
// it factors one matrix of #V unknowns, for x, y and z alike, before its iterations, where reshaping has one of 3 #V
// that changes in every pass and one of 9 #T. So these figures say what another edit costs, not who does the same
// faster; deform_bench says that of ARAP.
//
// `preprocess` makes the object, weighs the edges and factors; `deform` iterates from the rest shape.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "bench_main.h"
#include "cgal_arap.h"
#include "reference_models.h"
#include "swage/error.h"

namespace swage::bench {
namespace {

constexpr int kIterations = 10;

using Run = void (*)(benchmark::State&, const Mesh&, const Gesture&);

void preprocess(benchmark::State& state, const Mesh& mesh, const Gesture& gesture) {
  for (auto _ : state) test::CgalArap(mesh, gesture);
}

void deform(benchmark::State& state, const Mesh& mesh, const Gesture& gesture) {
  test::CgalArap arap(mesh, gesture);
  for (auto _ : state) arap.solve(kIterations);
  state.counters["iterations"] = kIterations;
}

void run(benchmark::State& state, Run stage, const Mesh& mesh, const Gesture& gesture) {
  try {
    stage(state, mesh, gesture);
    state.counters["triangles"] = static_cast<double>(mesh.triangles.rows());
  } catch (const Unsolvable& why) {
    state.SkipWithError(why.what());
  }
}

}  // namespace

void register_all() {
  static std::vector<Model> models = reference_models();
  models.push_back(lifted_cylinder(64, 20));
  for (const Model& model : models) {
    for (const Gesture& gesture : model.gestures) {
      const auto add = [&](const std::string& name, Run stage) {
        benchmark::RegisterBenchmark(
            (name + '/' + model.name + '/' + gesture.label).c_str(),
            [&model, &gesture, stage](benchmark::State& state) { run(state, stage, model.mesh, gesture); })
            ->Unit(benchmark::kMillisecond)
            ->Iterations(3)
            ->UseRealTime();
      };
      add("cgal_arap_preprocess", preprocess);
      add("cgal_arap_deform", deform);
    }
  }
}

}  // namespace swage::bench

// ARAP (as rigid as possible: Sorkine and Alexa 2007) by CGAL's Surface_mesh_deformation, for scale: the meshes and
// handles of methods_bench, every vertex but the handles free, 10 iterations whether they suffice or not. ARAP does
// other work than reshaping: it keeps the size of everything, where reshaping keeps what slips and stretches the rest;
// it factors one matrix of #V unknowns, for x, y and z alike, before its iterations, where reshaping has one of 3 #V
// that changes in every pass and one of 9 #T. So these figures say what another edit costs, not who does the same
// faster.
//
// All is CGAL's default but the energy (its default is spokes and rims): Eigen's SparseLU, polar decompositions, one
// thread. `preprocess` makes the object, weighs the edges and factors; `deform` iterates from the rest shape.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>
#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "bench_main.h"
#include "reference_models.h"
#include "stopwatch.h"

namespace swage::bench {
namespace {

constexpr int kIterations = 10;

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Arap = CGAL::Surface_mesh_deformation<Surface, CGAL::Default, CGAL::Default, CGAL::ORIGINAL_ARAP>;

CGAL::SM_Vertex_index vertex(int i) { return CGAL::SM_Vertex_index(static_cast<CGAL::SM_Vertex_index::size_type>(i)); }

/// No faces where CGAL does not take them, as at a vertex that two fans of triangles share.
Surface surface_of(const Mesh& mesh) {
  Surface surface;
  for (const auto& p : mesh.positions.rowwise()) surface.add_vertex(Point(p[0], p[1], p[2]));
  for (const auto& t : mesh.triangles.rowwise()) {
    if (surface.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])) == Surface::null_face()) return {};
  }
  return surface;
}

std::unique_ptr<Arap> held(Surface& surface, const Gesture& gesture) {
  auto arap = std::make_unique<Arap>(surface);
  arap->insert_roi_vertices(surface.vertices().begin(), surface.vertices().end());
  for (const auto& [i, target] : gesture.targets) arap->insert_control_vertex(vertex(i));
  return arap;
}

void preprocess(benchmark::State& state, const Model& model, const Gesture& gesture) {
  Surface mesh = surface_of(model.mesh);
  if (mesh.number_of_faces() == 0) return state.SkipWithError("CGAL takes the mesh for no manifold");
  for (auto _ : state) {
    double seconds = 0;
    {
      const Stopwatch watch(seconds);
      if (!held(mesh, gesture)->preprocess()) {
        state.SkipWithError("CGAL finds the system singular");
        break;
      }
    }
    state.SetIterationTime(seconds);
  }
  state.counters["triangles"] = static_cast<double>(mesh.number_of_faces());
}

void deform(benchmark::State& state, const Model& model, const Gesture& gesture) {
  Surface mesh = surface_of(model.mesh);
  if (mesh.number_of_faces() == 0) return state.SkipWithError("CGAL takes the mesh for no manifold");
  const std::unique_ptr<Arap> arap = held(mesh, gesture);
  if (!arap->preprocess()) return state.SkipWithError("CGAL finds the system singular");
  for (auto _ : state) {
    double seconds = 0;
    arap->reset();
    for (const auto& [i, target] : gesture.targets) {
      arap->set_target_position(vertex(i), Point(target[0], target[1], target[2]));
    }
    {
      const Stopwatch watch(seconds);
      arap->deform(kIterations, 0);  // No tolerance: all iterations, and no energy computed in between.
    }
    state.SetIterationTime(seconds);
  }
  state.counters["triangles"] = static_cast<double>(mesh.number_of_faces());
  state.counters["iterations"] = kIterations;
}

}  // namespace

void register_all() {
  static std::vector<Model> models = reference_models();
  models.push_back(lifted_cylinder(64, 20));
  for (const Model& model : models) {
    for (const Gesture& gesture : model.gestures) {
      auto add = [&](const std::string& stage, auto run) {
        benchmark::RegisterBenchmark((stage + '/' + model.name + '/' + gesture.label).c_str(),
                                     [&model, &gesture, run](benchmark::State& state) { run(state, model, gesture); })
            ->Unit(benchmark::kMillisecond)
            ->Iterations(3)
            ->UseManualTime();
      };
      add("cgal_arap_preprocess", preprocess);
      add("cgal_arap_deform", deform);
    }
  }
}

}  // namespace swage::bench

#include "reshape.h"

#include <spdlog/spdlog.h>

#include <memory>
#include <numbers>
#include <utility>

#include "backend_choice.h"
#include "deform.h"
#include "failure.h"
#include "interrupt.h"
#include "reshape_json.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

LinearSolver linear_solver(const std::string& name) {
  for (const LinearSolver solver : {LinearSolver::factor, LinearSolver::multigrid}) {
    if (name == to_string(solver)) return solver;
  }
  return LinearSolver::automatic;
}

When when(const std::string& name) {
  for (const When choice : {When::never, When::always}) {
    if (name == to_string(choice)) return choice;
  }
  return When::automatic;
}

ReshapeOptions solver_options(const ReshapeJob& job, const Mesh& mesh, const BackendChoice& choice) {
  ReshapeOptions options;
  options.method = job.method == to_string(ReshapeMethod::alup) ? ReshapeMethod::alup : ReshapeMethod::slippage;
  options.solver = job.solver == to_string(ReshapeSolver::published) ? ReshapeSolver::published : ReshapeSolver::steady;
  options.linear_solver = linear_solver(job.linear_solver);
  options.feature_angle = job.feature_angle * std::numbers::pi / 180;
  options.finalise = !job.no_finalise;
  options.backend = choice.for_elements(static_cast<int>(mesh.triangles.rows()));
  spdlog::debug("local steps: {} on {}", options.backend->name(), options.backend->device());
  if (!job.curvature.empty()) {
    options.unit_box_curvatures = read_unit_box_curvatures(job.curvature, static_cast<int>(mesh.triangles.rows()));
  }
  set_chains(job.straight, job.finding, mesh, options);
  options.remesh = when(job.remesh);
  options.scaffold = when(job.scaffold);
  // What is published takes the mesh as it is.
  if (options.solver == ReshapeSolver::published && options.remesh == When::automatic) options.remesh = When::never;
  return options;
}

ReshapeResult solve(const ReshapeJob& job, const Mesh& mesh, const Gesture& gesture, const ReshapeOptions& options,
                    const CommonOptions& common, RunSeconds& seconds) {
  return with_progress(common, [&](const ProgressFn& progress) {
    const auto solved = [&](auto& plan) { return plan.solve(gesture, progress); };
    if (const std::optional<DeformMethod> method = deform_method(job.method)) {
      Deform deform(mesh.positions, mesh.triangles, deform_options(job, *method, options));
      return as_reshaped(timed(std::move(deform), progress, seconds, solved));
    }
    return timed(Reshape(mesh.positions, mesh.triangles, options), progress, seconds, solved);
  });
}

/// That of a stand-in is of its vertices.
void write_scaffold(const std::string& path, const ReshapeResult& result) {
  if (path.empty()) return;
  const std::optional<ReshapedScaffold>& scaffold = result.stand_in ? result.stand_in->scaffold : result.scaffold;
  if (!scaffold) {
    throw Unsolvable(fmt::format(
        "--scaffold-mesh {}: no scaffold was made, components: {}; leave it out, or ask for one with --scaffold always",
        path, result.report.paths.at("components")));
  }
  write_tetrahedra(path, scaffold->positions, scaffold->tetrahedra);
}

void check_method(const ReshapeJob& job) {
  if (job.solver == "published" && job.remesh == "always") {
    throw WrongUsage(
        "--remesh always does not go with --solver published, which takes the mesh as it is: leave one out");
  }
  if (linear_solver(job.linear_solver) == LinearSolver::multigrid && job.solver == "published") {
    throw WrongUsage("--linear-solver multigrid does not go with --solver published, which factors: leave one out");
  }
  check_deform_job(job);
  check_finding(job.straight, job.finding);
  if (job.scaffold_mesh.empty()) return;
  if (!job.scaffold_mesh.ends_with(".mesh") && !job.scaffold_mesh.ends_with(".vtk")) {
    throw WrongUsage(fmt::format("--scaffold-mesh {}: name a .mesh or .vtk file", job.scaffold_mesh));
  }
  check_can_be_written(job.scaffold_mesh, "--scaffold-mesh");
}

void check_outputs(const ReshapeJob& job) {
  if (job.output.empty() && job.json.empty()) {
    throw WrongUsage("nothing to write: name the result mesh with -o FILE or the report with --json FILE");
  }
  check_outputs(static_cast<const EditFiles&>(job));
}

void add_reshape_options(CLI::App& app, ReshapeJob& job) {
  add_edit_files(app, job, "The mesh to reshape: .obj .ply .stl .off");
  const std::string group = "Method";
  app.add_option(
         "--method", job.method,
         "slippage: as the paper; alup: its forerunner, scales uniformly where it can; to compare with: poisson, "
         "arap, arap-volume, conformal (slippage)")
      ->group(group)
      ->check(CLI::IsMember({"slippage", "alup", "poisson", "arap", "arap-volume", "conformal"}));
  app.add_option("--handle-weight", job.handle_weight,
                 "Handles are held softly, by this weight in the unit box: poisson, arap, arap-volume, conformal")
      ->group(group)
      ->check(between(1e-9, 1e15));
  app.add_option("--solver", job.solver, "steady: whatever the resolution; published: as in the paper (steady)")
      ->group(group)
      ->check(CLI::IsMember({"steady", "published"}));
  app.add_option("--linear-solver", job.linear_solver,
                 "factor: exact, much memory; multigrid: little; auto: by the mesh's size (auto)")
      ->group(group)
      ->check(CLI::IsMember({"auto", "factor", "multigrid"}));
  app.add_option("--curvature", job.curvature, "Principal curvatures, instead of computing them")
      ->group(group)
      ->type_name("FILE.fk");
  CLI::Option* straight = app.add_option("--straight", job.straight,
                                         "Edges that stay straight: auto finds them, none, or a file of chains (none)")
                              ->group(group)
                              ->type_name("auto|none|FILE");
  add_finding_options(app, job.finding, *straight);
  app.add_option("--feature-angle", job.feature_angle,
                 "Surfaces beside an edge of a smaller interior angle stretch independently, degrees (105)")
      ->group(group)
      ->check(between(0, 180))
      ->type_name("DEG");
  app.add_flag("--no-finalise", job.no_finalise, "Leave dimples at handles as they are")->group(group);
  app.add_option("--remesh", job.remesh, "Solve a remeshed stand-in: auto where triangles are badly shaped (auto)")
      ->group(group)
      ->check(CLI::IsMember({"auto", "never", "always"}));
  app.add_option("--scaffold", job.scaffold, "Join components by tetrahedra: auto where none touch (auto)")
      ->group(group)
      ->check(CLI::IsMember({"auto", "never", "always"}));
  app.add_option("--scaffold-mesh", job.scaffold_mesh, "The tetrahedra, reshaped: .mesh or .vtk; needs a scaffold")
      ->group(group)
      ->type_name("FILE");
}

}  // namespace

ReshapeResult run(const ReshapeJob& job, const GestureRecipe& recipe, const CommonOptions& common) {
  check_outputs(job);
  check_method(job);
  apply(common);
  const BackendChoice choice(common);
  RunSeconds seconds;
  const Stopwatch total, read;
  const MeshFile file = read_input(job.mesh);
  const Gesture gesture = recipe.on(file);
  naming(job.mesh, [&] { check(gesture, file.mesh.positions, file.mesh.triangles); });
  ReshapeOptions options = solver_options(job, file.mesh, choice);
  spdlog::debug("{}: {} vertices, {} triangles, {} handles", job.mesh, file.mesh.positions.rows(),
                file.mesh.triangles.rows(), gesture.targets.size());
  seconds.read = read.seconds();
  stop_if_interrupted();

  ReshapeResult result = naming(job.mesh, [&] {
    return solve_or_fall_back(choice, options.backend,
                              [&] { return solve(job, file.mesh, gesture, options, common, seconds); });
  });
  for (const std::string& warning : result.report.warnings) spdlog::warn("{}", warning);

  const Stopwatch write;
  write_scaffold(job.scaffold_mesh, result);
  write_result(job, file, result.positions);
  seconds.write = write.seconds();
  seconds.total = total.seconds();
  write_json(job.json, report_json(job, file, gesture, result, *options.backend, seconds));
  spdlog::info("{}: {} passes ({}), {:.2f} s", job.mesh, result.report.passes, to_string(result.report.stop),
               seconds.total);
  return result;
}

Command reshape_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* app =
      program.add_subcommand("reshape", "Moves handles; proportions change, orientation and structure stay");
  auto job = std::make_shared<ReshapeJob>();
  auto gesture = std::make_shared<GestureOptions>();
  add_reshape_options(*app, *job);
  add_gesture_options(*app, *gesture);
  return {app, [job, gesture, &common] { run(*job, GestureRecipe(*gesture), common); }};
}

}  // namespace swage::cli

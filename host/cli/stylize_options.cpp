// The options of `swage stylize`, and which of them go together.
#include <vector>

#include "failure.h"
#include "style_choice.h"
#include "swage/polycube.h"

namespace swage::cli {
namespace {

using CLI::IsMember;

constexpr const char* kStyles = "--style, --capture, --normals, --normal-map, --developable or --polycube";

CLI::Option* add_text(CLI::App& app, const char* name, std::string& value, const std::string& help, const char* type) {
  return app.add_option(name, value, help)->group("Style")->type_name(type);
}

void add_choice(CLI::App& app, const char* name, std::string& value, const std::vector<std::string>& choices,
                const std::string& help, CLI::Option* of) {
  app.add_option(name, value, help)->group("Style")->check(IsMember(choices))->needs(of);
}

void check_polycube(const StylizeJob& job) {
  if (!job.polycube) return;
  const auto refuse = [](bool given, const char* option) {
    if (given) throw WrongUsage(fmt::format("{} does not go with --polycube: leave one out", option));
  };
  refuse(!job.capture.empty(), "--capture");
  refuse(!job.normals.empty(), "--normals");
  refuse(!job.normal_map.empty(), "--normal-map");
  refuse(job.developable, "--developable");
  refuse(!job.sheet.empty(), "--style-sheet");
  refuse(job.target == "sphere", "--target sphere");
  refuse(job.no_dynamic, "--no-dynamic");
  refuse(!job.energy.empty(), "--energy");
  refuse(!job.weights.empty(), "--weights");
  refuse(job.accelerate, "--accelerate");
  refuse(job.published, "--published");
}

/// One of these, the sheet among them, which has styles of its own. The sheet is last.
std::vector<CLI::Option*> add_styles(CLI::App& app, StylizeJob& job) {
  std::vector<CLI::Option*> styles;
  styles.push_back(
      add_text(app, "--style", job.style, "A shape to look like: a mesh, or one of " + preset_names(), "FILE|PRESET"));
  add_choice(app, "--target", job.target, {"closest", "sphere"},
             "How its normals are found: closest: the nearest of its faces'; sphere: the one at the same place once "
             "the style is blown up to a sphere (closest, sphere for rounded-cube)",
             styles.back());
  CLI::Option* const dynamic =
      app.add_flag("--dynamic", job.dynamic, "The closest are looked up again after each pass, as they are by default")
          ->group("Style")
          ->needs(styles.back());
  app.add_flag("--no-dynamic", job.no_dynamic, "The closest are those of the shape at rest")
      ->group("Style")
      ->needs(styles.back())
      ->excludes(dynamic);
  styles.push_back(add_text(app, "--capture", job.capture,
                            "A sphere painted with normals: .png, or .ply with nx, ny, nz of vertices", "FILE"));
  add_choice(app, "--capture-layout", job.layout, {"equirectangular", "hemispheres"},
             "How a .png shows the sphere, y up: equirectangular: z in the middle, x right of it; hemispheres: two "
             "discs, seen from z and from -z (equirectangular)",
             styles.back());
  styles.push_back(add_text(app, "--normals", job.normals,
                            "Normals for the mesh itself: nx, ny, nz of a PLY's vertices or faces", "FILE.ply"));
  styles.push_back(add_text(app, "--normal-map", job.normal_map,
                            "Relief from a normal map, by the texture coordinates of an OBJ", "FILE.png"));
  add_choice(app, "--normal-space", job.normal_space, {"tangent", "object"},
             "What its colours are: directions along u, v and the normal, or x, y, z (tangent)", styles.back());
  add_choice(app, "--green", job.green, {"up", "down"},
             "Whether green is along growing v (OpenGL) or falling v (DirectX), in tangent space (up)", styles.back());
  styles.push_back(app.add_flag("--developable", job.developable,
                                "To pieces that unroll without stretching, and creases between them")
                       ->group("Style"));
  CLI::Option* const tau =
      app.add_option("--tau", job.tau, "The larger, the fewer pieces bend and the fewer creases there are (0.25)")
          ->group("Style")
          ->check(between(0, 1e9))
          ->needs(styles.back());
  app.add_option(
         "--threshold", job.threshold,
         "In place of tau: where normals around a vertex spread less, in squared mesh units, they are to be one")
      ->group("Style")
      ->check(between(0, 1e300))
      ->needs(styles.back())
      ->excludes(tau);
  styles.push_back(app.add_option("--style-sheet", job.sheet,
                                  "Instead: a picture of the mesh as cube, octahedron, icosahedron, prism6, "
                                  "rounded-cube and developable")
                       ->group("Picture")
                       ->type_name("FILE.png"));
  return styles;
}

void check_written(const StylizeJob& job) {
  check_outputs(job);
  check_different({{"--picture", job.picture.path}, {"-o", job.output}, {"--json", job.json}});
  check(job.picture);
  PictureOptions sheet = job.picture;
  sheet.path = job.sheet;
  check(sheet, "--style-sheet");
  const PictureOptions usual;
  const bool has_view = sheet.view != usual.view || sheet.up != usual.up || sheet.size != usual.size;
  if (has_view && job.picture.path.empty() && job.sheet.empty()) {
    throw WrongUsage("--view, --up and --size are for pictures: name one with --picture or --style-sheet");
  }
  check_writes({job.output, job.json, job.picture.path, job.sheet});
}

}  // namespace

void add_stylize_options(CLI::App& app, StylizeJob& job) {
  add_edit_files(app, job, "The mesh to stylize: .obj .ply .stl .off");
  const std::vector<CLI::Option*> styles = add_styles(app, job);
  for (size_t i = 0; i < styles.size(); ++i) {
    for (size_t j = i + 1; j < styles.size(); ++j) styles[i]->excludes(styles[j]);
  }
  CLI::Option* const sheet = styles.back();
  app.add_flag("--polycube", job.polycube,
               "To boxes of the style's directions, a cube's where there is no --style: details dissolve")
      ->group("Style");
  const std::string group = "Method";
  app.add_option("--lambda", job.lambda,
                 "How much the style counts against the shape (1; 10 for --polycube, 1000 for --developable)")
      ->group(group)
      ->check(between(0, 1e9));
  app.add_option("--energy", job.energy,
                 "What the shape resists with: arap: smoothly; farap: with sharp creases; acap: its details may grow "
                 "and shrink (arap; farap for --developable)")
      ->group(group)
      ->check(IsMember({"arap", "farap", "acap"}));
  app.add_option("--weights", job.weights,
                 "What edges count: cotangent; clamped: obtuse angles as right ones; intrinsic: cotangents of the "
                 "intrinsic Delaunay triangulation, which badly shaped triangles leave sound (cotangent)")
      ->group(group)
      ->check(IsMember({"cotangent", "clamped", "intrinsic"}));
  CLI::Option* const accelerate =
      app.add_flag("--accelerate", job.accelerate, "To the same end in fewer passes")->group(group);
  app.add_flag(
         "--published", job.published,
         "As the authors' program: --target sphere by the nearest vertex, and acap's scale by the paper's formula")
      ->group(group)
      ->excludes(accelerate);
  app.add_option("--iterations", job.iterations, "Passes at most (350; 50 for --polycube)")
      ->group(group)
      ->check(between(1, 1e6));
  add_gesture_options(app, job.gesture);
  CLI::Option* const picture = add_picture_option(app, job.picture, "The mesh and the result side by side");
  picture->excludes(sheet);
  app.add_option("--heat", job.heat, "What the colours tell: how far normals are from their targets, or none (targets)")
      ->group("Picture")
      ->check(IsMember({"targets", "none"}))
      ->needs(picture);
  add_view_options(app, job.picture);
  for (const char* name : {"--output", "--json"}) app.get_option(name)->excludes(sheet);
}

void check_job(const StylizeJob& job) {
  const bool has_file = !(job.style.empty() && job.capture.empty() && job.normals.empty() && job.normal_map.empty());
  if (!has_file && !job.developable && !job.polycube && job.sheet.empty()) {
    throw WrongUsage(std::string("nothing to do: name a style with ") + kStyles);
  }
  check_polycube(job);
  if (weights_of(job) == StylizeWeights::intrinsic_delaunay && energy_of(job) == StylizeEnergy::farap) {
    throw WrongUsage("--weights intrinsic is not for --energy farap, whose triangles are the mesh's: take clamped");
  }
  if (!job.style.empty()) check_style_name(job.style);
  if ((job.dynamic || job.no_dynamic) && method_of(job) == "sphere") {
    throw WrongUsage(
        "--dynamic and --no-dynamic are for --target closest: those of --target sphere do not change: leave it out");
  }
  if (!job.layout.empty() && !job.capture.ends_with(".png")) {
    throw WrongUsage(fmt::format("--capture-layout is for a .png, not for --capture {}: leave it out", job.capture));
  }
  if (!job.green.empty() && job.normal_space == "object") {
    throw WrongUsage("--green is for tangent space, not for --normal-space object: leave one out");
  }
  check_written(job);
}

double lambda_of(const StylizeJob& job) {
  if (job.polycube) return job.lambda.value_or(PolycubeOptions{}.lambda);
  return job.lambda.value_or(job.developable ? 1000 : 1);
}

StylizeEnergy energy_of(const StylizeJob& job) {
  for (const StylizeEnergy energy : {StylizeEnergy::arap, StylizeEnergy::farap, StylizeEnergy::acap}) {
    if (job.energy == to_string(energy)) return energy;
  }
  return job.developable || job.polycube ? StylizeEnergy::farap : StylizeEnergy::arap;
}

StylizeWeights weights_of(const StylizeJob& job) {
  if (job.weights == "intrinsic") return StylizeWeights::intrinsic_delaunay;
  return job.weights == "clamped" || job.polycube ? StylizeWeights::clamped : StylizeWeights::cotangent;
}

}  // namespace swage::cli

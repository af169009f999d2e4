// `swage template mesh`: a template's surface.
#include <algorithm>
#include <memory>

#include "edit.h"
#include "failure.h"
#include "picture.h"
#include "template.h"
#include "template_choice.h"
#include "template_json.h"
#include "template_surface.h"

namespace swage::cli {
namespace {

struct MeshJob : EditFiles {  // Without a mesh.
  std::string name;
  SettingOptions settings;
  int resolution = 128;
  PictureOptions picture;
};

void check_job(const MeshJob& job) {
  check_outputs(job);
  check(job.picture);
  check_different({{"-o", job.output},
                   {"--json", job.json},
                   {"--picture", job.picture.path},
                   {"TEMPLATE", file_of_template(job.name)}});
  check_writes({job.output, job.json, job.picture.path});
}

Image picture_of(const MeshJob& job, const Template& of, const Settings& settings, const Mesh& mesh,
                 const CommonOptions& common) {
  if (job.picture.path.empty()) return {};
  return drawn({{mesh, of.name(), {}, {}, settings.words(0)}}, render_options_of(job.picture, up_of(of, {})), common);
}

Json report_json(const MeshJob& job, const Template& of, const Eigen::VectorXd& values, const Mesh& mesh,
                 const Backend& backend, const RunSeconds& seconds) {
  Json json = run_json("template mesh", job.name, mesh, "dual contouring");
  json["template"] = of.name();
  json["parameters"] = values_json(of, values);
  json["resolution"] = job.resolution;
  add_backend(json, backend);
  add_costs(json, {}, backend, seconds);
  json["warnings"] = Json::array();
  return json;
}

void run(const MeshJob& job, const CommonOptions& common) {
  check_job(job);
  apply(common);
  RunSeconds seconds;
  const Stopwatch total, read;
  const Template of = template_named(job.name);
  const Settings settings(job.settings, of);
  settings.check_single();
  const Eigen::VectorXd values = settings.on(of.defaults());
  const BackendChoice choice(common);
  std::shared_ptr<Backend> backend = choice.for_elements(points_of_surface(job.resolution), AutoDevices::all);
  seconds.read = read.seconds();

  const Stopwatch solve;
  const Mesh mesh = solve_or_fall_back(choice, backend, [&] {
    return surface_of(of, values, {job.resolution, backend}, common);
  });
  seconds.solve = solve.seconds();
  const Image picture = picture_of(job, of, settings, mesh, common);

  const Stopwatch write;
  write_surface(job.output, mesh);
  if (!job.picture.path.empty()) write_png(job.picture.path, picture);
  seconds.write = write.seconds();
  seconds.total = total.seconds();
  if (!job.json.empty()) write_json(job.json, report_json(job, of, values, mesh, *backend, seconds));
  spdlog::info("{}: {} triangles, {:.2f} s", job.name, mesh.triangles.rows(), seconds.total);
}

}  // namespace

Command template_mesh_command(CLI::App& group, const CommonOptions& common) {
  CLI::App* app = group.add_subcommand("mesh", "Makes a mesh of a template's surface");
  auto job = std::make_shared<MeshJob>();
  app->add_option("TEMPLATE", job->name, "A name in `swage template list`, or a template's file")
      ->type_name(kTemplateType)
      ->required();
  app->add_option("-o,--output", job->output, "The mesh, format by extension; - for stdout, as OBJ")->type_name("FILE");
  app->add_option("--json", job->json, "Report of the run; - for stdout")->type_name("FILE");
  add_setting_options(*app, job->settings, "as they are by default");
  add_resolution_option(*app, job->resolution);
  CLI::Option* const picture = add_picture_option(*app, job->picture, "The surface");
  for (CLI::Option* option : add_eye_options(*app, job->picture, "--picture-size")) option->needs(picture);
  return {app, [job, &common] { run(*job, common); }};
}

}  // namespace swage::cli

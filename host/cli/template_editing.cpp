#include "template_editing.h"

#include <spdlog/fmt/fmt.h>

#include "failure.h"
#include "template_choice.h"
#include "template_fitting.h"
#include "template_report.h"

namespace swage::cli {

void add_fit_source(CLI::App& app, FitSource& source) {
  add_template_option(app, source.name, "; the fit's own where that is given");
  CLI::Option* const fit =
      app.add_option("--fit", source.file,
                     "The report of `swage template fit`, or of an edit; else the mesh is fitted on the spot")
          ->type_name("FIT.json");
  for (CLI::Option* option : add_fitting_options(app, source.options)) option->excludes(fit);
}

void check_apart(const std::vector<Output>& outputs, const std::vector<Output>& inputs) {
  check_different(outputs);
  for (const Output& input : inputs) {
    for (const Output& output : outputs) check_different({input, output});
  }
}

void add_editing_options(CLI::App& app, TemplateEditOptions& options) {
  const auto add = [&](const char* name, auto& value, const std::string& help, double low, double high) {
    app.add_option(name, value, help)->group("Edit")->check(between(low, high));
  };
  add("--tracking", options.tracking, "How much following the template counts against keeping the shape (1)", 1e-6,
      1e6);
  add("--smoothing", options.smoothing, "How far neighbours' maps are joined, a part of the diagonal, 0 to 1 (0.1)", 0,
      1);
  add("--feature-angle", options.feature_angle, "Across sharper edges they are not, degrees (30)", 1e-3, 180);
  add("--sub-edits", options.sub_edits, "Steps on the parameters' way (0: as many as are needed)", 0, 10000);
  add("--passes", options.passes, "Passes at most in all (1000)", 1, 1e6);
  add("--tolerance", options.tolerance, "Of the diagonal: vertices that move less are at rest (1e-5)", 1e-12, 0.1);
}

KnownFit known_fit(const std::string& name, const std::string& file) {
  if (name.empty() && file.empty()) {
    throw WrongUsage("--template is missing: name one of `swage template list`, or a fit that was made with --fit");
  }
  if (file.empty()) return {name, template_named(name), std::nullopt};
  FitFile fit = read_fit(file);
  if (name.empty()) return {fit.of.name(), fit.of, fit};
  Template of = template_named(name);
  fit.check_is_of(of, name);
  return {name, std::move(of), std::move(fit)};
}

TemplateFit fit_of(const KnownFit& known, const FitOptions& options, const MeshFile& mesh, const BackendChoice& choice,
                   const ProgressFn& progress) {
  if (!known.file) {
    FitOptions fitting = options;
    fitting.backend = backend_of(options, choice);
    return solve_or_fall_back(choice, fitting.backend, [&] { return fitted(known.of, mesh, fitting, progress); });
  }
  TemplateFit fit;
  fit.parameters = known.file->parameters;
  fit.pose = known.file->pose;
  return fit;
}

TemplateEdit edit_of(const Template& of, const TemplateFit& fit, const MeshFile& mesh,
                     const TemplateEditOptions& options) {
  return naming(mesh.path.string(), [&] {
    return TemplateEdit(of, fit.parameters, fit.pose, mesh.mesh.positions, mesh.mesh.triangles, options);
  });
}

std::vector<std::string> warnings_of(const KnownFit& known, const TemplateFit& fit, const MeshFile& mesh) {
  if (!known.file) return warnings_of(fit, mesh.path.string());
  const std::string warning = known.file->warning_of(mesh);
  return warning.empty() ? std::vector<std::string>() : std::vector{warning};
}

Json source_json(const KnownFit& known, const TemplateFit& fit, std::vector<std::string>& warnings) {
  if (known.file) return {{"file", known.file->path}};
  Json json;
  add_fit_quality(json, known.of, fit, warnings);
  json["iterations"] = fit.report.passes;
  json["backend"] = fit.report.paths.at("field");
  json["seconds"] = fit.report.seconds.at("solve");
  return json;
}

void add_edit(Json& json, const Mesh& rest, const TemplateEditResult& result, std::vector<std::string>& warnings) {
  add_solve(json, result.report, warnings);
  json["residual"] = finite(result.residual, "residual", warnings);
  json["largest"] = finite(result.largest, "largest", warnings);
  add_changes(json, rest, {}, result.positions, warnings);
  json["handle_error"] = json["largest"];
  json["flipped_triangles"] = result.flipped;
  json["released_vertices"] = result.released;
}

}  // namespace swage::cli

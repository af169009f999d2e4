// The options of `swage resize`, and which of them go together.
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <numbers>

#include "failure.h"
#include "resize.h"

namespace swage::cli {
namespace {

void add_file(CLI::App& app, const char* name, std::string& path, const char* type, const std::string& help) {
  app.add_option(name, path, help)->group("Files")->type_name(type);
}

void check_ply(const char* option, const std::string& path) {
  if (path.empty()) return;
  if (!path.ends_with(".ply")) throw WrongUsage(fmt::format("{} {}: name a .ply file", option, path));
  check_can_be_written(path, option);
}

void check_png(const char* option, const std::string& path, const PictureOptions& how) {
  PictureOptions picture = how;
  picture.path = path;
  check(picture, option);
}

/// Where the model itself is overwritten, that is what -o says, and it is the only result.
void check_names(const ResizeJob& job) {
  std::vector<Output> outputs = {{"--json", job.json},
                                 {"--vulnerability", job.vulnerability},
                                 {"--grid-before", job.grid_before},
                                 {"--vulnerability-picture", job.vulnerability_picture},
                                 {"--grid-picture", job.grid_picture},
                                 {"--picture", job.picture.path}};
  const size_t count = job.target.count();
  for (size_t t = 0; t < count; ++t) {
    outputs.push_back({"-o", numbered(job.output, t, count)});
    outputs.push_back({"--grid-after", numbered(job.grid_after, t, count)});
  }
  check_different(outputs);
  if (count == 1) std::erase_if(outputs, [&](const Output& output) { return output.path == job.output; });
  outputs.push_back({"MESH", job.mesh});
  check_different(outputs);
}

void check_has_targets(const ResizeJob& job) {
  if (job.target.any()) return;
  const auto refuse = [](bool given, const char* option) {
    if (given) {
      throw WrongUsage(fmt::format(
          "{} is of a result: say of what size with --scale SX,SY,SZ or --size X,Y,Z, such as --scale 2,1,1", option));
    }
  };
  refuse(!job.output.empty(), "-o");
  refuse(!job.grid_after.empty(), "--grid-after");
  refuse(!job.picture.path.empty(), "--picture");
}

void check_view(const ResizeJob& job) {
  const PictureOptions usual;
  const bool has_view = job.picture.view != usual.view || job.picture.up != usual.up || job.picture.size != usual.size;
  const bool has_picture = !(job.picture.path.empty() && job.vulnerability_picture.empty() && job.grid_picture.empty());
  if (has_view && !has_picture) {
    throw WrongUsage(
        "--view, --up and --picture-size are for pictures: name one with --picture, --grid-picture or "
        "--vulnerability-picture");
  }
}

constexpr int kFewest = 5, kMost = 1000;  // Cells along an axis.

}  // namespace

void add_resize_options(CLI::App& app, ResizeJob& job) {
  add_edit_files(app, job, "The model to resize: .obj .ply .stl .off");
  app.get_option("--output")
      ->description("Result mesh, format by extension; - for stdout. Of several results a.obj is a_1.obj, a_2.obj ...");
  add_target_options(app, job.target);
  add_protection_options(app, job.protections);
  const std::string group = "Vulnerability";
  app.add_option("--crease-angle", job.crease_angle,
                 "An edge of a smaller interior angle is a crease and no curvature, degrees (150)")
      ->group(group)
      ->check(between(0, 180))
      ->type_name("DEG");
  app.add_option("--grid", job.grid,
                 "Cells of the protective grid: along the longest side, or along x, y and z, where - leaves one to be "
                 "chosen (60)")
      ->group(group)
      ->type_name("N|NX,NY,NZ");
  add_file(app, "--vulnerability", job.vulnerability, "FILE.ply",
           "The model with vulnerability, slippage and curvature of each triangle along x, y and z as properties");
  add_file(app, "--grid-before", job.grid_before, "FILE.ply",
           "Cells of the protective grid that the model touches, with their vulnerability as it counts");
  add_file(app, "--grid-after", job.grid_after, "FILE.ply",
           "The same resized, with their scales too; of several results numbered as -o");
  add_picture_option(app, job.picture, "The model, plainly scaled and resized side by side; a row for each result");
  const auto add_other_picture = [&](const char* name, std::string& path, const std::string& help) {
    app.add_option(name, path, help)->group("Picture")->type_name("FILE.png");
  };
  add_other_picture("--vulnerability-picture", job.vulnerability_picture,
                    "How vulnerable the model is along x, y and z, as colours");
  add_other_picture("--grid-picture", job.grid_picture,
                    "A slice of the protective grid over the model, before and after");
  add_view_options(app, job.picture, "--picture-size");
}

void check_job(const ResizeJob& job) {
  check_outputs(job);
  check_has_targets(job);
  if (job.output == kStdout && job.target.count() > 1) {
    throw WrongUsage("-o -: several results do not go to stdout: name a file, which is numbered");
  }
  check_ply("--vulnerability", job.vulnerability);
  check_ply("--grid-before", job.grid_before);
  check_ply("--grid-after", job.grid_after);
  check(job.picture);
  check_png("--vulnerability-picture", job.vulnerability_picture, job.picture);
  check_png("--grid-picture", job.grid_picture, job.picture);
  check_names(job);
  check_writes({job.output, job.json, job.picture.path, job.grid_after, job.grid_before, job.grid_picture,
                job.vulnerability, job.vulnerability_picture});
  check_view(job);
}

ResizeOptions options_of(const ResizeJob& job) {
  ResizeOptions options;
  options.vulnerability.crease_angle = job.crease_angle * std::numbers::pi / 180;
  if (job.grid.empty()) return options;
  int longest = 0;
  if (CLI::detail::lexical_cast(job.grid, longest)) {
    if (longest < kFewest || longest > kMost) {
      throw WrongUsage(fmt::format("--grid {}: give {} to {} cells along the longest side", job.grid, kFewest, kMost));
    }
    options.longest = longest;
    return options;
  }
  const AxisList cells = axis_list("--grid", job.grid, {1, kMost, "a number of cells from 1 to 1000"});
  for (size_t u = 0; u < 3; ++u) {
    options.cells[u] = static_cast<int>(cells[u].value_or(0));
    if (cells[u] && *cells[u] != options.cells[u]) {
      throw WrongUsage(fmt::format("--grid {}: {} is no whole number of cells", job.grid, *cells[u]));
    }
  }
  return options;
}

}  // namespace swage::cli

#include <spdlog/fmt/fmt.h>

#include <filesystem>
#include <memory>

#include "failure.h"
#include "furniture.h"
#include "options.h"
#include "picture.h"
#include "reshape.h"
#include "swage/error.h"
#include "swage/mesh_io.h"
#include "swage/render.h"

namespace swage::cli {
namespace {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder)) {
    throw UnwritableFile(folder.string() + ": the folder could not be made: " + error.message() + "; name another");
  }
}

std::string line(const std::filesystem::path& path, const std::string& what) {
  return fmt::format("{:<28} {}\n", path.string(), what);
}

/// Gives a line that tells about it.
std::string picture_beside(const std::filesystem::path& folder, const Mesh& rest, const Gesture& gesture,
                           const Positions& result) {
  const auto path = folder / "before_after.png";
  if (!can_render()) return line(path, "left out: this build makes no pictures (SWAGE_RENDER, SWAGE_EMBREE)");
  write_png(path, render({{rest, "before", handle_marks(gesture, rest.positions, false), {}, {}},
                          {{result, rest.triangles}, "after", handle_marks(gesture, rest.positions, true), {}, {}}}));
  return line(path, "the chair before and after, side by side");
}

/// Writes what a user would start from, then runs what a user would run.
void run_demo(const std::filesystem::path& folder, const CommonOptions& common) {
  const auto rest = folder / "rest.obj", gesture = folder / "gesture.deform", result = folder / "result.obj",
             report = folder / "report.json";
  make_folder(folder);
  const Mesh mesh = chair();
  write_mesh(rest, mesh);
  const Gesture wider = wider_and_lower(mesh);
  write_gestures(gesture, {wider}, mesh.positions);

  ReshapeJob job;
  job.mesh = rest.string();
  job.output = result.string();
  job.json = report.string();
  const ReshapeResult reshaped = run(job, GestureRecipe({gesture.string(), {}, {}}), common);

  write_stdout(
      line(rest, fmt::format("a chair of {} triangles", mesh.triangles.rows())) +
      line(gesture, "the edit: ten handles that make it wider and lower") + line(result, "the chair after it") +
      line(report, "the run in numbers") + picture_beside(folder, mesh, wider, reshaped.positions) +
      fmt::format("Reshaped in {} passes ({}). The same by hand:\n  swage reshape {} --gesture {} -o {}\n",
                  reshaped.report.passes, to_string(reshaped.report.stop), job.mesh, gesture.string(), job.output));
}

}  // namespace

Command demo_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* app = program.add_subcommand("demo", "Makes a chair, reshapes it, and writes what went in and came out");
  auto folder = std::make_shared<std::string>("demo");
  app->add_option("DIR", *folder, "Folder for the files, made where missing (demo)");
  return {app, [folder, &common] { run_demo(*folder, common); }};
}

}  // namespace swage::cli

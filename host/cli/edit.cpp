#include "edit.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "failure.h"
#include "options.h"

namespace swage::cli {
namespace {

/// What is left of a file whose faces are damaged is seldom the surface that was meant.
void check_faces(const MeshFile& file) {
  if (file.skipped_face.empty()) return;
  throw InvalidInput(
      fmt::format("{}: {}: a face has fewer than three vertices: mend or remove such faces, or export the mesh again",
                  file.path.string(), file.skipped_face));
}

}  // namespace

void add_edit_files(CLI::App& app, EditFiles& files, const std::string& mesh_help) {
  app.add_option("MESH", files.mesh, mesh_help)->required();
  app.add_option("-o,--output", files.output, "Result mesh, format by extension; - for stdout")->type_name("FILE");
  app.add_option("--json", files.json, "Report of the run; - for stdout")->type_name("FILE");
}

void check_outputs(const EditFiles& files) {
  check_different({{"-o", files.output}, {"--json", files.json}});
  if (!files.json.empty()) check_can_be_written(files.json, "--json");
  if (files.output.empty()) return;
  check_can_be_written(files.output, "-o");
  if (files.output == kStdout) return;
  try {
    format_of(files.output);
  } catch (const InvalidInput& e) {
    throw WrongUsage(std::string("-o: ") + e.what());
  }
}

void check_writes(const std::vector<std::string>& paths) {
  if (!std::all_of(paths.begin(), paths.end(), [](const std::string& path) { return path.empty(); })) return;
  throw WrongUsage(
      "nothing to write: name the result mesh with -o FILE, the report with --json FILE or a picture with --picture "
      "FILE.png");
}

std::string numbered(const std::string& path, size_t result, size_t count) {
  if (count == 1 || path.empty() || path == kStdout) return path;
  std::filesystem::path file(path);
  const std::string stem = file.stem().string(), extension = file.extension().string();
  return file.replace_filename(fmt::format("{}_{}{}", stem, result + 1, extension)).string();
}

ProgressFn part_of(const ProgressFn& progress, size_t part, size_t count) {
  return [&progress, part, count](Progress now) {
    now.fraction = (static_cast<double>(part) + now.fraction) / static_cast<double>(count);
    return progress(now);
  };
}

MeshFile read_input(const std::string& path) {
  MeshFile file = read_mesh(path);
  check_faces(file);
  for (const std::string& warning : file.warnings) spdlog::warn("{}", warning);
  return file;
}

void write_result(const EditFiles& files, const MeshFile& file, const Positions& positions) {
  if (files.output.empty()) return;
  if (files.output != kStdout) return write_mesh(files.output, file, positions);
  std::ostringstream text;
  write_mesh(text, format_of(files.mesh), file, positions);
  write_stdout(text.str());
}

}  // namespace swage::cli

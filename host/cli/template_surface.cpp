#include "template_surface.h"

#include <algorithm>
#include <sstream>

namespace swage::cli {

CLI::Option* add_resolution_option(CLI::App& app, int& resolution) {
  return app
      .add_option("--resolution", resolution, "Cells of the template's surface along its longest side, 8 to 1024 (128)")
      ->check(between(8, 1024))
      ->type_name("N");
}

int points_of_surface(int resolution) { return 6 * resolution * resolution; }

Mesh surface_of(const Template& of, const Eigen::VectorXd& values, const TemplateMeshOptions& options,
                const CommonOptions& common) {
  Mesh mesh =
      with_progress(common, [&](const ProgressFn& progress) { return template_mesh(of, values, options, progress); });
  stop_if_interrupted();
  return mesh;
}

void write_surface(const std::string& path, const Mesh& mesh) {
  if (path.empty()) return;
  if (path != kStdout) return write_mesh(path, mesh);
  std::ostringstream text;
  MeshFile file;
  file.mesh = mesh;
  write_mesh(text, MeshFormat::obj, file, mesh.positions);
  write_stdout(text.str());
}

Eigen::Vector3d up_of(const Template& of, const TemplatePose& pose) {
  return pose.rotation.transpose() * Eigen::Vector3d::Unit(of.up() - 'x');
}

}  // namespace swage::cli

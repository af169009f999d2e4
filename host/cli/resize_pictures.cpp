#include "resize_pictures.h"

#include <filesystem>
#include <utility>

#include "grid_picture.h"
#include "picture_fit.h"

namespace swage::cli {
namespace {

using Eigen::RowVector3d;

Positions scaled(const Positions& positions, const RowVector3d& factors) {
  return positions.array().rowwise() * factors.array();
}

RenderOptions options_with_view(const PictureOptions& picture, const Mesh& mesh) {
  RenderOptions options = render_options_of(picture);
  if (!options.view) options.view = automatic_view(mesh, {}, options.up);
  return options;
}

Image picture_of_results(const ResizeJob& job, const Resized& run, const CommonOptions& common) {
  const Mesh& rest = run.file.mesh;
  std::vector<SheetRow> rows;
  for (const ResizeResult& result : run.results) {
    const std::string factors = words(result.factors);
    const Panel before{{centred(rest.positions), rest.triangles}, "", {}, {}, "before"};
    const Panel plain{{centred(scaled(rest.positions, result.factors)), rest.triangles}, "", {}, {}, factors};
    const Panel after{{centred(result.positions), rest.triangles}, "", {}, {}, factors};
    rows.push_back({"", {before, plain, after}, {}});
  }
  return drawn_to_fit(std::move(rows), {title_of(job), "plainly scaled", "resized"},
                      options_with_view(job.picture, rest), common);
}

SheetRow row_of(const std::string& title, const Mesh& mesh, const AxisValues& theta) {
  SheetRow row{title, {}, {}};
  for (int u = 0; u < 3; ++u) row.panels.push_back({mesh, "", {}, theta.col(u), ""});
  return row;
}

/// Of faces as it is found and, where the user has a say, of cells as it counts.
Image picture_of_vulnerability(const ResizeJob& job, Resized& run, const CommonOptions& common) {
  const Mesh& rest = run.file.mesh;
  std::vector<SheetRow> rows{row_of("as found", rest, run.plan.vulnerability().theta)};
  if (!job.protections.empty()) {
    const GridShape& shape = run.plan.shape();
    const CellMap& map = run.plan.map();
    std::vector<int> cells;
    const Mesh surface = grid_surface(shape, map, rest_vertices(shape), &cells);
    rows.push_back(row_of("of cells, as it counts", surface, map.theta(cells, Eigen::all)));
  }
  RenderOptions options = options_with_view(job.picture, rest);
  options.heat_map = {0, 1, "vulnerability"};
  return drawn_to_fit(std::move(rows), {"along x", "along y", "along z"}, options, common);
}

}  // namespace

std::string title_of(const ResizeJob& job) { return std::filesystem::path(job.mesh).stem().string(); }

Positions centred(const Positions& positions) {
  return positions.rowwise() - (positions.colwise().minCoeff() + positions.colwise().maxCoeff()) / 2;
}

ResizePictures pictures_of(const ResizeJob& job, Resized& run, const CommonOptions& common) {
  ResizePictures pictures;
  if (!job.picture.path.empty()) pictures.results = picture_of_results(job, run, common);
  if (!job.vulnerability_picture.empty()) pictures.vulnerability = picture_of_vulnerability(job, run, common);
  if (!job.grid_picture.empty()) pictures.grid = picture_of_grid(job, run, common);
  return pictures;
}

void write_pictures(const ResizeJob& job, const ResizePictures& pictures) {
  if (!job.picture.path.empty()) write_png(job.picture.path, pictures.results);
  if (!job.vulnerability_picture.empty()) write_png(job.vulnerability_picture, pictures.vulnerability);
  if (!job.grid_picture.empty()) write_png(job.grid_picture, pictures.grid);
}

}  // namespace swage::cli

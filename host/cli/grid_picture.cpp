#include "grid_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "grid_lines.h"
#include "picture_fit.h"
#include "resize_pictures.h"

namespace swage::cli {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr double kLineWidth = 1.8, kLeastSpacing = 6;  // Pixels, of lines.
constexpr double kBefore = 0.3;  // Box diagonals that lines are before the model, so as to cast no shadow on it.
constexpr double kShown = 0.02;  // Vulnerability from which a line has a colour.

/// One that is most along the view asked for, or else one along which least changes; among several not the one that is
/// up, but the shortest.
int axis_of_slice(const RenderOptions& options, const GridShape& shape, const RowVector3d& factors) {
  int axis = 0;
  if (options.view) {
    options.view->from.cwiseAbs().maxCoeff(&axis);
    return axis;
  }
  const auto cost = [&](int u) {
    return std::tuple(shape.extends(u), std::abs(std::log(factors[u])), options.up[u] != 0, shape.size[u]);
  };
  for (const int u : {1, 2}) {
    if (cost(u) < cost(axis)) axis = u;
  }
  return axis;
}

/// Straight from the front or, where that is asked for, from behind.
View view_across(int axis, const RenderOptions& options) {
  const std::array<Vector3d, 3> ups = {Vector3d::UnitZ(), -Vector3d::UnitZ(), Vector3d::UnitY()};
  const double side = options.view && options.view->from[axis] < 0 ? -1 : 1;
  const bool is_up = options.up[axis] != 0;
  return {side * Vector3d::Unit(axis), is_up ? ups[static_cast<size_t>(axis)] : options.up};
}

/// What a row is made of.
struct Pair {
  std::vector<Panel> panels;  ///< The model before and after, or only before.
  std::vector<const AxisValues*> grids;
  RowVector3d factors;
};

/// So wide, so dense and so far before the models as is good to see.
GridSlice slice_of(const GridShape& shape, const CellMap& map, int axis, const Pair& pair, double side, double scale) {
  GridSlice slice{axis, busiest_layer(shape, map, axis)};
  double spacing = INFINITY;
  for (int u = 0; u < 3; ++u) {
    if (u == axis || !shape.extends(u)) continue;
    spacing = std::min(spacing, scale * std::min(1.0, pair.factors[u]) * shape.size[u] / shape.cells[u]);
  }
  slice.stride = static_cast<int>(std::clamp(std::ceil(kLeastSpacing / spacing), 1.0, 1000.0));
  slice.width = kLineWidth / scale;
  double top = 0;
  for (const Panel& panel : pair.panels) top = std::max(top, panel.mesh.positions.col(axis).cwiseAbs().maxCoeff());
  slice.height = side * (top + kBefore * box_diagonal(pair.panels.front().mesh.positions));
  return slice;
}

void add_lines(Panel& panel, const GridLines& lines) {
  Mesh& mesh = panel.mesh;
  const Index vertices = mesh.positions.rows(), triangles = mesh.triangles.rows();
  mesh.positions.conservativeResize(vertices + lines.mesh.positions.rows(), 3);
  mesh.positions.bottomRows(lines.mesh.positions.rows()) = lines.mesh.positions;
  mesh.triangles.conservativeResize(triangles + lines.mesh.triangles.rows(), 3);
  mesh.triangles.bottomRows(lines.mesh.triangles.rows()) = lines.mesh.triangles.array() + static_cast<int>(vertices);
  const double grey = std::numeric_limits<double>::quiet_NaN();
  panel.face_values.conservativeResize(mesh.triangles.rows());
  panel.face_values.tail(lines.theta.size()) = (lines.theta.array() < kShown).select(grey, lines.theta);
}

/// Seen along an axis, so that the slice's lines are where they are in the model.
SheetRow row_of(Pair pair, const GridShape& shape, const CellMap& map, RenderOptions options, size_t rows) {
  const int axis = axis_of_slice(options, shape, pair.factors);
  const View view = view_across(axis, options);
  options.view = view;
  const double scale = fit(pair.panels, rows, options).scale;
  const GridSlice slice = slice_of(shape, map, axis, pair, view.from[axis], scale);
  for (size_t p = 0; p < pair.panels.size(); ++p) {
    add_lines(pair.panels[p], grid_lines(shape, map, centred(*pair.grids[p]), slice));
  }
  const double at = shape.corner[axis] + (slice.layer + 0.5) / shape.cells[axis] * shape.size[axis];
  pair.panels.front().caption = fmt::format("{} × {} × {} cells, at {} = {:.3g}", shape.cells[0], shape.cells[1],
                                            shape.cells[2], "xyz"[axis], at);
  return {"", std::move(pair.panels), view};
}

}  // namespace

Image picture_of_grid(const ResizeJob& job, Resized& run, const CommonOptions& common) {
  const GridShape& shape = run.plan.shape();
  const CellMap& map = run.plan.map();
  const AxisValues grid = rest_vertices(shape);
  const Triangles& triangles = run.file.mesh.triangles;
  const Eigen::VectorXd pale = Eigen::VectorXd::Zero(triangles.rows());  // Lines are seen on it whatever their colour.
  const Panel before{{centred(run.file.mesh.positions), triangles}, "", {}, pale, ""};
  std::vector<Pair> pairs;
  for (const ResizeResult& result : run.results) {
    const Panel after{{centred(result.positions), triangles}, "", {}, pale, words(result.factors)};
    pairs.push_back({{before, after}, {&grid, &result.grid}, result.factors});
  }
  if (pairs.empty()) pairs.push_back({{before}, {&grid}, RowVector3d::Ones()});

  RenderOptions options = render_options_of(job.picture);
  options.heat_map = {0, 1, "vulnerability of cells along a line"};
  options.feature_lines = false;  // Lines of the grid are enough.
  std::vector<SheetRow> rows;
  rows.reserve(pairs.size());
  for (Pair& pair : pairs) rows.push_back(row_of(std::move(pair), shape, map, options, pairs.size()));
  std::vector<std::string> titles{title_of(job), "resized"};
  titles.resize(rows.front().panels.size());
  return drawn_to_fit(std::move(rows), titles, options, common);
}

}  // namespace swage::cli

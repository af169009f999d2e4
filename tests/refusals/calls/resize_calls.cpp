#include "assemble.h"
#include "calls.h"
#include "carry.h"
#include "scales.h"
#include "swage/resize.h"

namespace swage::test {
namespace {

Resize resize_of(const Mesh& mesh, const ResizeOptions& options = {}) {
  return {mesh.positions, mesh.triangles, options};
}

Vulnerability vulnerability_of(const VulnerabilityOptions& options) {
  return vulnerability(cube.positions, cube.triangles, options);
}

ResizeTarget times(double x, double size_weight = 10) {
  ResizeTarget target;
  target.factors = {x, 1, 1};
  target.size_weight = size_weight;
  return target;
}

Protection within(double low, double high, double value = 1) {
  Protection protection;
  protection.box = Eigen::AlignedBox3d(Eigen::Vector3d::Constant(low), Eigen::Vector3d::Constant(high));
  protection.value = value;
  return protection;
}

GridShape grid(int x, int y, int z, double height = 1) { return {{{x, y, z}}, {0, 0, 0}, {1, 1, height}}; }

/// Of two cells.
const GridShape two = grid(2, 1, 1);

CellMap map(Eigen::Index thetas, Eigen::Index phis, double theta = 1, double phi = 1) {
  return {rows(thetas, 1, theta), Eigen::VectorXd::Constant(phis, phi)};
}

}  // namespace

std::vector<Call> resize_calls() {
  return {
      CALL(resize_of(point)),
      CALL(resize_of(cube, with(&ResizeOptions::cells, std::array<int, 3>{1001, 1, 1}))),
      CALL(resize_of(cube, with(&ResizeOptions::cells, std::array<int, 3>{1000, 1000, 1000}))),
      CALL(resize_of(cube, with(&ResizeOptions::longest, 4))),
      CALL(resize_of(cube, with(&ResizeOptions::tolerance, 1))),
      CALL(resize_of(cube, with(&ResizeOptions::vulnerability, with(&VulnerabilityOptions::slippage_limit, 0)))),
      CALL(resize_of(cube).protect(within(0, 1, 2))),
      CALL(resize_of(cube).protect(within(1, 0))),
      CALL(resize_of(cube).protect(within(5, 6))),
      CALL(resize_of(cube).protect(Protection{{12}, {}})),
      CALL(resize_of(cube).set_map(map(2, 2))),
      CALL(resize_of(cube).solve(times(1e7))),
      CALL(resize_of(cube).solve(times(2, 0))),
      CALL(vulnerability_of(with(&VulnerabilityOptions::crease_angle, 4))),
      CALL(vulnerability_of(with(&VulnerabilityOptions::slippage_limit, 0))),
      CALL(vulnerability_of(with(&VulnerabilityOptions::curvature_limit, 0))),
      CALL(vulnerability_of(with(&VulnerabilityOptions::least_curvature, 2))),
      CALL(grid_surface(grid(2, 1, 1, nan), map(2, 2), rest_vertices(two))),
      CALL(grid_surface(grid(0, 1, 1), map(2, 2), rest_vertices(two))),
      CALL(grid_surface(grid(1, 1, 2, 0), map(2, 2), rest_vertices(two))),
      CALL(grid_surface(grid(1000, 1000, 101), map(2, 2), rest_vertices(two))),
      CALL(grid_surface(two, map(1, 2), rest_vertices(two))),
      CALL(grid_surface(two, map(2, 1), rest_vertices(two))),
      CALL(grid_surface(two, map(2, 2, 1.5), rest_vertices(two))),
      CALL(grid_surface(two, map(2, 2, 1, 0), rest_vertices(two))),
      CALL(grid_surface(two, map(2, 2), rows(11))),
      CALL(Assembly(two, map(2, 2)).place(rows(1), {1, 1, 1})),
      CALL(Assembly(two, map(2, 2)).place(rows(2, 1, nan), {1, 1, 1})),
      CALL(Assembly(two, map(2, 2)).place(rows(2), {1, 1, 1}, {1})),
      CALL(ScaleSolve(two, map(2, 2)).solve({1, 1, 1}, with(&ScaleOptions::size_weight, -1))),
      CALL(ScaleSolve(two, map(2, 2)).solve({1, 1, 1}, with(&ScaleOptions::tolerance, 1))),
      CALL(carry(two, rows(11), cube.positions)),
      CALL(carry(two, rest_vertices(two), rows(2, 1, nan))),
  };
}

}  // namespace swage::test

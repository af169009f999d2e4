#include "calls.h"
#include "swage/compare.h"
#include "swage/remesh.h"
#include "swage/scaffold.h"
#include "swage/transfer.h"

namespace swage::test {
namespace {

Mesh remeshed_by(const RemeshOptions& options, const Mesh& mesh = cube) {
  return remesh(mesh.positions, mesh.triangles, options);
}

Scaffold scaffold_by(const ScaffoldOptions& options, const Mesh& mesh = cube) {
  return scaffold(mesh.positions, mesh.triangles, options);
}

/// Two that share their middle.
Mesh crossing() { return joined(cube, transformed(cube, 1, {0.5, 0.25, 0.125})); }

Attachments attached(const PositionsRef& points, const TransferOptions& options = {}) {
  return attach(points, cube.positions, cube.triangles, options);
}

Attachments attachments(int triangle, double offset = 0, Eigen::Index offsets = 1) {
  return {Eigen::VectorXi::Constant(1, triangle), rows(1, 0, 1.0 / 3), rows(offsets, offset, offset)};
}

Positions carried(const Attachments& points, const Positions& moved = cube.positions,
                  const Transforms& transforms = Transforms::Zero(12, 9)) {
  return carry(points, cube.triangles, cube.positions, moved, &transforms);
}

Comparison comparison(const Positions& edit, const CompareOptions& options = {}) {
  return compare(cube.positions, edit, cube.triangles, options);
}

}  // namespace

std::vector<Call> surface_calls() {
  return {
      CALL(remeshed_by(with(&RemeshOptions::triangles, 99))),
      CALL(remeshed_by(with(&RemeshOptions::feature_angle, 0))),
      CALL(remeshed_by(with(&RemeshOptions::iterations, 0))),
      CALL(remeshed_by(with(&RemeshOptions::wrap_alpha, 2))),
      CALL(remeshed_by(with(&RemeshOptions::time_limit, 0))),
      CALL(remeshed_by(with(&RemeshOptions::edge_length, 5))),
      CALL(remeshed_by({}, line)),
      CALL(scaffold_by(with(&ScaffoldOptions::enlargement, 1))),
      CALL(scaffold_by(with(&ScaffoldOptions::time_limit, 0))),
      CALL(scaffold_by({}, line)),
      CALL(scaffold_by({}, crossing())),
      CALL(attached(rows(0))),
      CALL(attached(rows(2, 0, nan))),
      CALL(attached(rows(2), with(&TransferOptions::directions, -1))),
      CALL(attached(rows(2), with(&TransferOptions::detour, 0.5))),
      CALL(attached(rows(2), with(&TransferOptions::normals, rows(1)))),
      CALL(attached(rows(2), with(&TransferOptions::normals, rows(2, 1, nan)))),
      CALL(carried(attachments(0, 0, 2))),
      CALL(carried(attachments(12))),
      CALL(carried(attachments(0, nan))),
      CALL(carried(attachments(0), rows(7))),
      CALL(carried(attachments(0), cube.positions, Transforms::Zero(11, 9))),
      CALL(carried(attachments(0), cube.positions, Transforms::Constant(12, 9, nan))),
      CALL(comparison(rows(7))),
      CALL(comparison(cube.positions, with(&CompareOptions::crease_angle, nan))),
      CALL(comparison(cube.positions, with(&CompareOptions::crossing_limit, -1))),
      CALL(comparison(cube.positions, with(&CompareOptions::straight_chains, std::vector<std::vector<int>>{{0, 8}}))),
      CALL(compare(point.positions, point.positions, point.triangles)),
  };
}

}  // namespace swage::test

// Developable shapes: what the method promises, on generated shapes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "adjacency.h"
#include "measures.h"
#include "shapes.h"
#include "stylized.h"
#include "swage/stylize.h"

namespace swage::test {
namespace {

StylizeOptions options() {
  StylizeOptions of_triangles;
  of_triangles.energy = StylizeEnergy::farap;
  of_triangles.pass_limit = 120;
  return of_triangles;
}

/// On meshes coarse and fine, by default.
TEST(Developable, UnrollsMoreThanAtRest) {
  for (const auto& [mesh, more] :
       {std::pair(askew(sphere(1, 3)), 0.2), std::pair(askew(sphere(1, 4)), 0.45),
        std::pair(askew(bumpy_sphere(0.08, 3)), 0.15), std::pair(askew(bumpy_sphere(0.08)), 0.4)}) {
    const StylizeResult bent = stylize(mesh.positions, mesh.triangles, Developable{}, 1000, options());
    EXPECT_GT(flat_share(mesh, bent.positions), flat_share(mesh, mesh.positions) + more);
  }
}

/// Edges that turn by more than so many degrees.
int creases(const Mesh& mesh, const Positions& positions, double degrees) {
  const Edges edges = edges_of(mesh.triangles);
  const Positions normals = unit_normals(positions, mesh.triangles);
  int count = 0;
  for (int e = 0; e < edges.triangles.size(); ++e) {
    const Lists::Range beside = edges.triangles[e];
    const double cosine = normals.row(beside[0]).dot(normals.row(beside[1]));
    if (cosine < std::cos(degrees * std::numbers::pi / 180)) ++count;
  }
  return count;
}

TEST(Developable, MakesFewerCreasesTheLargerTauIs) {
  const Mesh mesh = askew(bumpy_sphere(0.08));
  int last = std::numeric_limits<int>::max();
  for (const double tau : {0.0, 0.25, 1.0}) {
    const StylizeResult bent = stylize(mesh.positions, mesh.triangles, Developable{tau}, 1000, options());
    const int now = creases(mesh, bent.positions, 20);
    EXPECT_LT(now, 0.9 * last);
    last = now;
  }
}

TEST(Developable, LeavesCurvatureToTheCreases) {
  const Mesh mesh = askew(bumpy_sphere(0.08));
  const StylizeResult bent = stylize(mesh.positions, mesh.triangles, Developable{}, 1000, options());
  const auto at_most_bent = [&](const Positions& positions) {
    Eigen::VectorXd defects = angle_defects(mesh, positions).cwiseAbs();
    std::sort(defects.begin(), defects.end());
    return defects.tail(defects.size() / 10).sum() / defects.sum();
  };
  EXPECT_GT(at_most_bent(bent.positions), 2 * at_most_bent(mesh.positions));
}

}  // namespace
}  // namespace swage::test

// Models of hundreds of parts: what they are, and the promises of resizing on them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "adjacency.h"
#include "ball_amid_slabs.h"
#include "contacts.h"
#include "grid_folds.h"
#include "resize_models.h"
#include "shapes.h"

namespace swage::test {
namespace {

using Factors = Eigen::RowVector3d;

class TableOne : public testing::TestWithParam<size_t> {
 protected:
  const TableLine& line_ = table_1()[GetParam()];
};

int component_count(const Mesh& mesh) {
  const std::vector<int> of = components(mesh.triangles, static_cast<int>(mesh.positions.rows()));
  return of.empty() ? 0 : 1 + *std::max_element(of.begin(), of.end());
}

/// Each edge of exactly two triangles, that wind opposite ways.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : mesh.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  }
  return std::all_of(uses.begin(), uses.end(), [&](const auto& use) {
    const auto other = uses.find({use.first.second, use.first.first});
    return use.second == 1 && other != uses.end() && other->second == 1;
  });
}

TEST_P(TableOne, HasTheFacesAndComponentsOfThePaper) {
  const Assembled model = line_.make(line_.detail);
  EXPECT_NEAR(static_cast<double>(model.mesh.triangles.rows()) / line_.faces, 1, 0.05);
  EXPECT_EQ(component_count(model.mesh), line_.components);
  EXPECT_EQ(static_cast<int>(model.parts.size()), line_.components);
  const Factors cell =
      extents(model.mesh.positions).cwiseQuotient(Factors(line_.cells[0], line_.cells[1], line_.cells[2]));
  EXPECT_LT(cell.maxCoeff() / cell.minCoeff(), 1.25);  // Cells of its grid are near cubes.
}

TEST_P(TableOne, IsOfClosedParts) {
  const Assembled model = line_.make(0.8);
  EXPECT_TRUE(is_closed(model.mesh));
  for (const Part& part : model.parts) {
    Mesh alone{model.mesh.positions.middleRows(part.first, part.count), Triangles(0, 3)};
    std::vector<Eigen::RowVector3i> own;
    for (const auto& t : model.mesh.triangles.rowwise()) {
      if (t[0] >= part.first && t[0] < part.first + part.count)
        own.emplace_back(t.array() - static_cast<int>(part.first));
    }
    alone.triangles.resize(static_cast<Eigen::Index>(own.size()), 3);
    for (size_t i = 0; i < own.size(); ++i) alone.triangles.row(static_cast<Eigen::Index>(i)) = own[i];
    EXPECT_GT(volume(alone), 0) << part.name;
  }
}

TEST_P(TableOne, KeepsThePromises) {
  const Assembled model = line_.make(0.6);
  const double D = box_diagonal(model.mesh.positions);
  Resize plan(model.mesh.positions, model.mesh.triangles, coarse());
  const std::vector<std::pair<int, int>> met = vertices_met(model);
  EXPECT_LT((plan.solve({}).positions - model.mesh.positions).cwiseAbs().maxCoeff(), 1e-9 * D);
  for (const Factors& factors : {line_.factors, Factors(2, 1, 1), Factors(1, 0.5, 1), Factors(0.3, 1, 3)}) {
    SCOPED_TRACE(testing::Message() << factors);
    for (const ResizeKeep keep : {ResizeKeep::shape, ResizeKeep::size}) {
      const ResizeResult result = plan.solve(by(factors[0], factors[1], factors[2], keep));
      EXPECT_LT((extents(result.positions) - factors.cwiseProduct(extents(model.mesh.positions))).norm(), 1e-6 * D);
      EXPECT_GT(least_determinant(plan.shape(), result.grid), 0);
      for (const auto& [a, b] : met) {
        ASSERT_LT((result.positions.row(a) - result.positions.row(b)).norm(), 1e-9 * D) << a << " " << b;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, TableOne, testing::Range(size_t{0}, table_1().size()), [](const auto& index) {
  std::string name = table_1()[index.param].name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

TEST(Assemblies, PartsThatMetStillDo) {
  // Else the promise above would hold of nothing: axles end on rims, caps on the shell.
  EXPECT_GE(vertices_met(car()).size(), 100U);
  EXPECT_GE(vertices_met(tank()).size(), 80U);
}

TEST(Assemblies, AreScaledByOneFactor) {
  const Assembled model = car();
  const Eigen::RowVector3d low = model.mesh.positions.colwise().minCoeff();
  for (const double factor : {0.05, 0.7, 20.0}) {
    const Positions due = (factor * (model.mesh.positions.rowwise() - low)).rowwise() + low;
    const Positions result = resize(model.mesh.positions, model.mesh.triangles, by(factor, factor, factor)).positions;
    EXPECT_LT((result - due).rowwise().norm().maxCoeff(), 1e-6 * box_diagonal(due));
  }
}

TEST(Assemblies, TurnWithTheModel) {
  const Assembled model = car();
  const auto turned = [](const Positions& positions, int axis) {
    return quarter_turned(axis, Mesh{positions, Triangles(0, 3)}).positions;
  };
  const Positions result = resize(model.mesh.positions, model.mesh.triangles, by(1.8, 1, 0.9)).positions;
  const std::array<ResizeTarget, 3> targets = {by(1.8, 0.9, 1), by(0.9, 1, 1.8), by(1, 1.8, 0.9)};
  for (int axis = 0; axis < 3; ++axis) {
    Positions due = turned(result, axis);
    Positions of_turned =
        resize(turned(model.mesh.positions, axis), model.mesh.triangles, targets[static_cast<size_t>(axis)]).positions;
    // Each keeps the low corner of its own box.
    due.rowwise() -= due.colwise().minCoeff().eval();
    of_turned.rowwise() -= of_turned.colwise().minCoeff().eval();
    EXPECT_LT((of_turned - due).rowwise().norm().maxCoeff(), 1e-5 * box_diagonal(due)) << axis;
  }
}

}  // namespace
}  // namespace swage::test

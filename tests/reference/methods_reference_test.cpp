// Slippage-preserving reshaping beside the methods it is judged against, on the authors' own gestures. Their largest
// models are left to the evidence (bench/evidence.cpp), which takes minutes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "authors.h"
#include "edit_measures.h"
#include "places.h"
#include "swage/compare.h"
#include "swage/deform.h"

namespace swage {
namespace {

std::vector<test::AuthorsName> small_ones() {
  std::vector<test::AuthorsName> names = test::authors_names();
  std::erase_if(names, [](const test::AuthorsName& name) {
    const std::string model = name.model;
    return model == "screwdriver" || model == "m0839_sofa" || model == "f5-1_antique_chair";
  });
  return names;
}

class MethodsOnGesture : public testing::TestWithParam<test::AuthorsName> {
 protected:
  void SetUp() override {
    if (!test::has_shared()) GTEST_SKIP() << "the authors' models are not here";
    authors_ = test::authors_gesture(GetParam().model, GetParam().gesture, ReshapeSolver::steady);
  }

  Positions by(ReshapeMethod method) const {
    ReshapeOptions options = authors_.options;
    options.method = method;
    return reshape(authors_.mesh.positions, authors_.mesh.triangles, authors_.gesture, options).positions;
  }

  Positions by(DeformMethod method) const {
    DeformOptions options;
    options.method = method;
    return deform(authors_.mesh.positions, authors_.mesh.triangles, authors_.gesture, options).positions;
  }

  test::AuthorsGesture authors_;
};

TEST_P(MethodsOnGesture, TurnNormalsMoreThanSlippageDoes) {
  const auto change = [&](auto method) { return test::mean_normal_change(authors_.mesh, by(method)); };
  const double slippage = change(ReshapeMethod::slippage);
  EXPECT_GT(change(ReshapeMethod::alup), slippage);
  for (const DeformMethod method :
       {DeformMethod::poisson, DeformMethod::arap, DeformMethod::arap_volume, DeformMethod::conformal}) {
    EXPECT_GT(change(method), slippage) << to_string(method);
  }
}

INSTANTIATE_TEST_SUITE_P(Authors, MethodsOnGesture, testing::ValuesIn(small_ones()),
                         [](const auto& tested) { return test::test_name(tested.param.model, tested.param.gesture); });

/// But for a similarity, which the conformal method finds where two handles leave it one: it loses no slippage at all.
TEST(MethodsOnTheCylinder, LoseMoreSlippageThanSlippageDoes) {
  if (!test::has_shared()) GTEST_SKIP() << "the authors' models are not here";
  for (const char* label : {"def_v0", "def_v1", "def_v2", "def_v3"}) {
    const test::AuthorsGesture authors = test::authors_gesture("cylinder_1kF", label, ReshapeSolver::steady);
    const Mesh& mesh = authors.mesh;
    const auto loss = [&](const Positions& edit) {
      return compare(mesh.positions, edit, mesh.triangles).slippage_loss.mean;
    };
    ReshapeOptions reshaping = authors.options;
    const double slippage = loss(reshape(mesh.positions, mesh.triangles, authors.gesture, reshaping).positions);
    EXPECT_LT(slippage, 0.1) << label;
    reshaping.method = ReshapeMethod::alup;
    EXPECT_GT(loss(reshape(mesh.positions, mesh.triangles, authors.gesture, reshaping).positions), 2 * slippage);
    for (const DeformMethod method : {DeformMethod::poisson, DeformMethod::arap, DeformMethod::arap_volume}) {
      DeformOptions options;
      options.method = method;
      EXPECT_GT(loss(deform(mesh.positions, mesh.triangles, authors.gesture, options).positions), 5 * slippage)
          << label << ' ' << to_string(method);
    }
  }
}

}  // namespace
}  // namespace swage

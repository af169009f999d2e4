// The transform step's matrix as a product, against that matrix assembled.
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "opencl_device.h"
#include "plan.h"
#include "rests.h"
#include "shapes.h"

namespace swage {
namespace {

using test::rest_of;

Transforms random_transforms(Eigen::Index count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Transforms::NullaryExpr(count, 9, [&] { return normal(random); });
}

Transforms assembled_product(const TransformStep::Rest& rest, const Transforms& transforms) {
  const Eigen::Map<const Eigen::VectorXd> flat(transforms.data(), transforms.size());
  const Eigen::VectorXd product = transform_system(rest).times(flat);
  return Eigen::Map<const Transforms>(product.data(), transforms.rows(), 9);
}

Transforms product_by(const Backend& backend, const TransformStep::Rest& rest, const Transforms& transforms) {
  Transforms product;
  backend.coupling(rest)->apply(transforms, product);
  return product;
}

/// The worst row's error in parts of the largest row.
double error(const Transforms& product, const Transforms& expected) {
  if (expected.rows() == 0) return static_cast<double>(product.rows());
  return (product - expected).rowwise().norm().maxCoeff() / expected.rowwise().norm().maxCoeff();
}

void expect_the_assembled(const Backend& backend, double tolerance) {
  for (const auto& [name, rest] : test::rest_families()) {
    const Transforms transforms = random_transforms(rest.triangles.rows(), 1);
    EXPECT_LT(error(product_by(backend, rest, transforms), assembled_product(rest, transforms)), tolerance) << name;
  }
}

TEST(CouplingStep, IsTheAssembledMatrix) { expect_the_assembled(*cpu_backend(), 1e-12); }

TEST(CouplingStep, IsTheAssembledMatrixOnADeviceInDouble) {
  if (const auto backend = test::opencl_or_skip(Precision::twice)) expect_the_assembled(*backend, 1e-12);
}

TEST(CouplingStep, IsTheAssembledMatrixOnADeviceInSingle) {
  if (const auto backend = test::opencl_or_skip(Precision::single)) expect_the_assembled(*backend, 2e-6);
}

TEST(CouplingStep, KeepsIdentitiesUpToTheirOwnPull) {
  // Neighbours agree, normals do not tilt: what is left is sum e e' / L and the regularizer.
  const TransformStep::Rest rest = rest_of(test::torus());
  const Transforms product = product_by(*cpu_backend(), rest, identities(rest.triangles.rows()));
  for (Eigen::Index t = 0; t < product.rows(); ++t) {
    Eigen::Matrix3d pull = rest.regularizer_weight * Eigen::Matrix3d::Identity();
    pull += rest.normal_regularizer_weight * rest.normals.row(t).transpose() * rest.normals.row(t);
    for (const int e : rest.triangle_edges.row(t)) {
      pull += rest.edge_vectors.row(e).transpose() * rest.edge_vectors.row(e) / rest.mean_edge_length;
    }
    EXPECT_NEAR((product.row(t).transpose() - pull.reshaped()).norm(), 0, 1e-12 * pull.norm());
  }
}

TEST(CouplingStep, AMillionTrianglesOnADevice) {
  const TransformStep::Rest rest = rest_of(test::sheet(708));
  ASSERT_GT(rest.triangles.rows(), 1'000'000);
  const Transforms transforms = random_transforms(rest.triangles.rows(), 2);
  const Transforms expected = product_by(*cpu_backend(), rest, transforms);
  for (const auto& [precision, tolerance] : {std::pair{Precision::twice, 1e-12}, {Precision::single, 2e-6}}) {
    const auto backend = test::opencl_or_skip(precision);
    if (!backend) return;
    const Transforms product = product_by(*backend, rest, transforms);
    EXPECT_LT(error(product, expected), tolerance);
    EXPECT_EQ(product_by(*backend, rest, transforms), product) << "bytes differ from run to run";
  }
}

TEST(CouplingStep, TwoStepsOnTwoThreads) {
  const auto backend = test::opencl_or_skip(Precision::single);
  if (!backend) return;
  const TransformStep::Rest rests[] = {rest_of(test::torus()), rest_of(test::box())};
  Transforms inputs[2], products[2];
  std::vector<std::thread> threads;
  for (size_t i = 0; i < 2; ++i) {
    inputs[i] = random_transforms(rests[i].triangles.rows(), 3);
    threads.emplace_back([&, i] {
      const auto step = backend->coupling(rests[i]);
      for (int pass = 0; pass < 50; ++pass) step->apply(inputs[i], products[i]);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (size_t i = 0; i < 2; ++i) EXPECT_EQ(products[i], product_by(*backend, rests[i], inputs[i]));
}

}  // namespace
}  // namespace swage

// The transform step on a device, against the reference and, bit for bit, against the same maths as C++.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>

#include "measures.h"
#include "opencl_device.h"
#include "plan.h"
#include "rests.h"
#include "shapes.h"

namespace swage {
namespace {

// Each needs those before it.
// clang-format off
namespace in_single {
using real = float;
#include "lane.h"
using std::fabs, std::sqrt;
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/wide.h"
#include "shared/transform.h"
}  // namespace in_single
// clang-format on

using test::rest_of;

TransformStep::Rest with_kept(TransformStep::Rest rest) {
  rest.target_lengths = 1.5 * rest.edge_vectors.rowwise().norm();
  rest.length_weights = Eigen::VectorXd::LinSpaced(rest.edges.rows(), 1, 3);
  return rest;
}

std::vector<std::pair<std::string, TransformStep::Rest>> families() {
  auto families = test::rest_families();
  families.emplace_back("lengths kept", with_kept(rest_of(test::box())));
  families.emplace_back("far away", rest_of(test::transformed(test::sphere(0.01), 1, {1, 1, 1})));
  return families;
}

/// What a pass brings: transforms somewhat off the identity, positions somewhat off a stretched rest.
struct Input {
  Transforms transforms;
  Positions positions;
};

Input input_for(const TransformStep::Rest& rest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Input input{identities(rest.triangles.rows()), rest.vertices * Eigen::Vector3d(1.2, 0.9, 1.1).asDiagonal()};
  input.transforms += 0.2 * Transforms::NullaryExpr(rest.triangles.rows(), 9, [&] { return uniform(random); });
  const double shift = 0.2 * rest.mean_edge_length;
  input.positions += shift * Positions::NullaryExpr(rest.vertices.rows(), 3, [&] { return uniform(random); });
  return input;
}

struct Output {
  TransformStep::EdgeQuadratics quadratics;
  Transforms right_hand_sides;
  TransformStep::Energy energy;
  TransformStep::EdgeQuadratics again;  // After the length weights changed.
};

Output pass(TransformStep& step, const Input& input) {
  Output output;
  step.fit_edges(input.transforms, output.quadratics);
  output.energy = step.fit_transforms(input.positions, output.right_hand_sides);
  step.fit_edges(input.transforms, output.again);
  return output;
}

Output pass(const Backend& backend, const TransformStep::Rest& rest, const Input& input) {
  return pass(*backend.transform(rest), input);
}

std::array<double, 9> terms(const TransformStep::Energy& e) {
  return {e.transform,   e.normal,          e.scale, e.sphericity, e.connect, e.similarity, e.transform_sphericity,
          e.regularizer, e.transform_normal};
}

/// The worst row's error in parts of that row.
template <typename Matrix>
double row_error(const Matrix& matrix, const Matrix& expected) {
  if (matrix.rows() != expected.rows()) return 1;
  double worst = 0;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    worst = std::max(worst, (matrix.row(i) - expected.row(i)).norm() / expected.row(i).norm());
  }
  return worst;
}

struct Tolerance {
  double elements, energy;
};

void expect_near(const TransformStep::EdgeQuadratics& edges, const TransformStep::EdgeQuadratics& expected,
                 double tolerance) {
  EXPECT_LT(row_error(edges.blocks, expected.blocks), tolerance);
  EXPECT_LT(row_error(edges.right_hand_sides, expected.right_hand_sides), tolerance);
  EXPECT_LT(row_error(edges.target_lengths, expected.target_lengths), tolerance);
  EXPECT_EQ(edges.singular, expected.singular);
}

void expect_near(const Output& output, const Output& expected, const Tolerance& tolerance) {
  expect_near(output.quadratics, expected.quadratics, tolerance.elements);
  expect_near(output.again, expected.again, tolerance.elements);
  EXPECT_LT(row_error(output.right_hand_sides, expected.right_hand_sides), tolerance.elements);
  const auto energy = terms(output.energy), expected_energy = terms(expected.energy);
  for (size_t k = 0; k < energy.size(); ++k) {
    EXPECT_NEAR(energy[k], expected_energy[k], tolerance.energy * expected_energy[k]) << "term " << k;
  }
}

void expect_the_references(const Backend& backend, const Tolerance& tolerance) {
  for (const auto& [name, rest] : families()) {
    SCOPED_TRACE(name);
    const Input input = input_for(rest, 1);
    const auto step = backend.transform(rest);
    const Output expected = pass(*cpu_backend(), rest, input), output = pass(*step, input);
    expect_near(output, expected, tolerance);
    step->reset();
    const Output again = pass(*step, input);
    EXPECT_EQ(again.quadratics.blocks, output.quadratics.blocks);
    EXPECT_EQ(again.right_hand_sides, output.right_hand_sides);
    EXPECT_EQ(terms(again.energy), terms(output.energy));
  }
}

TEST(TransformOnADevice, IsTheReferenceInDouble) {
  if (const auto backend = test::opencl_or_skip(Precision::twice)) expect_the_references(*backend, {1e-12, 1e-12});
}

TEST(TransformOnADevice, IsTheReferenceInSingle) {
  if (const auto backend = test::opencl_or_skip(Precision::single)) expect_the_references(*backend, {2e-5, 1e-5});
}

TEST(TransformOnADevice, AMillionTrianglesAreTheReference) {
  const TransformStep::Rest rest = rest_of(test::sheet(708));
  ASSERT_GT(rest.triangles.rows(), 1'000'000);
  const Input input = input_for(rest, 8);
  const Output expected = pass(*cpu_backend(), rest, input);
  for (const auto& [precision, tolerance] :
       {std::pair{Precision::twice, Tolerance{1e-12, 1e-12}}, {Precision::single, Tolerance{2e-5, 1e-5}}}) {
    const auto backend = test::opencl_or_skip(precision);
    if (!backend) return;
    expect_near(pass(*backend, rest, input), expected, tolerance);
  }
}

Transforms rows_of(const std::vector<Eigen::Matrix3d>& matrices) {
  Transforms transforms(static_cast<Eigen::Index>(matrices.size()), 9);
  for (Eigen::Index t = 0; t < transforms.rows(); ++t) {
    transforms.row(t) = matrices[static_cast<size_t>(t)].reshaped<Eigen::RowMajor>();
  }
  return transforms;
}

TEST(TransformOnADevice, CountsTheSameSingularTransforms) {
  const TransformStep::Rest rest = rest_of(test::sphere());
  std::vector<Eigen::Matrix3d> matrices;
  std::srand(4);
  for (Eigen::Index t = 0; t < rest.triangles.rows(); ++t) {
    const Eigen::Matrix3d a = Eigen::Matrix3d::Random(), b = Eigen::Matrix3d::Random();
    const double small = std::array{0.0, 1e-10, 1e-2}[static_cast<size_t>(t % 3)];
    matrices.push_back(std::pow(10, t % 7 - 3) * a * Eigen::Vector3d(1, 0.5, small).asDiagonal() * b);
  }
  for (Eigen::Index k = 0; k < 9; ++k) matrices[static_cast<size_t>(k)].setZero();
  const Transforms transforms = rows_of(matrices);
  TransformStep::EdgeQuadratics expected;
  cpu_backend()->transform(rest)->fit_edges(transforms, expected);
  for (const Precision precision : {Precision::twice, Precision::single}) {
    const auto backend = test::opencl_or_skip(precision);
    if (!backend) return;
    TransformStep::EdgeQuadratics quadratics;
    backend->transform(rest)->fit_edges(transforms, quadratics);
    EXPECT_GT(quadratics.singular, rest.triangles.rows() / 2);
    EXPECT_EQ(quadratics.singular, expected.singular);
    EXPECT_TRUE(quadratics.blocks.allFinite() && quadratics.right_hand_sides.allFinite());
  }
}

TEST(TransformOnADevice, CollapsedPositionsStayFinite) {
  for (const Precision precision : {Precision::twice, Precision::single}) {
    const auto backend = test::opencl_or_skip(precision);
    if (!backend) return;
    for (const auto& [name, rest] : test::rest_families()) {
      if (rest.triangles.rows() > 200) continue;  // Oclgrind runs this one.
      const Positions collapsed = Positions::Zero(rest.vertices.rows(), 3);
      const Output output = pass(*backend, rest, {identities(rest.triangles.rows()), collapsed});
      for (const double term : terms(output.energy)) EXPECT_TRUE(std::isfinite(term)) << name;
      EXPECT_TRUE(output.again.blocks.allFinite()) << name;
    }
  }
}

in_single::Vec3 single3(const Eigen::RowVector3d& v) {
  return in_single::vec3(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]));
}

in_single::Mat3 single9(const Eigen::Matrix<double, 1, 9>& m) {
  return in_single::mat3(single3(m.segment<3>(0)), single3(m.segment<3>(3)), single3(m.segment<3>(6)));
}

TEST(TransformOnADevice, IsTheSameMathsAsInCppBitForBit) {
  const auto backend = test::opencl_or_skip(Precision::single);
  if (!backend) return;
  const double tolerance = test::sees_rounded(*backend) ? 1e-5 : 0;  // A GPU's functions round as they like.
  const TransformStep::Rest rest = rest_of(test::torus());
  const Edges edges = edges_of(rest.triangles);
  const Input input = input_for(rest, 5);
  TransformStep::EdgeQuadratics quadratics;
  backend->transform(rest)->fit_edges(input.transforms, quadratics);
  const auto normal_weight = static_cast<float>(rest.normal_weight / rest.mean_edge_length);
  const auto scale = static_cast<float>(rest.scale_weight / rest.mean_edge_length);
  for (int e = 0; e < rest.edges.rows(); ++e) {
    const Eigen::RowVector3d vector = rest.edge_vectors.row(e);
    const auto side = [&](int t) {
      const in_single::Mat3 transform = single9(input.transforms.row(t));
      return in_single::edge_side(in_single::apply3(transform, single3(vector)),
                                  in_single::damped_inverse(transform).matrix, single3(rest.normals.row(t)),
                                  single3(vector));
    };
    const Lists::Range beside = edges.triangles[e];
    const in_single::EdgeSum sum = in_single::add_sides(side(beside[0]), side(beside[1]));
    const double weight = std::max(1.0, vector.squaredNorm() / (rest.mean_edge_length * rest.mean_edge_length));
    const float target = in_single::target_length(sum.length / 2, 0, single3(vector));
    const in_single::EdgeQuadratic expected =
        in_single::edge_quadratic(sum, 1, single3(vector), static_cast<float>(weight), target, normal_weight, scale);
    const auto& [diagonal, mixed] = expected.block;
    const Eigen::Matrix<double, 1, 6> block{diagonal.x, mixed.x, mixed.y, diagonal.y, mixed.z, diagonal.z};
    EXPECT_LE((quadratics.blocks.row(e) - block).norm(), tolerance * block.norm()) << "edge " << e;
    EXPECT_NEAR(quadratics.target_lengths[e], target, tolerance * target) << "edge " << e;
  }
}

TEST(TransformOnADevice, GivesTheSameBytesFromRunToRun) {
  const TransformStep::Rest rest = rest_of(test::sphere(0.5, 5));
  const Input input = input_for(rest, 2);
  for (const Precision precision : {Precision::twice, Precision::single}) {
    const auto backend = test::opencl_or_skip(precision);
    if (!backend) return;
    const Output first = pass(*backend, rest, input), second = pass(*backend, rest, input);
    EXPECT_EQ(first.again.blocks, second.again.blocks);
    EXPECT_EQ(first.right_hand_sides, second.right_hand_sides);
    EXPECT_EQ(terms(first.energy), terms(second.energy));
  }
}

TEST(TransformOnADevice, TwoStepsOnTwoThreads) {
  const auto backend = test::opencl_or_skip(Precision::single);
  if (!backend) return;
  const TransformStep::Rest rests[] = {rest_of(test::torus()), rest_of(test::box())};
  const Input inputs[] = {input_for(rests[0], 6), input_for(rests[1], 7)};
  Output outputs[2];
  std::vector<std::thread> threads;
  for (size_t i = 0; i < 2; ++i) {
    threads.emplace_back([&, i] {
      for (int round = 0; round < 20; ++round) outputs[i] = pass(*backend, rests[i], inputs[i]);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (size_t i = 0; i < 2; ++i) {
    const Output alone = pass(*backend, rests[i], inputs[i]);
    EXPECT_EQ(outputs[i].again.blocks, alone.again.blocks);
    EXPECT_EQ(terms(outputs[i].energy), terms(alone.energy));
  }
}

TEST(TransformOnADevice, OnlyWhatChangesCrosses) {
  const auto backend = test::opencl_or_skip(Precision::twice);
  if (!backend) return;
  const TransformStep::Rest rest = rest_of(test::torus());
  const Input input = input_for(rest, 3);
  const auto step = backend->transform(rest);
  const Traffic before = backend->traffic();
  TransformStep::EdgeQuadratics quadratics;
  step->fit_edges(input.transforms, quadratics);
  Transforms sides;
  step->fit_transforms(input.positions, sides);
  const Traffic after = backend->traffic();
  EXPECT_EQ(after.uploaded - before.uploaded,
            8 * static_cast<size_t>(input.transforms.size() + input.positions.size()));
  const auto results = static_cast<size_t>(10 * rest.edges.rows() + sides.size());
  EXPECT_GE(after.downloaded - before.downloaded, 8 * results);
  EXPECT_LT(after.downloaded - before.downloaded, 9 * results) << "sums come down by blocks";
}

}  // namespace
}  // namespace swage

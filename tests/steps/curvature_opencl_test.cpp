// The curvature step: what its result must be, by every backend.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "adjacency.h"
#include "measures.h"
#include "opencl_device.h"
#include "shapes.h"
#include "swage/curvature.h"

namespace swage {
namespace {

using Eigen::Index;
using Rest = CurvatureStep::Rest;

struct Who {
  const char* name;
  std::shared_ptr<Backend> (*backend)();
  double tolerance;  // Of a height, in parts of the neighbourhood's size.
};

const Who kWho[] = {
    {"cpu", [] { return cpu_backend(); }, 1e-12},
    {"opencl_single", [] { return test::opencl_or_skip(Precision::single); }, 2e-5},
    {"opencl_double", [] { return test::opencl_or_skip(Precision::twice); }, 1e-11},
};

Curvatures fitted(const Backend& backend, const Rest& rest) {
  Curvatures curvatures;
  backend.curvature(rest)->fit(curvatures);
  return curvatures;
}

class CurvatureStepBy : public testing::TestWithParam<Who> {
 protected:
  void SetUp() override { backend_ = GetParam().backend(); }

  std::shared_ptr<Backend> backend_;
};

/// Every vertex with those within two edges.
Rest two_rings(const Mesh& mesh) {
  const int count = static_cast<int>(mesh.positions.rows());
  const Lists near = one_rings(edges_of(mesh.triangles), count);
  Rest rest{mesh.positions, vertex_normals(mesh.positions, mesh.triangles), {0}, {}};
  std::vector<int> seen_from(static_cast<size_t>(count), -1);
  for (int v = 0; v < count; ++v) {
    auto add = [&](int neighbour) {
      if (std::exchange(seen_from[static_cast<size_t>(neighbour)], v) != v) rest.neighbours.push_back(neighbour);
    };
    seen_from[static_cast<size_t>(v)] = v;
    for (const int first : near[v]) {
      add(first);
      for (const int second : near[first]) add(second);
    }
    rest.offsets.push_back(static_cast<int>(rest.neighbours.size()));
  }
  return rest;
}

/// z = f(x, y) over a sheet whose places are moved a little at random.
Mesh graph(int cells, const std::function<double(double, double)>& f) {
  Mesh mesh = test::sheet(cells);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.3 / cells, 0.3 / cells);
  for (auto p : mesh.positions.rowwise()) {
    p[0] += jitter(random);
    p[1] += jitter(random);
    p[2] = f(p[0], p[1]);
  }
  return mesh;
}

double waves(double x, double y) { return 0.05 * std::sin(9 * x) * std::cos(7 * y); }

Mesh stretched(Mesh mesh, const Eigen::RowVector3d& factors) {
  mesh.positions *= factors.asDiagonal();
  return mesh;
}

Mesh turned(Mesh mesh) {
  mesh.positions *= Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix().transpose();
  return mesh;
}

/// Some vertices without neighbours, in a mesh that has them.
Rest with_gaps(Rest rest) {
  Rest gaps{rest.positions, rest.normals, {0}, {}};
  for (size_t v = 0; v + 1 < rest.offsets.size(); ++v) {
    const bool gap = v < 3 || v % 7 == 0 || v + 2 == rest.offsets.size();
    const auto first = rest.neighbours.begin() + rest.offsets[v], last = rest.neighbours.begin() + rest.offsets[v + 1];
    if (!gap) gaps.neighbours.insert(gaps.neighbours.end(), first, last);
    gaps.offsets.push_back(static_cast<int>(gaps.neighbours.size()));
  }
  return gaps;
}

std::vector<std::pair<std::string, Rest>> families() {
  const Mesh triangle{Eigen::Matrix3d{{0, 0, 0}, {1, 0, 0}, {0.3, 0.8, 0.1}}, Triangles(Eigen::RowVector3i(0, 1, 2))};
  const Mesh wavy = graph(20, waves);
  return {{"torus", two_rings(test::torus())},
          {"sphere", two_rings(test::sphere(1, 3))},
          {"sharp edges", two_rings(turned(test::box({1, 2, 3}, 6)))},
          {"with boundary", two_rings(wavy)},
          {"needles", two_rings(turned(stretched(wavy, {1, 1e-2, 1e-2})))},
          {"flat", two_rings(turned(graph(20, [](double, double) { return 0; })))},
          {"with gaps", with_gaps(two_rings(test::torus()))},
          {"one triangle", two_rings(triangle)},
          {"none", {Positions(0, 3), Positions(0, 3), {0}, {}}},
          {"tiny", two_rings(test::transformed(turned(wavy), 1e-4, {0, 0, 0}))},
          {"huge", two_rings(test::transformed(turned(wavy), 1e4, {0, 0, 0}))},
          {"small in a large place", two_rings(test::joined(turned(wavy), test::transformed(wavy, 1, {1000, 0, 0})))}};
}

/// How large a curvature is that heights of the neighbourhood's size make: in 1 / length.
double curvature_unit(const Rest& rest, Index v) {
  const auto at = static_cast<size_t>(v);
  Eigen::MatrixX3d offsets(rest.offsets[at + 1] - rest.offsets[at], 3);
  for (Index k = 0; k < offsets.rows(); ++k) {
    const int neighbour = rest.neighbours[static_cast<size_t>(rest.offsets[at] + k)];
    offsets.row(k) = rest.positions.row(neighbour) - rest.positions.row(v);
  }
  if (offsets.rows() == 0) return 1;
  const Eigen::Vector3d normal = rest.normals.row(v);
  const Eigen::MatrixX3d places = offsets - offsets * normal * normal.transpose();
  const double narrow = Eigen::JacobiSVD<Eigen::MatrixXd>(places).singularValues()[1];
  return places.norm() / (narrow * narrow) * std::sqrt(static_cast<double>(places.rows()));
}

TEST_P(CurvatureStepBy, IsTheReference) {
  if (!backend_) return;
  for (const auto& [name, rest] : families()) {
    const Curvatures found = fitted(*backend_, rest), expected = fitted(*cpu_backend(), rest);
    ASSERT_EQ(found.rows(), rest.positions.rows()) << name;
    double worst = 0;
    for (Index v = 0; v < found.rows(); ++v) {
      ASSERT_TRUE(found.row(v).allFinite()) << name << ", vertex " << v;
      ASSERT_GE(found(v, 0), found(v, 1)) << name << ", vertex " << v;
      const double unit = curvature_unit(rest, v) + expected.row(v).cwiseAbs().maxCoeff();
      worst = std::max(worst, (found.row(v) - expected.row(v)).cwiseAbs().maxCoeff() / unit);
    }
    EXPECT_LE(worst, GetParam().tolerance) << name;
  }
}

TEST_P(CurvatureStepBy, DirectsAsTheReference) {
  if (!backend_) return;
  for (const auto& [name, rest] : families()) {
    Curvatures found, expected;
    Positions directions, expected_directions;
    backend_->curvature(rest)->fit(found, directions);
    cpu_backend()->curvature(rest)->fit(expected, expected_directions);
    EXPECT_EQ(found, fitted(*backend_, rest)) << name;
    ASSERT_EQ(directions.rows(), found.rows()) << name;
    double worst = 0;
    for (Index v = 0; v < found.rows(); ++v) {
      const Eigen::RowVector3d one = directions.row(v), other = expected_directions.row(v);
      if (expected(v, 0) == expected(v, 1)) continue;
      ASSERT_NEAR(one.norm(), 1, 1e-5) << name << ", vertex " << v;
      const double unit = curvature_unit(rest, v) + expected.row(v).cwiseAbs().maxCoeff();
      worst = std::max(worst, (expected(v, 0) - expected(v, 1)) * one.cross(other).norm() / unit);
    }
    EXPECT_LE(worst, 4 * GetParam().tolerance) << name;
  }
}

TEST_P(CurvatureStepBy, DirectsAroundATube) {
  if (!backend_) return;
  const Mesh torus = test::torus(1, 0.4, 128, 64);
  Curvatures curvatures;
  Positions directions;
  backend_->curvature(two_rings(torus))->fit(curvatures, directions);
  for (Index v = 0; v < directions.rows(); ++v) {
    const Eigen::RowVector3d at = torus.positions.row(v);
    const Eigen::RowVector3d middle = Eigen::RowVector3d(at[0], at[1], 0).normalized();
    const Eigen::RowVector3d along = Eigen::RowVector3d(0, 0, 1).cross(middle);
    ASSERT_NEAR(std::abs(directions.row(v).dot(along.cross(at - middle) / 0.4)), 1, 1e-3) << "vertex " << v;
  }
}

/// The largest difference from what is expected at a vertex, away from borders.
double largest_error(const Rest& rest, const Curvatures& found, size_t full,
                     const std::function<Eigen::RowVector2d(const Eigen::RowVector3d&)>& expected) {
  double largest = 0;
  for (Index v = 0; v < found.rows(); ++v) {
    const auto at = static_cast<size_t>(v);
    if (static_cast<size_t>(rest.offsets[at + 1] - rest.offsets[at]) < full) continue;
    largest = std::max(largest, (found.row(v) - expected(rest.positions.row(v))).cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST_P(CurvatureStepBy, FollowsTheClosedForms) {
  if (!backend_) return;
  // What a quadric misses of them shrinks with the squared size of the neighbourhood.
  const Rest sphere = two_rings(test::sphere(2.5, 4));
  EXPECT_LT(largest_error(sphere, fitted(*backend_, sphere), 0,
                          [](const Eigen::RowVector3d&) { return Eigen::RowVector2d(0.4, 0.4); }),
            0.02 * 0.4);
  const Rest torus = two_rings(test::torus(1, 0.4, 128, 64));
  EXPECT_LT(largest_error(torus, fitted(*backend_, torus), 0,
                          [](const Eigen::RowVector3d& at) {
                            const double distance = std::hypot(at.x(), at.y()), cosine = (distance - 1) / 0.4;
                            return Eigen::RowVector2d(1 / 0.4, cosine / distance);
                          }),
            0.03 / 0.4);
  const Mesh tube = test::cylinder(0.5, 2, 64, 40);
  const Curvatures on_tube = curvature(tube.positions, tube.triangles, {}, *backend_);
  for (Index t = 0; t < on_tube.rows(); ++t) {
    const double height = tube.positions(tube.triangles(t, 0), 1);
    if (height < 0.3 || height > 1.7) continue;
    ASSERT_NEAR(on_tube(t, 0), 2, 0.06);
    ASSERT_NEAR(on_tube(t, 1), 0, 0.03);
  }
}

TEST_P(CurvatureStepBy, FindsASaddle) {
  if (!backend_) return;
  // The graph of a quadric is fitted whole, whatever the neighbours: k = ∓2 at its middle.
  Mesh mesh = graph(20, [](double x, double y) { return (x - 0.5) * (x - 0.5) - (y - 0.5) * (y - 0.5); });
  mesh.positions.row(220) << 0.5, 0.5, 0;
  Rest rest = two_rings(mesh);
  rest.normals.row(220) << 0, 0, 1;
  const Curvatures found = fitted(*backend_, rest);
  EXPECT_NEAR(found(220, 0), 2, 3e3 * GetParam().tolerance);
  EXPECT_NEAR(found(220, 1), -2, 3e3 * GetParam().tolerance);
}

TEST_P(CurvatureStepBy, ScalesWithTheMesh) {
  if (!backend_) return;
  const Mesh mesh = graph(20, waves);
  const Curvatures expected = fitted(*backend_, two_rings(mesh));
  for (const double scale : {1e-4, 1e4}) {
    const Curvatures found = fitted(*backend_, two_rings(test::transformed(mesh, scale, {0, 0, 0})));
    EXPECT_LT((scale * found - expected).cwiseAbs().maxCoeff(), 1e2 * GetParam().tolerance);
  }
}

/// A vertex with neighbours at these places, its normal leaning, and others without.
Rest stage(const std::vector<Eigen::Vector3d>& places) {
  const Eigen::Matrix3d frame = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const int count = static_cast<int>(places.size());
  Rest rest{
      Eigen::RowVector3d(4, 5, 6).replicate(count + 1, 1), frame.col(2).transpose().replicate(count + 1, 1), {0}, {}};
  for (int i = 0; i < count; ++i) {
    rest.positions.row(i + 1) += (frame * places[static_cast<size_t>(i)]).transpose();
    rest.neighbours.push_back(i + 1);
  }
  rest.offsets.resize(static_cast<size_t>(count) + 2, count);
  return rest;
}

TEST_P(CurvatureStepBy, IsZeroWhereNeighboursDoNotTell) {
  if (!backend_) return;
  std::vector<Eigen::Vector3d> few, line, nowhere, three, steep, round;
  for (int i = 1; i <= 8; ++i) {
    const double x = i - 4.5;
    if (i <= 4) few.emplace_back(std::cos(i), std::sin(i), -1);
    line.emplace_back(x, 2 * x, -x * x);
    nowhere.emplace_back(0, 0, 0);
    three.emplace_back(std::cos(2.1 * (i % 3)), std::sin(2.1 * (i % 3)), -1);
    steep.emplace_back(0, 0, x);
    round.emplace_back(std::cos(i), std::sin(i), -0.1 * std::cos(2 * i));
  }
  for (const auto& places : {few, line, nowhere, three, steep, {}}) {
    EXPECT_EQ(fitted(*backend_, stage(places)), Curvatures::Zero(static_cast<Index>(places.size()) + 1, 2));
  }
  Rest rest = stage(round);
  EXPECT_GT(fitted(*backend_, rest)(0, 0), 0.1);
  rest.normals.setZero();
  EXPECT_EQ(fitted(*backend_, rest), Curvatures::Zero(9, 2)) << "no normal";
}

TEST_P(CurvatureStepBy, TakesTheFlattestWhereOneCoefficientIsOpen) {
  if (!backend_) return;
  // Two lines of neighbours across a parabola: nothing tells how it goes along.
  std::vector<Eigen::Vector3d> tube;
  for (int i = 0; i < 10; ++i) {
    const double x = 0.1 * (i / 2 - 2), y = i % 2 == 0 ? -0.7 : 0.7;
    tube.emplace_back(x, y, -0.5 * x * x);
  }
  const Curvatures found = fitted(*backend_, stage(tube));
  EXPECT_NEAR(found(0, 0), 1, 1e3 * GetParam().tolerance);
  EXPECT_NEAR(found(0, 1), 0, 1e3 * GetParam().tolerance);
}

TEST_P(CurvatureStepBy, ManyVertices) {
  if (!backend_) return;
  const Mesh mesh = test::torus(1, 0.4, 1000, 1000);
  const Rest rest = two_rings(mesh);
  const Curvatures found = fitted(*backend_, rest);
  ASSERT_EQ(found.rows(), 1'000'000);
  const double error = largest_error(rest, found, 0, [](const Eigen::RowVector3d& at) {
    const double distance = std::hypot(at.x(), at.y());
    return Eigen::RowVector2d(1 / 0.4, (distance - 1) / 0.4 / distance);
  });
  EXPECT_LT(error, 0.01);
}

TEST_P(CurvatureStepBy, GivesTheSameBytesAgain) {
  if (!backend_) return;
  for (const auto& [name, rest] : families()) {
    const auto step = backend_->curvature(rest);
    Curvatures first, second;
    step->fit(first);
    step->fit(second);
    EXPECT_EQ(first, second) << name;
    EXPECT_EQ(first, fitted(*backend_, rest)) << name;
  }
}

TEST_P(CurvatureStepBy, TwoStepsOnTwoThreads) {
  if (!backend_) return;
  const Rest rests[] = {two_rings(test::torus()), two_rings(test::sphere(1, 3))};
  const Curvatures expected[] = {fitted(*backend_, rests[0]), fitted(*backend_, rests[1])};
  auto repeat = [&](size_t which) {
    const auto step = backend_->curvature(rests[which]);
    Curvatures found;
    for (int i = 0; i < 20; ++i) {
      step->fit(found);
      EXPECT_EQ(found, expected[which]);
    }
  };
  std::thread other(repeat, 1);
  repeat(0);
  other.join();
}

TEST_P(CurvatureStepBy, NoVertexSeesHowManyNeighboursOthersHave) {
  if (!backend_) return;
  Rest rest = two_rings(test::torus());
  const int hub = 5, spokes = 3000, count = static_cast<int>(rest.positions.rows());
  std::vector<int> far;
  for (int k = 0; k < spokes; ++k) far.push_back(hub + 1 + k % (count - 1 - hub));
  rest.neighbours.insert(rest.neighbours.begin() + rest.offsets[hub], far.begin(), far.end());
  for (int v = hub + 1; v <= count; ++v) rest.offsets[static_cast<size_t>(v)] += spokes;
  const Rest gaps = with_gaps(rest);
  const Curvatures all = fitted(*backend_, rest), some = fitted(*backend_, gaps);
  EXPECT_TRUE(all.allFinite());
  for (Index v = 0; v < count; ++v) {
    const auto at = static_cast<size_t>(v);
    if (gaps.offsets[at] == gaps.offsets[at + 1]) continue;
    EXPECT_EQ(some.row(v), all.row(v)) << "vertex " << v;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, CurvatureStepBy, testing::ValuesIn(kWho),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace swage

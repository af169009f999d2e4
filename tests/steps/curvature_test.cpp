// Curvatures against closed forms and published files.
#include "swage/curvature.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "places.h"
#include "shapes.h"
#include "swage/backend.h"

namespace swage {
namespace {

Curvatures curvature_of(const Mesh& mesh, const CurvatureOptions& options = {}) {
  return curvature(mesh.positions, mesh.triangles, options);
}

Eigen::RowVector3d centre(const Mesh& mesh, Eigen::Index t) {
  return (mesh.positions.row(mesh.triangles(t, 0)) + mesh.positions.row(mesh.triangles(t, 1)) +
          mesh.positions.row(mesh.triangles(t, 2))) /
         3;
}

/// Largest difference from a closed form of the triangle's centre.
double largest_error(const Mesh& mesh, const Curvatures& found,
                     const std::function<Eigen::RowVector2d(const Eigen::RowVector3d&)>& expected) {
  double largest = 0;
  for (Eigen::Index t = 0; t < found.rows(); ++t) {
    largest = std::max(largest, (found.row(t) - expected(centre(mesh, t))).cwiseAbs().maxCoeff());
  }
  return found.allFinite() ? largest : std::numeric_limits<double>::infinity();
}

double relative_difference(const Curvatures& a, const Curvatures& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

Mesh mesh_of(const std::vector<Eigen::RowVector3d>& positions, const std::vector<Eigen::RowVector3i>& triangles) {
  Mesh mesh{Positions(positions.size(), 3), Triangles(triangles.size(), 3)};
  for (size_t i = 0; i < positions.size(); ++i) mesh.positions.row(static_cast<Eigen::Index>(i)) = positions[i];
  for (size_t i = 0; i < triangles.size(); ++i) mesh.triangles.row(static_cast<Eigen::Index>(i)) = triangles[i];
  return mesh;
}

double sphere_error(const Mesh& mesh, double curvature) {
  return largest_error(mesh, curvature_of(mesh),
                       [&](const Eigen::RowVector3d&) { return Eigen::RowVector2d(curvature, curvature); }) /
         std::abs(curvature);
}

/// Of a cylinder along y from 0 to `height`: in units of its curvature.
double tube_error(const Mesh& mesh, double radius, double height) {
  return radius * largest_error(mesh, curvature_of(mesh), [&](const Eigen::RowVector3d& at) {
           const bool cap = at.y() < 1e-4 * height || at.y() > (1 - 1e-4) * height;
           return Eigen::RowVector2d(cap ? 0 : 1 / radius, 0);
         });
}

double torus_error(double major, double minor, int segments) {
  const Mesh mesh = test::torus(major, minor, 2 * segments, segments);
  return minor * largest_error(mesh, curvature_of(mesh), [&](const Eigen::RowVector3d& at) {
           const double distance = std::hypot(at.x(), at.y());
           const double cosine = (distance - major) / std::hypot(distance - major, at.z());
           return Eigen::RowVector2d(1 / minor, cosine / (major + minor * cosine));
         });
}

// Three rings of 32 segments see a third of a circle, where no parabola comes nearer to its curvature than 8 %. Half
// the edge length leaves a quarter of the error.
TEST(Curvature, OfASphereIsOneOverItsRadius) {
  const double radius = 2.5;
  const double coarse = sphere_error(test::sphere(radius, 3), 1 / radius);
  const double fine = sphere_error(test::sphere(radius, 4), 1 / radius);
  EXPECT_LT(fine, 0.02);
  EXPECT_LT(fine, coarse / 3);
}

TEST(Curvature, ChangesSignWithTheWinding) {
  Mesh mesh = test::sphere(2, 4);
  mesh.triangles.col(0).swap(mesh.triangles.col(1));
  EXPECT_LT(sphere_error(mesh, -0.5), 0.02);
}

TEST(Curvature, OfACylinderIsOneOverItsRadiusAndZeroOnTheCaps) {
  const double coarse = tube_error(test::cylinder(0.5, 1.2, 32, 10), 0.5, 1.2);
  const double fine = tube_error(test::cylinder(0.5, 1.2, 64, 20), 0.5, 1.2);
  EXPECT_LT(fine, 0.03);
  EXPECT_LT(fine, coarse / 3);
}

TEST(Curvature, OfATriangleIsThatOfItsVerticesOffTheCuts) {
  // The lowest triangles have one or two corners on the rim, which see only one side, and the rest on one circle.
  const Mesh mesh = test::cylinder(0.5, 1, 32, 10);
  const Curvatures found = curvature_of(mesh);
  double lowest = 10, highest = 0;
  for (Eigen::Index t = 0; t < found.rows(); ++t) {
    const double y = centre(mesh, t).y();
    if (y < 1e-9 || y > 0.1) continue;
    lowest = std::min(lowest, found(t, 0));
    highest = std::max(highest, found(t, 0));
  }
  EXPECT_NEAR(lowest, highest, 1e-9);
  EXPECT_GT(lowest, 2);
}

TEST(Curvature, OfATubeWithoutRingsIsThatOfTheTube) {
  // All vertices stand at one end or the other: what is between can't be told from them, and is taken as straight.
  EXPECT_LT(tube_error(test::cylinder(0.5, 1, 64, 1), 0.5, 1), 0.03);
  EXPECT_LT(tube_error(test::cylinder(0.02, 1, 64, 1), 0.02, 1), 0.03);
}

TEST(Curvature, OfATubeWithoutRingsStandsTheRoundingOfATextFile) {
  Mesh mesh = test::cylinder(0.5, 1, 64, 1);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> rounding(-5e-6, 5e-6);
  for (double& x : mesh.positions.reshaped()) x += rounding(random);
  EXPECT_LT(tube_error(mesh, 0.5, 1), 0.03);
}

TEST(Curvature, OfATorusFollowsItsClosedForm) {
  const double coarse = torus_error(1, 0.4, 32), fine = torus_error(1, 0.4, 64);
  EXPECT_LT(fine, 0.03);
  EXPECT_LT(fine, coarse / 3);
}

TEST(Curvature, OfFlatPartsIsZero) {
  auto flat = [](const Eigen::RowVector3d&) { return Eigen::RowVector2d(0, 0); };
  Mesh tilted = test::sheet(8);
  tilted.positions *= Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix().transpose();
  for (const Mesh& mesh : {test::sheet(8), test::sheet(1), tilted, test::box({1, 2, 3}, 4), test::box({1, 1, 1}, 1)}) {
    EXPECT_LT(largest_error(mesh, curvature_of(mesh), flat), 1e-11);
  }
}

TEST(Curvature, CutsOnlyAtEdgesBelowTheCreaseAngle) {
  const double pi = std::acos(-1.0);
  const Mesh box = test::box({1, 1, 1}, 4);
  EXPECT_GT(curvature_of(box, {.crease_angle = 0.49 * pi}).cwiseAbs().maxCoeff(), 1);
  EXPECT_LT(curvature_of(box, {.crease_angle = 0.51 * pi}).cwiseAbs().maxCoeff(), 1e-11);
  // The same edges from inside are creases too.
  Mesh room = box;
  room.triangles.col(0).swap(room.triangles.col(1));
  EXPECT_LT(curvature_of(room).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(Curvature, LeavesOutNeighboursThatFaceAway) {
  // Three rings reach all that faces one way on a ball of 42 vertices, and further ones its other side.
  const Mesh ball = test::sphere(1, 1);
  const Curvatures found = curvature_of(ball, {.rings = 3});
  EXPECT_LT((found.array() - 1).abs().maxCoeff(), 0.5);
  EXPECT_LT(relative_difference(curvature_of(ball, {.rings = 6}), found), 1e-9);
}

/// One vertex at a place in space, and neighbours at these places beside it, seen along a normal that leans.
struct Stage {
  Eigen::Matrix3d frame = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();

  Eigen::RowVector2d fit(const std::vector<Eigen::Vector3d>& places) const {
    CurvatureStep::Rest rest;
    const auto count = static_cast<Eigen::Index>(places.size()) + 1;
    rest.positions = Eigen::RowVector3d(4, 5, 6).replicate(count, 1);
    rest.normals = frame.col(2).transpose().replicate(count, 1);
    rest.offsets.assign(static_cast<size_t>(count) + 1, static_cast<int>(count) - 1);
    rest.offsets[0] = 0;
    for (int i = 1; i < count; ++i) {
      rest.positions.row(i) += (frame * places[static_cast<size_t>(i) - 1]).transpose();
      rest.neighbours.push_back(i);
    }
    Curvatures found;
    cpu_backend()->curvature(rest)->fit(found);
    EXPECT_EQ(found.rows(), count);
    EXPECT_TRUE(found.bottomRows(count - 1).isZero(0)) << "those have no neighbours";
    return found.row(0);
  }
};

TEST(CurvatureStep, RecoversAQuadricThroughItsNeighbours) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const double a = number(random), b = number(random), c = number(random), d = number(random), e = number(random);
    std::vector<Eigen::Vector3d> places;
    for (int i = 0; i < 5 + trial % 30; ++i) {
      const double angle = 2.4 * i, x = std::sqrt(i + 1.0) / 3 * std::cos(angle),
                   y = 0.1 * std::sqrt(i + 1.0) / 3 * std::sin(angle);
      places.emplace_back(x, y, a * x * x + b * x * y + c * y * y + d * x + e * y);
    }
    // Gaussian and mean curvature of a graph, its normal up.
    const double slope = 1 + d * d + e * e;
    const double gauss = (4 * a * c - b * b) / (slope * slope);
    const double mean = -((1 + e * e) * 2 * a - 2 * d * e * b + (1 + d * d) * 2 * c) / (2 * std::pow(slope, 1.5));
    const Eigen::RowVector2d found = Stage().fit(places);
    EXPECT_GE(found[0], found[1]);
    EXPECT_NEAR(found[0] + found[1], 2 * mean, 1e-9) << "trial " << trial;
    EXPECT_NEAR(found[0] * found[1], gauss, 1e-9) << "trial " << trial;
  }
}

TEST(CurvatureStep, IsZeroWhereNeighboursDoNotTell) {
  std::vector<Eigen::Vector3d> few, line, nowhere, three, steep;
  for (int i = 1; i <= 8; ++i) {
    const double x = i - 4.5;
    if (i <= 4) few.emplace_back(std::cos(i), std::sin(i), -1);
    line.emplace_back(x, 2 * x, -x * x);
    nowhere.emplace_back(0, 0, 0);
    three.emplace_back(std::cos(2.1 * (i % 3)), std::sin(2.1 * (i % 3)), -1);
    steep.emplace_back(0, 0, x);
  }
  for (const auto& places : {few, line, nowhere, three, steep, {}}) {
    EXPECT_EQ(Stage().fit(places), Eigen::RowVector2d::Zero()) << places.size() << " neighbours";
  }
}

Mesh read_triangles(const std::filesystem::path& path) {
  std::vector<Eigen::RowVector3d> positions;
  std::vector<Eigen::RowVector3i> triangles;
  std::ifstream in(path);
  for (std::string line, word; std::getline(in, line);) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      Eigen::RowVector3d p;
      words >> p[0] >> p[1] >> p[2];
      positions.push_back(p);
    } else if (word == "f") {
      Eigen::RowVector3i f;
      for (int& v : f) {
        words >> word;
        v = std::stoi(word) - 1;
      }
      triangles.push_back(f);
    }
  }
  return mesh_of(positions, triangles);
}

Curvatures read_numbers(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<double> numbers;
  for (double number; in >> number;) numbers.push_back(number);
  return Eigen::Map<const Curvatures>(numbers.data(), static_cast<Eigen::Index>(numbers.size() / 2), 2);
}

/// Part of the triangles whose two curvatures are within 1 % of the larger one of those published.
double agreement(const std::string& model) {
  const std::filesystem::path folder = test::shared("oracle/reshape") / model;
  Mesh mesh = read_triangles(folder / (model + ".obj"));
  const Curvatures published = read_numbers(folder / (model + ".fk"));
  mesh.positions /= (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).maxCoeff();
  const Curvatures found = curvature_of(mesh);
  EXPECT_EQ(found.rows(), published.rows());
  Eigen::Index within = 0;
  for (Eigen::Index t = 0; t < published.rows(); ++t) {
    const double size = std::max(published.row(t).cwiseAbs().maxCoeff(), 1e-4);
    within += (found.row(t) - published.row(t)).cwiseAbs().maxCoeff() <= 0.01 * size ? 1 : 0;
  }
  std::cout << model << ": " << within << " of " << published.rows() << " within 1 %\n";
  return static_cast<double>(within) / static_cast<double>(published.rows());
}

TEST(CurvatureFiles, OfTheCylinderAndTheCarAreMatched) {
  if (!test::has_shared()) GTEST_SKIP() << "no reference files";
  EXPECT_GE(agreement("cylinder_1kF"), 0.99);
  EXPECT_GE(agreement("e_car_extruded"), 0.99);
}

}  // namespace
}  // namespace swage

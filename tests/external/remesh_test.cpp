#include "swage/remesh.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "adjacency.h"
#include "distinct.h"
#include "measures.h"
#include "places.h"
#include "remesher.h"
#include "shape_quality.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage {
namespace {

using test::kDegree;
using testing::HasSubstr;

class Remesh : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_cgal()) GTEST_SKIP() << "built without CGAL";
  }
};

Mesh remesh(const Mesh& mesh, const RemeshOptions& options = {}) {
  return remesh(mesh.positions, mesh.triangles, options);
}

double area(const Mesh& mesh) { return area_vectors(mesh.positions, mesh.triangles).rowwise().norm().sum() / 2; }

Mesh welded(const Mesh& mesh) {
  const Distinct result = distinct(mesh.positions, mesh.triangles);
  return {mesh.positions(result.vertices, Eigen::all), result.triangles};
}

/// Sum of the lengths of edges of so many triangles.
double length_of_edges(const Mesh& mesh, int triangles) {
  const Edges edges = edges_of(mesh.triangles);
  const Eigen::VectorXd lengths = edge_vectors(mesh.positions, edges).rowwise().norm();
  double sum = 0;
  for (int e = 0; e < edges.triangles.size(); ++e) sum += edges.triangles[e].size() == triangles ? lengths[e] : 0;
  return sum;
}

bool is_closed(const Mesh& mesh) {
  const Edges edges = edges_of(mesh.triangles);
  for (int e = 0; e < edges.triangles.size(); ++e) {
    if (edges.triangles[e].size() != 2) return false;
  }
  return true;
}

double distance_to_vertices(const Mesh& mesh, const Eigen::RowVector3d& point) {
  return (mesh.positions.rowwise() - point).rowwise().norm().minCoeff();
}

double distance_to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + along * (b - a) - p).norm();
}

double distance_to_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const bool above =
      normal.cross(b - a).dot(p - a) >= 0 && normal.cross(c - b).dot(p - b) >= 0 && normal.cross(a - c).dot(p - c) >= 0;
  if (above) return std::abs(normal.normalized().dot(p - a));
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

double distance_to_surface(const Mesh& mesh, const Eigen::Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles.rowwise()) {
    least = std::min(
        least, distance_to_triangle(p, mesh.positions.row(t[0]), mesh.positions.row(t[1]), mesh.positions.row(t[2])));
  }
  return least;
}

/// Largest distance from points all over one surface to the other.
double farthest(const Mesh& from, const Mesh& to) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  const Eigen::VectorXd areas = area_vectors(from.positions, from.triangles).rowwise().norm();
  std::discrete_distribution<int> triangle(areas.begin(), areas.end());
  double most = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::RowVector3i t = from.triangles.row(triangle(random));
    double u = uniform(random), v = uniform(random);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Eigen::RowVector3d p =
        (1 - u - v) * from.positions.row(t[0]) + u * from.positions.row(t[1]) + v * from.positions.row(t[2]);
    most = std::max(most, distance_to_surface(to, p));
  }
  return most;
}

void expect_well_shaped(const Mesh& mesh) {
  const ShapeQuality quality = shape_quality(mesh.positions, mesh.triangles);
  EXPECT_GT(quality.low_angle, 25 * kDegree);
  EXPECT_LT(quality.sharp_area, 0.002);
  EXPECT_FALSE(badly_shaped(quality));
}

void expect_same_surface(const Mesh& mesh, const Mesh& original) {
  EXPECT_NEAR(area(mesh), area(original), 0.01 * area(original));
  const double edge = mean_edge_length(mesh.positions, mesh.triangles);
  EXPECT_LT(farthest(mesh, original), 0.2 * edge);
  EXPECT_LT(farthest(original, mesh), 0.2 * edge);
}

const RemeshOptions kCoarse{.triangles = 3000};

TEST_F(Remesh, NeedlesOfACylinderBecomeWellShaped) {
  const Mesh needles = test::cylinder(0.5, 4, 64, 1);
  ASSERT_TRUE(badly_shaped(shape_quality(needles.positions, needles.triangles)));
  const Mesh mesh = remesh(needles, kCoarse);
  expect_well_shaped(mesh);
  expect_same_surface(mesh, needles);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(test::volume(mesh), test::volume(needles), 0.01 * test::volume(needles));
  EXPECT_NEAR(static_cast<double>(mesh.triangles.rows()), 3000, 1000);
}

TEST_F(Remesh, TwelveTrianglesOfABoxKeepItsCornersAndFaces) {
  const Mesh box = test::box({3, 1, 0.5}, 1);
  const Mesh mesh = remesh(box, kCoarse);
  expect_well_shaped(mesh);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(area(mesh), area(box), 1e-9);
  EXPECT_NEAR(test::volume(mesh), 1.5, 1e-9);
  for (const auto& corner : box.positions.rowwise()) EXPECT_LT(distance_to_vertices(mesh, corner), 1e-9);
  for (double along = 0; along <= 3; along += 0.01) {
    EXPECT_LT(distance_to_vertices(mesh, {along, 1, 0.5}), 0.05);
  }
}

TEST_F(Remesh, IsTheSameOfAnyOrder) {
  const Mesh mesh = test::cylinder(0.5, 4, 64, 1);
  Mesh other{mesh.positions.colwise().reverse(), mesh.triangles.colwise().reverse()};
  other.triangles = (static_cast<int>(mesh.positions.rows()) - 1 - other.triangles.array()).matrix();
  const Mesh one = remesh(mesh, kCoarse), two = remesh(other, kCoarse);
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.triangles, two.triangles);
}

TEST_F(Remesh, EdgeLengthIsTheOneAskedFor) {
  const Mesh box = test::box({1, 1, 1}, 1);
  for (const double length : {0.2, 0.1, 0.05}) {
    const Mesh mesh = remesh(box, {.edge_length = length});
    EXPECT_NEAR(mean_edge_length(mesh.positions, mesh.triangles), length, 0.15 * length);
  }
}

TEST_F(Remesh, ThinPlatesGetFinerEdgesAtTheirRims) {
  const Mesh plate = test::box({1, 1, 0.01}, 1);
  const Mesh mesh = remesh(plate, kCoarse);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(test::volume(mesh), 0.01, 1e-9);
  expect_well_shaped(mesh);
  EXPECT_LE(mesh.triangles.rows(), 3 * 3000);
}

/// A box cut in two by a sheet.
Mesh box_with_wall(double height) {
  const Mesh sheet = test::sheet(2);
  Positions wall(sheet.positions.rows(), 3);
  wall << Eigen::VectorXd::Constant(wall.rows(), 0.5), sheet.positions.col(0), height * sheet.positions.col(1);
  return test::joined(test::box({1, 1, height}, 2), {wall, sheet.triangles});
}

TEST_F(Remesh, AnInnerWallStaysJoined) {
  // Of the lower box the rims, and with them the wall, get finer edges than the rest.
  for (const double height : {1.0, 0.05}) {
    const Mesh box = box_with_wall(height);
    ASSERT_NEAR(length_of_edges(welded(box), 3), 2 + 2 * height, 1e-12);
    const Mesh mesh = remesh(box, kCoarse);
    EXPECT_NEAR(length_of_edges(mesh, 3), 2 + 2 * height, 1e-9);
    EXPECT_EQ(length_of_edges(mesh, 1), 0);
    EXPECT_NEAR(area(mesh), area(box), 1e-9);
    expect_well_shaped(mesh);
  }
}

TEST_F(Remesh, AnOpenSheetKeepsItsOutline) {
  const Mesh mesh = remesh(test::sheet(1), kCoarse);
  EXPECT_NEAR(length_of_edges(mesh, 1), 4, 1e-9);
  EXPECT_NEAR(area(mesh), 1, 1e-9);
  EXPECT_GT(unit_normals(mesh.positions, mesh.triangles).col(2).minCoeff(), 0.999);
  expect_well_shaped(mesh);
}

TEST_F(Remesh, FacesTwiceAndVerticesApartCountOnce) {
  const Mesh box = test::box({1, 1, 1}, 1);
  const Mesh once = remesh(box, kCoarse);
  Positions apart(box.triangles.size(), 3);
  Triangles own(box.triangles.rows(), 3);
  for (int corner = 0; corner < own.size(); ++corner) {
    own(corner / 3, corner % 3) = corner;
    apart.row(corner) = box.positions.row(box.triangles(corner / 3, corner % 3));
  }
  const Mesh again = remesh(test::joined({apart, own}, box), kCoarse);
  EXPECT_TRUE(is_closed(again));
  EXPECT_NEAR(area(again), area(once), 1e-9);
  EXPECT_NEAR(test::volume(again), 1, 1e-9);
}

TEST_F(Remesh, FlatTrianglesLeaveNoCracks) {
  // The middle of a side of one triangle is a corner of a triangle without area, and of two beyond it.
  Mesh mesh{Positions(5, 3), Triangles(4, 3)};
  mesh.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0, 0, 0.5, -1, 0;
  mesh.triangles << 0, 1, 2, 0, 3, 1, 0, 4, 3, 3, 4, 1;
  const Mesh result = remesh(mesh, kCoarse);
  EXPECT_NEAR(area(result), 1, 1e-9);
  EXPECT_NEAR(length_of_edges(result, 1), 1 + std::sqrt(2.0) + 2 * std::sqrt(1.25), 1e-9);
}

TEST_F(Remesh, WindsAsMostOfTheArea) {
  Mesh box = test::box({1, 1, 1}, 2);
  for (const Eigen::Index t : {0, 7, 20}) std::swap(box.triangles(t, 0), box.triangles(t, 1));
  EXPECT_NEAR(test::volume(remesh(box, kCoarse)), 1, 1e-9);
  Mesh inside_out = test::box({1, 1, 1}, 2);
  inside_out.triangles.col(0).swap(inside_out.triangles.col(1));
  EXPECT_NEAR(test::volume(remesh(inside_out, kCoarse)), -1, 1e-9);
}

TEST_F(Remesh, SameBytesAgainAndAtAnotherSize) {
  const Mesh shape = test::joined(test::cylinder(0.5, 4, 64, 1), test::transformed(test::box(), 1, {2, 0, 0}));
  const Mesh one = remesh(shape, kCoarse), other = remesh(shape, kCoarse);
  EXPECT_EQ(one.positions, other.positions);
  EXPECT_EQ(one.triangles, other.triangles);
  for (const double scale : {std::ldexp(1, -200), std::ldexp(1, 30)}) {
    const Mesh scaled = remesh(test::transformed(shape, scale, {0, 0, 0}), kCoarse);
    EXPECT_EQ(scaled.positions, scale * one.positions);
  }
}

/// Solid angle over 4 pi of the surface seen from the point (Van Oosterom, Strackee 1983): 1 inside, 0 outside.
double winding_number(const Mesh& mesh, const Eigen::Vector3d& p) {
  double sum = 0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::Vector3d a = mesh.positions.row(t[0]).transpose() - p, b = mesh.positions.row(t[1]).transpose() - p,
                          c = mesh.positions.row(t[2]).transpose() - p;
    const double below =
        a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + b.dot(c) * a.norm() + c.dot(a) * b.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), below);
  }
  return sum / (4 * std::numbers::pi);
}

Mesh random_soup(int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Mesh soup{Positions(3 * count, 3), Triangles(count, 3)};
  for (double& x : soup.positions.reshaped()) x = uniform(random);
  for (int corner = 0; corner < 3 * count; ++corner) soup.triangles(corner / 3, corner % 3) = corner;
  return soup;
}

TEST_F(Remesh, WrapEnclosesASoup) {
  const Mesh soup = random_soup(30);
  RemeshOptions options = kCoarse;
  options.wrap = true;
  const Mesh mesh = remesh(soup, options);
  EXPECT_TRUE(is_closed(mesh));
  for (const auto& t : soup.triangles.rowwise()) {
    const Eigen::Vector3d middle = soup.positions(t, Eigen::all).colwise().mean();
    EXPECT_NEAR(winding_number(mesh, middle), 1, 0.01);
  }
  EXPECT_GT(test::volume(mesh), 0);
}

template <class Error>
std::string message_of(const Mesh& mesh, const RemeshOptions& options = {}) {
  try {
    remesh(mesh, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(Remesh, EndsAtTheTimeLimit) {
  EXPECT_THAT(message_of<Unsolvable>(test::sphere(1, 5), {.triangles = 300'000, .time_limit = 0.05}),
              HasSubstr("swage-remesh did not end within"));
}

TEST_F(Remesh, CancelledIsEmpty) {
  const Mesh mesh = test::sphere(1, 4);
  const Mesh result = swage::remesh(mesh.positions, mesh.triangles, {}, [](const Progress&) { return false; });
  EXPECT_EQ(result.positions.rows(), 0);
  EXPECT_EQ(result.triangles.rows(), 0);
}

TEST_F(Remesh, RefusesWhatIsNoMeshAndOptionsOutOfRange) {
  const Mesh box = test::box();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message_of<InvalidInput>({Positions::Zero(3, 3), Triangles{{0, 1, 2}}}), HasSubstr("has an area"));
  EXPECT_THAT(message_of<InvalidInput>({box.positions, Triangles{{0, 1, 999}}}), HasSubstr("999"));
  EXPECT_THAT(message_of<InvalidInput>(box, {.edge_length = -1}), HasSubstr("edge_length"));
  EXPECT_THAT(message_of<InvalidInput>(box, {.edge_length = 1e-9}), HasSubstr("edge_length"));
  EXPECT_THAT(message_of<InvalidInput>(box, {.edge_length = nan}), HasSubstr("edge_length"));
  EXPECT_THAT(message_of<InvalidInput>(box, {.triangles = 1}), HasSubstr("triangles"));
  EXPECT_THAT(message_of<InvalidInput>(box, {.feature_angle = 0}), HasSubstr("feature_angle"));
  EXPECT_THAT(message_of<InvalidInput>(box, {.iterations = 0}), HasSubstr("iterations"));
  EXPECT_THAT(message_of<InvalidInput>(box, {.wrap_alpha = 0}), HasSubstr("wrap_alpha"));
  EXPECT_THAT(message_of<InvalidInput>(box, {.time_limit = 0}), HasSubstr("time_limit"));
}

TEST_F(Remesh, RealNeedlesBecomeWellShaped) {
  if (!test::has_shared()) GTEST_SKIP() << "no real meshes here";
  for (const char* name : {"anchor.off", "rotor.off", "pipe.off", "plate_holes.STL", "round.stl"}) {
    SCOPED_TRACE(name);
    const Mesh model = read_mesh(test::shared("data/meshes/E_bad_shape") / name).mesh;
    const Mesh mesh = remesh(model);
    expect_well_shaped(mesh);
    expect_same_surface(mesh, model);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(test::volume(mesh), test::volume(model), 0.01 * test::volume(model));
  }
}

TEST(RemeshWithoutCgal, IsUnavailable) {
  if (has_cgal()) GTEST_SKIP() << "built with CGAL";
  EXPECT_THAT(message_of<Unavailable>(test::sheet(2)), HasSubstr("SWAGE_CGAL"));
}

}  // namespace
}  // namespace swage

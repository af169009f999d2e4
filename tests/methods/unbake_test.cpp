// Relief from normal maps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "measures.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/style_io.h"
#include "swage/stylize.h"

namespace swage::test {
namespace {

using Eigen::RowVector2d;
using Eigen::RowVector3d;
using Eigen::Vector3d;
using testing::HasSubstr;

/// Of pixels whose normals are normal(u, v).
template <typename Normal>
NormalPicture map_of(int size, const Normal& normal) {
  NormalPicture picture{size, size, {}};
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vector3d n = normal((x + 0.5) / size, 1 - (y + 0.5) / size);
      for (int k = 0; k < 3; ++k) picture.normals.push_back(static_cast<float>(n[k]));
    }
  }
  return picture;
}

NormalPicture constant(const Vector3d& normal) {
  return map_of(4, [&](double, double) { return normal; });
}

/// A point a vertex, where place(position) says.
template <typename Place>
TextureCoordinates texture_of(const Mesh& mesh, const Place& place) {
  TextureCoordinates texture{{}, mesh.triangles};
  texture.points.resize(mesh.positions.rows(), 2);
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) texture.points.row(v) = place(mesh.positions.row(v));
  return texture;
}

RowVector2d in_plane(const RowVector3d& p) { return {p[0], p[1]}; }

double farthest(const Positions& normals, const Vector3d& due) {
  return (normals.rowwise() - due.transpose()).rowwise().norm().maxCoeff();
}

const Vector3d kRed(0.6, 0, 0.8), kGreen(0, 0.6, 0.8);

TEST(Unbaked, AStraightMapAsksForNothing) {
  const Mesh mesh = sphere(1, 2);
  // Torn and stretched, mirrored on one side.
  const TextureCoordinates texture =
      texture_of(mesh, [](const RowVector3d& p) { return RowVector2d(p[0] * p[1] + 2 * p[0], p[2]); });
  const GivenNormals targets = unbaked(mesh, texture, constant(Vector3d::UnitZ()));
  EXPECT_TRUE(targets.of_triangles);
  EXPECT_LT((targets.normals - unit_normals(mesh.positions, mesh.triangles)).cwiseAbs().maxCoeff(), 1e-12);
  const Positions still = stylize(mesh.positions, mesh.triangles, targets, 10).positions;
  EXPECT_LT((still - mesh.positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Unbaked, RedIsAlongUAndGreenAlongV) {
  const Mesh mesh = sheet(4);
  const auto turned = [](const RowVector3d& p) { return RowVector2d(p[1], -p[0]); };
  const auto mirrored = [](const RowVector3d& p) { return RowVector2d(-p[0], p[1]); };
  const auto targets = [&](auto place, const Vector3d& normal, const NormalMapOptions& options = {}) {
    return unbaked(mesh, texture_of(mesh, place), constant(normal), options).normals;
  };
  EXPECT_LT(farthest(targets(in_plane, kRed), {0.6, 0, 0.8}), 1e-6);
  EXPECT_LT(farthest(targets(in_plane, kGreen), {0, 0.6, 0.8}), 1e-6);
  EXPECT_LT(farthest(targets(turned, kRed), {0, 0.6, 0.8}), 1e-6);
  EXPECT_LT(farthest(targets(turned, kGreen), {-0.6, 0, 0.8}), 1e-6);
  EXPECT_LT(farthest(targets(mirrored, kRed), {-0.6, 0, 0.8}), 1e-6);
  EXPECT_LT(farthest(targets(mirrored, kGreen), {0, 0.6, 0.8}), 1e-6);
  NormalMapOptions down;
  down.green_down = true;
  EXPECT_LT(farthest(targets(in_plane, kGreen, down), {0, -0.6, 0.8}), 1e-6);
  EXPECT_LT(farthest(targets(mirrored, kGreen, down), {0, -0.6, 0.8}), 1e-6);
  EXPECT_LT(farthest(targets(mirrored, kRed, down), {-0.6, 0, 0.8}), 1e-6);
}

TEST(Unbaked, ObjectSpaceIsTheMeshsOwn) {
  const Mesh mesh = sphere(1, 1);
  NormalMapOptions options;
  options.space = NormalSpace::object;
  const TextureCoordinates texture = texture_of(mesh, [](const RowVector3d&) { return RowVector2d(0.5, 0.5); });
  const Vector3d normal(-0.48, 0.6, -0.64);
  EXPECT_LT(farthest(unbaked(mesh, texture, constant(normal), options).normals, normal), 1e-6);
}

TEST(Unbaked, IsTheMeanOverATriangle) {
  const Mesh mesh = sheet(2);
  // Stripes, two a triangle: they cancel.
  const NormalPicture stripes =
      map_of(64, [](double u, double) { return Vector3d(std::fmod(u, 1.0 / 8) < 1.0 / 16 ? 0.6 : -0.6, 0, 0.8); });
  EXPECT_LT(farthest(unbaked(mesh, texture_of(mesh, in_plane), stripes).normals, Vector3d::UnitZ()), 0.12);
  // One half red, the other green: the triangles of each are of it.
  const NormalPicture halves = map_of(64, [](double, double v) { return v < 0.5 ? kRed : kGreen; });
  const Positions normals = unbaked(mesh, texture_of(mesh, in_plane), halves).normals;
  for (Eigen::Index t = 0; t < normals.rows(); ++t) {
    double middle = 0;
    for (const int v : mesh.triangles.row(t)) middle += mesh.positions(v, 1) / 3;
    const bool is_low = middle < 0.5;
    EXPECT_LT((normals.row(t).transpose() - (is_low ? kRed : kGreen)).norm(), 0.05) << t;
  }
}

TEST(Unbaked, ThePictureIsThereAgainBeyondIt) {
  const Mesh mesh = sheet(4);
  const NormalPicture halves = map_of(64, [](double u, double) { return u < 0.5 ? kRed : kGreen; });
  const auto beyond = [](const RowVector3d& p) { return RowVector2d(p[0] - 7, p[1] + 3); };
  const Positions here = unbaked(mesh, texture_of(mesh, in_plane), halves).normals;
  EXPECT_LT((here - unbaked(mesh, texture_of(mesh, beyond), halves).normals).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Unbaked, TrianglesWithoutAPlaceKeepTheirNormalAndThoseWithoutColourHaveNone) {
  const Mesh mesh = sheet(2);
  TextureCoordinates texture = texture_of(mesh, in_plane);
  texture.points.conservativeResize(texture.points.rows() + 1, 2);
  texture.points.bottomRows(1) << 0.2, 0.2;
  texture.triangles.row(3).setConstant(static_cast<int>(texture.points.rows() - 1));
  const Positions normals = unbaked(mesh, texture, constant(kRed)).normals;
  EXPECT_LT((normals.row(3) - RowVector3d(0, 0, 1)).norm(), 1e-12);
  EXPECT_LT((normals.row(2) - kRed.transpose()).norm(), 1e-6);
  EXPECT_EQ(unbaked(mesh, texture_of(mesh, in_plane), constant(Vector3d::Zero())).normals, Positions::Zero(8, 3));
}

TEST(Unbaked, IsReliefOnceStylized) {
  const Mesh mesh = sheet(32);
  const auto height = [](double x, double y) { return 0.03 * std::cos(9 * x) * std::cos(9 * y); };
  const NormalPicture bumps = map_of(256, [&](double x, double y) {
    constexpr double kStep = 1e-5;
    return Vector3d((height(x - kStep, y) - height(x + kStep, y)) / (2 * kStep),
                    (height(x, y - kStep) - height(x, y + kStep)) / (2 * kStep), 1)
        .normalized();
  });
  for (const StylizeEnergy energy : {StylizeEnergy::arap, StylizeEnergy::farap}) {
    StylizeOptions options;
    options.energy = energy;
    const Positions relief =
        stylize(mesh.positions, mesh.triangles, unbaked(mesh, texture_of(mesh, in_plane), bumps), 100, options)
            .positions;
    Eigen::VectorXd due(relief.rows());
    for (Eigen::Index v = 0; v < due.size(); ++v) due[v] = height(mesh.positions(v, 0), mesh.positions(v, 1));
    due.array() -= due.mean();
    const Eigen::VectorXd is = relief.col(2).array() - relief.col(2).mean();
    EXPECT_GT(is.dot(due) / (is.norm() * due.norm()), 0.95) << to_string(energy);
    EXPECT_NEAR(is.norm() / due.norm(), 1, 0.15) << to_string(energy);
  }
}

TEST(Unbaked, WhatDoesNotFitIsRefused) {
  const Mesh mesh = sheet(2);
  const TextureCoordinates texture = texture_of(mesh, in_plane);
  const auto refused = [&](const TextureCoordinates& one, const NormalPicture& map) {
    try {
      unbaked(mesh, one, map);
    } catch (const InvalidInput& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  TextureCoordinates fewer = texture, beyond = texture, endless = texture;
  fewer.triangles.conservativeResize(7, 3);
  beyond.triangles(0, 0) = 9;
  endless.points(0, 0) = std::nan("");
  const NormalPicture map = constant(kRed);
  EXPECT_THAT(refused(fewer, map), HasSubstr("7 triangles, but the mesh has 8"));
  EXPECT_THAT(refused(beyond, map), HasSubstr("names none of the 9 points"));
  EXPECT_THAT(refused(endless, map), HasSubstr("not finite"));
  EXPECT_THAT(refused(texture, NormalPicture{2, 2, {1}}), HasSubstr("no normals of 2 x 2"));
}

}  // namespace
}  // namespace swage::test

// Using the deformations that reshaping is compared with: handles, starts, threads, devices, cancelling, bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <cmath>

#include "edit_measures.h"
#include "gestures.h"
#include "opencl_device.h"
#include "refused.h"
#include "shapes.h"
#include "swage/deform.h"
#include "swage/error.h"

namespace swage::test {
namespace {

using testing::HasSubstr;

TEST(DeformUse, MeetsItsHandlesExactlyOrAsSoftlyAsAsked) {
  const Mesh mesh = torus(1, 0.4, 24, 12);
  const Gesture gesture = move_top(mesh, {0.4, 0.4, 0.2});
  DeformOptions options;
  const auto error = [&] {
    return handle_error(mesh, gesture, deform(mesh.positions, mesh.triangles, gesture, options).positions);
  };
  for (const DeformMethod method :
       {DeformMethod::poisson, DeformMethod::arap, DeformMethod::arap_volume, DeformMethod::conformal}) {
    options.method = method;
    options.handle_weight.reset();
    EXPECT_LT(error(), 1e-12) << to_string(method);
    options.handle_weight = 1e4;
    const double firm = error();
    options.handle_weight = 1;
    EXPECT_GT(error(), 10 * firm) << to_string(method);
    EXPECT_GT(firm, 1e-9) << to_string(method);
  }
}

TEST(DeformUse, SolvesAgainWithOrWithoutAStart) {
  const Mesh mesh = cylinder(0.3, 1, 16, 8);
  const Gesture first = uneven(mesh, 0.1, 40), second = uneven(mesh, 0.102, 40);
  for (const DeformMethod method :
       {DeformMethod::poisson, DeformMethod::arap, DeformMethod::arap_volume, DeformMethod::conformal}) {
    DeformOptions options;
    options.method = method;
    options.movement = 1e-8;
    Deform plan(mesh.positions, mesh.triangles, options);
    const DeformResult before = plan.solve(first), cold = plan.solve(second), warm = plan.solve(second, before);
    EXPECT_EQ(cold.positions, deform(mesh.positions, mesh.triangles, second, options).positions) << to_string(method);
    EXPECT_LT(deviation(warm.positions, cold.positions).largest, 1e-6) << to_string(method);
    EXPECT_EQ(plan.solve(first).positions, before.positions);
  }
}

/// At the default tolerance.
TEST(DeformUse, DraggingOnTakesFewerPasses) {
  const Mesh mesh = cylinder(0.3, 1, 16, 8);
  for (const DeformMethod method : {DeformMethod::arap, DeformMethod::arap_volume, DeformMethod::conformal}) {
    DeformOptions options;
    options.method = method;
    Deform plan(mesh.positions, mesh.triangles, options);
    const DeformResult before = plan.solve(uneven(mesh, 0.1, 40));
    const Gesture next = uneven(mesh, 0.102, 40);
    EXPECT_LT(plan.solve(next, before).report.passes, plan.solve(next).report.passes) << to_string(method);
  }
}

TEST(DeformUse, TellsWhatTheMeshIs) {
  const Mesh mesh = awkward();
  const DeformResult result = deform(mesh.positions, mesh.triangles, uneven(mesh, 0.1));
  std::string warnings;
  for (const std::string& warning : result.report.warnings) warnings += warning + "\n";
  for (const char* word : {"more than two triangles", "repeats", "two corners at one place", "no triangle"}) {
    EXPECT_THAT(warnings, HasSubstr(word));
  }
}

TEST(DeformUse, IsTheSameBytesOnOneThreadAndTwo) {
  const Mesh mesh = joined(torus(1, 0.4, 24, 12), transformed(box(), 1, {2, 0, 0}));
  const Gesture gesture = move_top(mesh, {0.4, 0.4, 0.2});
  const int threads = omp_get_max_threads();
  for (const DeformMethod method :
       {DeformMethod::poisson, DeformMethod::arap, DeformMethod::arap_volume, DeformMethod::conformal}) {
    DeformOptions options;
    options.method = method;
    omp_set_num_threads(1);
    const Positions one = deform(mesh.positions, mesh.triangles, gesture, options).positions;
    omp_set_num_threads(2);
    EXPECT_EQ(deform(mesh.positions, mesh.triangles, gesture, options).positions, one) << to_string(method);
  }
  omp_set_num_threads(threads);
}

TEST(DeformUse, OnADeviceIsAsOnTheReference) {
  const Mesh mesh = torus(1, 0.4, 24, 12);
  const Gesture gesture = move_top(mesh, {0.4, 0.4, 0.2});
  for (const Precision precision : {Precision::twice, Precision::single}) {
    const auto backend = opencl_or_skip(precision);
    if (!backend) return;
    for (const DeformMethod method : {DeformMethod::arap, DeformMethod::arap_volume, DeformMethod::conformal}) {
      DeformOptions options;
      options.method = method;
      options.movement = 1e-6;
      const Positions reference = deform(mesh.positions, mesh.triangles, gesture, options).positions;
      options.backend = backend;
      const Positions device = deform(mesh.positions, mesh.triangles, gesture, options).positions;
      EXPECT_LT(deviation(device, reference).largest, 1e-4) << to_string(method);
    }
  }
}

TEST(DeformUse, CanBeCancelled) {
  const Mesh mesh = torus(1, 0.4, 24, 12);
  const Gesture gesture = move_top(mesh, {0.4, 0.4, 0.2});
  for (const DeformMethod method :
       {DeformMethod::poisson, DeformMethod::arap, DeformMethod::arap_volume, DeformMethod::conformal}) {
    DeformOptions options;
    options.method = method;
    Deform plan(mesh.positions, mesh.triangles, options);
    EXPECT_FALSE(plan.prepare([](const Progress&) { return false; }));
    const DeformResult result = plan.solve(gesture, [](const Progress&) { return false; });
    EXPECT_EQ(result.report.stop, Termination::cancelled);
    EXPECT_EQ(result.positions, mesh.positions);
    double last = 0;
    plan.solve(gesture, [&](const Progress& now) {
      EXPECT_GE(now.fraction, last);
      EXPECT_LE(now.fraction, 1);
      last = now.fraction;
      return true;
    });
    EXPECT_GT(last, 0);
  }
}

TEST(DeformUse, RefusesWhatItCannotDo) {
  const Mesh mesh = sheet(2);
  const Gesture gesture = move_top(mesh, {0, 0, 1});
  const auto refused = [&](const auto& set, const char* words) {
    DeformOptions options;
    set(options);
    expect_refused([&] { Deform(mesh.positions, mesh.triangles, options); }, words);
  };
  refused([](auto& o) { o.handle_weight = 0; }, "handle_weight");
  refused([](auto& o) { o.handle_weight = std::nan(""); }, "handle_weight");
  refused([](auto& o) { o.pass_limit = 0; }, "pass_limit");
  refused([](auto& o) { o.movement = 0; }, "movement");
  refused([](auto& o) { o.acceleration_window = -1; }, "acceleration_window");
  refused([](auto& o) { o.filling_time_limit = 0; }, "filling_time_limit");
  Mesh flat = mesh;
  flat.positions.col(0).setZero();
  flat.positions.col(2).setZero();
  expect_refused([&] { Deform(flat.positions, flat.triangles); }, "Deform: triangles: none");
  Deform plan(mesh.positions, mesh.triangles);
  expect_refused([&] { plan.solve({}); }, "handle");
  expect_refused([&] { plan.solve(gesture, DeformResult{Positions::Zero(3, 3), {}}); }, "3 rows");
  DeformResult start{mesh.positions, {}};
  start.positions(1, 1) = std::nan("");
  expect_refused([&] { plan.solve(gesture, start); }, "not finite");
}

}  // namespace
}  // namespace swage::test

#include "calls.h"
#include "measures.h"
#include "swage/curvature.h"
#include "swage/diagnose.h"
#include "swage/features.h"
#include "swage/steps.h"

namespace swage::test {
std::vector<Call> mesh_calls() {
  return {
      CALL(check(rows(0), cube.triangles)),
      CALL(check(cube.positions, rows<Triangles>(0))),
      CALL(check(rows(8, 0, nan), cube.triangles)),
      CALL(check(rows(8, 0, 2e12), cube.triangles)),
      CALL(check(cube.positions, rows<Triangles>(1, 0, 8))),
      CALL(check(Gesture{}, cube.positions, cube.triangles)),
      CALL(check(Gesture{"", {{8, {0, 0, 0}}}}, cube.positions, cube.triangles)),
      CALL(check(Gesture{"", {{0, {0, 0, nan}}}}, cube.positions, cube.triangles)),
      CALL(Gesture{up}.add(0, {0, 0, 1})),
      CALL(unit_box(point.positions)),
      CALL(diagnose(cube.positions, cube.triangles, {}, -1)),
      CALL(curvature(cube.positions, cube.triangles, with(&CurvatureOptions::crease_angle, 4.0))),
      CALL(curvature(cube.positions, cube.triangles, with(&CurvatureOptions::rings, 0))),
      CALL(feature_edges(cube.positions, cube.triangles, nan)),
      CALL(straight_chains(cube.positions, cube.triangles, with(&StraightOptions::feature_angle, -1))),
      CALL(straight_chains(cube.positions, cube.triangles, with(&StraightOptions::turn, 2))),
      CALL(straight_chains(cube.positions, cube.triangles, with(&StraightOptions::deviation, 2))),
      CALL(straight_chains(cube.positions, cube.triangles, with(&StraightOptions::shortest, nan))),
      CALL(check_rows("RotationStep::fit", "positions", 7, 8)),
  };
}

}  // namespace swage::test

// What crosses the library's border, in both directions: matrices that one side makes and the other frees, functions of
// ours that it calls, errors of its own that we catch.
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "swage/backend.h"
#include "swage/error.h"
#include "swage/reshape.h"
#include "swage/style.h"
#include "swage/template_edit.h"
#include "swage/template_fit.h"

namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "border: %s\n", what);
  std::exit(1);
}

void matrices() {
  for (int i = 0; i < 100; ++i) {
    swage::Mesh made_there = swage::prism(6 + i);
    made_there.positions.conservativeResize(made_there.positions.rows() + 1, 3);
    made_there.positions.bottomRows(1).setZero();
    Eigen::MatrixXd by_columns = made_there.positions;
    require(swage::box_diagonal(by_columns) > 1, "a box of matrices by columns");
    made_there.positions = swage::prism(3).positions;
    require(made_there.positions.rows() == 6, "a matrix moved across");
  }
}

void callbacks() {
  const swage::Mesh sphere = swage::rounded_cube();
  swage::Gesture gesture;
  gesture.add(0, sphere.positions.row(0));
  gesture.add(1, sphere.positions.row(1) + Eigen::RowVector3d(0, 0, 0.1));
  int calls = 0;
  const swage::ReshapeResult result = swage::reshape(sphere.positions, sphere.triangles, gesture, {},
                                                     [&](const swage::Progress&) { return ++calls < 3; });
  require(result.report.stop == swage::Termination::cancelled, "a progress of ours that cancels");

  const swage::Template ball =
      swage::template_of("ball", {{"radius", "", "", 1, 0.5, 2}},
                         [](const swage::Positions& points, const Eigen::VectorXd& parameters,
                            Eigen::VectorXd& values) { values = points.rowwise().norm().array() - parameters[0]; });
  swage::TemplateEdit edit(ball, ball.defaults(), {}, sphere.positions, sphere.triangles);
  Eigen::VectorXd target = ball.defaults();
  target[0] *= 1.2;
  require(edit.solve(target).positions.allFinite(), "a template of a function of ours");
}

void errors() {
  bool caught = false;
  try {
    swage::check(swage::Positions(), swage::Triangles());
  } catch (const swage::InvalidInput&) {
    caught = true;
  }
  require(caught, "its error by its type");
  caught = false;
  try {
    swage::opencl_backend("no such device");
  } catch (const swage::Unavailable&) {  // not in this build, or no such device
    caught = true;
  }
  require(caught, "another error by its type");
}

}  // namespace

int main() {
  matrices();
  callbacks();
  errors();
}

#include "calls.h"
#include "swage/template.h"
#include "swage/template_edit.h"
#include "swage/template_fit.h"

namespace swage::test {
namespace {

/// f = |p| - size.
void ball(const Positions& points, const Eigen::VectorXd& parameters, Eigen::VectorXd& values) {
  values = points.rowwise().norm().array() - parameters[0];
}

void too_few(const Positions&, const Eigen::VectorXd&, Eigen::VectorXd& values) { values.setZero(1); }

void not_finite(const Positions& points, const Eigen::VectorXd&, Eigen::VectorXd& values) {
  values.setConstant(points.rows(), nan);
}

TemplateParameter size(double value = 0.5, double least = 0.1, double most = 2) {
  return {"size", "", "", value, least, most};
}

Template template_by(const FieldFunction& function, char up = 'y') {
  return template_of("ball", {size()}, function, up);
}

Template ball_of(const std::vector<TemplateParameter>& parameters) { return template_of("ball", parameters, ball); }

Eigen::VectorXd values(Eigen::Index count, double value = 0.5) { return Eigen::VectorXd::Constant(count, value); }

TemplateFit fit(const FitOptions& options, const Mesh& mesh = cube) {
  return fit_template(template_by(ball), mesh.positions, mesh.triangles, options);
}

TemplatePose pose(double scale, double turn) {
  TemplatePose made;
  made.scale = scale;
  made.rotation *= turn;
  return made;
}

TemplateEdit edit(const TemplateEditOptions& options = {}, const FieldFunction& function = ball) {
  return {template_by(function), values(1), {}, cube.positions, cube.triangles, options};
}

RetargetResult retarget_to(const Mesh& target) {
  RetargetOptions options;
  for (FitOptions* one : {&options.source, &options.target}) {
    one->surface_samples = 100;
    one->volume_samples = 0;
    one->sigmas = one->iterations = 1;
    one->start = values(1);
    one->pose = TemplatePose();
  }
  return retarget(template_by(ball), cube.positions, cube.triangles, target.positions, target.triangles, options);
}

std::vector<TemplateEditResult> steps(int count) {
  TemplateEdit made = edit();
  return interpolate(made, values(1), values(1), count);
}

}  // namespace

std::vector<Call> template_calls() {
  return {
      CALL(read_template("missing.json")),
      CALL(parse_template("{}", "mine")),
      CALL(shipped_template("stool")),
      CALL(shipped_template("box").parameter("girth")),
      CALL(template_by(nullptr)),
      CALL(template_by(ball, 'w')),
      CALL(ball_of({{"2size", "", "", 1, 0, 2}})),
      CALL(ball_of({size(), size()})),
      CALL(ball_of({size(3)})),
      CALL(template_by(ball).tape()),
      CALL(template_by(ball).text()),
      CALL(template_mesh(template_by(ball), values(2))),
      CALL(template_mesh(template_by(ball), values(1, nan))),
      CALL(template_mesh(template_by(ball), values(1), with(&TemplateMeshOptions::resolution, 7))),
      CALL(template_mesh(template_by(ball), values(1, 1000))),
      CALL(template_mesh(template_by(ball), values(1, 80))),
      CALL(template_mesh(template_by(too_few), values(1))),
      CALL(fit(with(&FitOptions::surface_samples, 99))),
      CALL(fit(with(&FitOptions::volume_samples, -1))),
      CALL(fit(with(&FitOptions::alpha, -1))),
      CALL(fit(with(&FitOptions::sigmas, 0))),
      CALL(fit(with(&FitOptions::least_sigma, 0))),
      CALL(fit(with(&FitOptions::iterations, 0))),
      CALL(fit(with(&FitOptions::up, 'w'))),
      CALL(fit(with(&FitOptions::start, values(2)))),
      CALL(fit(with(&FitOptions::pose, pose(1, 2)))),
      CALL(fit(with(&FitOptions::pose, pose(0, 1)))),
      CALL(fit({}, line)),
      CALL(edit(with(&TemplateEditOptions::tracking, 0))),
      CALL(edit(with(&TemplateEditOptions::smoothing, -1))),
      CALL(edit(with(&TemplateEditOptions::feature_angle, 0))),
      CALL(edit(with(&TemplateEditOptions::sub_edits, -1))),
      CALL(edit(with(&TemplateEditOptions::passes, 0))),
      CALL(edit(with(&TemplateEditOptions::tolerance, 1))),
      CALL(edit({}, not_finite).solve(values(1))),
      CALL(edit().solve(values(2))),
      CALL(edit().solve(values(1, nan))),
      CALL(edit().follow(values(1), 0)),
      CALL(steps(1)),
      CALL(retarget_to(line)),
  };
}

}  // namespace swage::test

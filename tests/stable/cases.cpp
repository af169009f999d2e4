#include "cases.h"

#include <map>
#include <ostream>
#include <utility>

#include "ball_amid_slabs.h"
#include "shapes.h"
#include "stylized.h"
#include "swage/deform.h"
#include "swage/polycube.h"
#include "swage/reshape.h"
#include "swage/resize.h"
#include "swage/stylize.h"
#include "swage/template_edit.h"
#include "swage/template_fit.h"

namespace swage::test {
namespace {

using BackendPtr = Case::BackendPtr;

/// Passes go on until they stand still, else rounding decides where they end. In single precision they never do.
double still(const BackendPtr& backend) { return backend->precision() == Precision::twice ? 1e-10 : 1e-4; }

const Eigen::Vector3d kLift(0.3, 0.4, 0.1);

Case reshape_case(const std::string& name, const Mesh& mesh, const ReshapeOptions& options) {
  const Gesture gesture = move_top(mesh, kLift);
  return {name, mesh, [=](const Written& written, const BackendPtr& backend) {
            ReshapeOptions own = options;
            own.backend = backend;
            own.movement = still(backend);
            return written.back(
                reshape(written.mesh().positions, written.mesh().triangles, written.into(gesture), own).positions);
          }};
}

Case deform_case(const std::string& name, const Mesh& mesh, DeformMethod method) {
  const Gesture gesture = move_top(mesh, kLift);
  Case of{name, mesh, [=](const Written& written, const BackendPtr& backend) {
            DeformOptions options;
            options.method = method;
            options.backend = backend;
            options.movement = still(backend);
            return written.back(
                deform(written.mesh().positions, written.mesh().triangles, written.into(gesture), options).positions);
          }};
  of.single = 1e-4;  // Some hundred passes: where they end is decided by what each loses.
  return of;
}

/// One vertex is held: without handles the first corner of the first triangle is, which is another in another order.
Case stylize_case(const std::string& name, const Mesh& mesh, StylizeEnergy energy) {
  Gesture handle;
  handle.add(0, mesh.positions.row(0));
  Case of{name, mesh, [=](const Written& written, const BackendPtr& backend) {
            StylizeOptions options;
            options.energy = energy;
            options.pass_limit = 2000;
            options.movement = still(backend);
            options.backend = backend;
            return written.back(stylize(written.mesh().positions, written.mesh().triangles, cube_normals(), 1, options,
                                        written.into(handle))
                                    .positions);
          }};
  of.single = 1e-4;  // As StylizeShape has it.
  return of;
}

/// The low corner stays.
Case resize_case() {
  const Mesh slab = box({1, 2, 2}, 2), ball = transformed(sphere(0.9, 2), 1, {3, 1, 1});
  const Mesh model = joined(joined(slab, ball), transformed(slab, 1, {5, 0, 0}));
  return {"resize", transformed(model, 0.15, {0, 0, 0}), [](const Written& written, const BackendPtr& backend) {
            ResizeOptions options = coarse();
            options.backend = backend;
            const Mesh& mesh = written.mesh();
            return written.back(resize(mesh.positions, mesh.triangles, by(2, 1, 0.5), options).positions);
          }};
}

/// The pose in which a template lies where the mesh was given.
TemplatePose pose_of(const Written& written) {
  TemplatePose pose;
  pose.scale = 1 / written.scale();
  pose.offset = -pose.scale * written.into(Eigen::Vector3d(0, 0, 0)).transpose();
  return pose;
}

Eigen::VectorXd with(const Template& of, const std::map<std::string, double>& values) {
  Eigen::VectorXd parameters = of.defaults();
  for (const auto& [name, value] : values) parameters[of.parameter(name)] = value;
  return parameters;
}

Mesh brick(int cells = 4) { return transformed(box({0.8, 0.6, 0.5}, cells), 1, {-0.4, -0.3, -0.25}); }
const std::map<std::string, double> kBrick = {{"width", 0.8}, {"height", 0.6}, {"depth", 0.5}, {"rounding", 0.05}};

Case edit_case() {
  Case one{"template_edit", brick(), [](const Written& written, const BackendPtr& backend) {
             const Template of = shipped_template("box");
             TemplateEditOptions options;
             options.backend = backend;
             options.tolerance = still(backend);
             options.passes = 60;  // It goes on sliding slowly.
             const Mesh& mesh = written.mesh();
             std::map<std::string, double> target = kBrick;
             target["width"] = 0.85;
             target["taper"] = 0.95;
             TemplateEdit edit(of, with(of, kBrick), pose_of(written), mesh.positions, mesh.triangles, options);
             return written.back(edit.solve(with(of, target)).positions);
           }};
  // Where on its slow slide along the template it ends the factor's last digits decide, which processors have their own
  // of.
  one.golden = 1e-6;
  return one;
}

/// The mesh in the template's space, and the parameters as parts of their ranges.
Case fit_case() {
  Case one{"template_fit", brick(), [](const Written& written, const BackendPtr& backend) {
             const Template of = shipped_template("box");
             FitOptions options;
             options.backend = backend;
             options.surface_samples = options.volume_samples = 400;
             options.start = of.defaults();
             options.up = 'y';
             options.turns = false;
             const Mesh& mesh = written.mesh();
             const TemplateFit fit = fit_template(of, mesh.positions, mesh.triangles, options);
             const Eigen::Index count = mesh.positions.rows(), parameters = fit.parameters.size();
             Positions rows = Positions::Zero(count + parameters, 3);
             rows.topRows(count) = written.in_order(fit.pose.into(mesh.positions));
             for (Eigen::Index p = 0; p < parameters; ++p) {
               const TemplateParameter& range = of.parameters()[static_cast<size_t>(p)];
               rows(count + p, 0) = (fit.parameters[p] - range.least) / (range.most - range.least);
             }
             return rows;
           }};
  // A descent ends where the energy, a square, falls by less than 1e-6 of itself: rounding decides where on the way to
  // the minimum that is.
  one.golden = one.follows = one.far = one.single = 2e-3;
  return one;
}

/// Keeps each component where it is.
Case polycube_case() {
  return {"polycube", transformed(askew(bumpy_sphere(0.1, 2)), 0.3, {0, 0, 0}),
          [](const Written& written, const BackendPtr& backend) {
            PolycubeOptions options;
            options.backend = backend;
            const Mesh& mesh = written.mesh();
            return written.back(polycube(mesh.positions, mesh.triangles, cube_normals(), options).positions);
          }};
}

/// A vertex of no triangle, as far from one side as from another.
Mesh with_loose(Mesh mesh) {
  mesh.positions.conservativeResize(mesh.positions.rows() + 1, 3);
  mesh.positions.bottomRows(1) << 0.01, 0.4, 0;
  return mesh;
}

std::vector<Case> made() {
  const Mesh part = cylinder(0.4, 0.8, 12, 4), ring = transformed(askew(torus(1, 0.4, 16, 8)), 0.3, {0, 0, 0});
  const Mesh apart =
      transformed(joined(torus(1, 0.4, 16, 8), transformed(box({1, 1, 1}, 3), 1, {2, 0, 0})), 0.2, {0, 0, 0});
  const Mesh block = box({0.5, 0.5, 0.5}, 4);
  ReshapeOptions steady, published, alup, chains;
  published.solver = ReshapeSolver::published;
  alup.method = ReshapeMethod::alup;
  chains.find_chains = StraightOptions{};
  std::vector<Case> all = {
      reshape_case("reshape_steady", part, steady),
      reshape_case("reshape_published", part, published),
      deform_case("deform_poisson", part, DeformMethod::poisson),
      deform_case("deform_arap", part, DeformMethod::arap),
      deform_case("deform_conformal", part, DeformMethod::conformal),
      stylize_case("stylize_arap", ring, StylizeEnergy::arap),
      stylize_case("stylize_farap", ring, StylizeEnergy::farap),
      stylize_case("stylize_acap", ring, StylizeEnergy::acap),
      resize_case(),
      edit_case(),
      fit_case(),
  };
  // What a mesh may be beside well made, and what else the methods do.
  std::vector<Case> others = {
      reshape_case("alup", part, alup),
      reshape_case("straight_chains", transformed(box({1, 2, 1}, 3), 0.4, {0, 0, 0}), chains),
      reshape_case("components", apart, steady),
      reshape_case("awkward", transformed(awkward(), 0.5, {0, 0, 0}), steady),
      reshape_case("loose_vertex", with_loose(part), steady),
      deform_case("many_contacts", joined(brick(9), transformed(brick(9), 1, {0.1, 0.6, 0.05})), DeformMethod::poisson),
      deform_case("crossing", joined(block, transformed(block, 1, {0.215, 0.3, 0.085})), DeformMethod::poisson),
      polycube_case(),
  };
  // Points on a sphere, as of a torus: the tetrahedra between are others once the points have fewer digits.
  others[2].far = 5e-4;
  for (Case& of : others) {
    of.golden = 0;
    all.push_back(std::move(of));
  }
  return all;
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all = made();
  return all;
}

std::string name_of(const testing::TestParamInfo<Case>& instance) { return instance.param.name; }

double apart(const Case& of, const Positions& one, const Positions& other) {
  return (one - other).rowwise().norm().maxCoeff() / box_diagonal(of.mesh.positions);
}

void PrintTo(const Case& of, std::ostream* out) { *out << of.name; }

}  // namespace swage::test

// What a fit minimises.
#pragma once

#include <Eigen/Core>
#include <utility>

#include "cancel.h"
#include "samples.h"
#include "swage/steps.h"
#include "swage/template_fit.h"

namespace swage {

/// What the template is compared with, in the mesh's unit box.
struct FitSamples {
  Positions surface;
  VolumeSamples volume;
};

/// Squares of percents of the mesh's diagonal D, of the parameters as parts of their ranges and, in the last three
/// places, the pose's offset: from 0 to 1 over kOffset of D to either side.
class Objective {
 public:
  /// `diagonal`: D, in the mesh's unit box. Sees its references as long as it is used.
  Objective(const Template& of, const FitSamples& samples, const TemplatePose& pose, double diagonal, double alpha,
            FieldStep& step, const Poll& poll);

  Eigen::Index size() const { return static_cast<Eigen::Index>(template_.parameters().size()) + 3; }
  /// The place of the parameters with the pose as it is.
  Eigen::VectorXd place_of(const Eigen::VectorXd& parameters) const;
  Eigen::VectorXd parameters_at(const Eigen::VectorXd& x) const;
  TemplatePose pose_at(const Eigen::VectorXd& x) const;
  /// Holds the pose's offset where it is.
  void hold_offset() { offset_is_held_ = true; }

  /// In parts of D.
  void set_sigma(double sigma) { sigma_ = sigma * size_; }

  double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient);

 private:
  Eigen::RowVector3d offset_at(const Eigen::VectorXd& x) const;
  template <typename Error>
  double add(const Positions& points, const Eigen::VectorXd& parameters, Eigen::VectorXd& gradient, const Error& error);

  const Template& template_;
  const FitSamples& samples_;
  TemplatePose pose_;
  double size_;  // D in the template's space.
  double alpha_, sigma_;
  FieldStep& step_;
  const Poll& poll_;
  bool offset_is_held_ = false;
  Positions surface_, volume_;
  Eigen::VectorXd distances_;
  FieldValues field_;
};

/// The best place that L-BFGS-B saw.
struct Minimum {
  Eigen::VectorXd x;
  double energy = INFINITY;
  int iterations = 0;
};

/// From the start, within 0 and 1.
Minimum minimise(Objective& objective, const Eigen::VectorXd& start, int iterations);

}  // namespace swage

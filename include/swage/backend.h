// Who does the local steps.
#pragma once

#include <memory>
#include <string>

#include "swage/steps.h"

namespace swage {

/// Makes steps. May be shared between threads; a step it made may not.
class Backend {
 public:
  virtual ~Backend() = default;
  virtual std::string name() const = 0;    ///< "cpu"
  virtual std::string device() const = 0;  ///< For people to read.

  virtual std::unique_ptr<TransformStep> transform(const TransformStep::Rest& rest) const = 0;
  virtual std::unique_ptr<CurvatureStep> curvature(const CurvatureStep::Rest& rest) const = 0;
};

/// The reference: Eigen, double, OpenMP. The same bytes from any number of threads.
std::shared_ptr<Backend> cpu_backend();

}  // namespace swage

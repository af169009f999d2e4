// Who does the local steps.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "swage/steps.h"

#pragma GCC visibility push(default)
namespace swage {

/// What a device computes in. Hosts and the reference compute in double.
enum class Precision { single, twice };

/// Host ↔ device traffic and times of all steps of a backend so far. A device that computes in the host's memory gets
/// the host's arrays as they lie; they count all the same.
struct Traffic {
  std::size_t uploaded = 0;    ///< Bytes, static data included.
  std::size_t downloaded = 0;  ///< Bytes.
  double build_seconds = 0;    ///< Spent compiling kernels.
};

/// Makes steps. May be shared between threads; a step it made may not.
class Backend {
 public:
  virtual ~Backend() = default;
  virtual std::string name() const = 0;                             ///< "cpu" or "opencl"
  virtual std::string device() const = 0;                           ///< For people to read.
  virtual Precision precision() const { return Precision::twice; }  ///< What its steps compute in.
  virtual Traffic traffic() const { return {}; }                    ///< Of all steps that it made.

  virtual std::unique_ptr<RotationStep> rotation(const PairsRest& rest) const = 0;
  virtual std::unique_ptr<SimilarityStep> similarity(const PairsRest& rest) const = 0;
  /// The step may keep `rest`, which is a quarter of a gigabyte at a million triangles; not null.
  virtual std::unique_ptr<TransformStep> transform(std::shared_ptr<const TransformStep::Rest> rest) const = 0;
  /// The same of a copy.
  std::unique_ptr<TransformStep> transform(const TransformStep::Rest& rest) const {
    return transform(std::make_shared<const TransformStep::Rest>(rest));
  }
  virtual std::unique_ptr<CouplingStep> coupling(const TransformStep::Rest& rest) const = 0;
  virtual std::unique_ptr<CurvatureStep> curvature(const CurvatureStep::Rest& rest) const = 0;
  virtual std::unique_ptr<NormalFitStep> normal_fit(const NormalFitStep::Rest& rest) const = 0;
  /// `normals`: #M × 3, of length 1; at least one.
  virtual std::unique_ptr<ClosestNormalStep> closest_normal(const Positions& normals) const = 0;
  virtual std::unique_ptr<FieldStep> field(const Tape& tape) const = 0;
  virtual std::unique_ptr<LocalMapStep> local_map(const LocalMapStep::Rest& rest) const = 0;
  /// The step keeps `rest`.
  virtual std::unique_ptr<CarryStep> carry(CarryStep::Rest rest) const = 0;
};

/// The reference: Eigen, double, OpenMP. The same bytes from any number of threads.
std::shared_ptr<Backend> cpu_backend();

/// An OpenCL device as a person would choose it.
struct Device {
  int index = 0;  ///< Of opencl_devices().
  std::string name, platform, driver;
  std::string kind;  ///< "cpu", "gpu", "accelerator"
  int compute_units = 0;
  std::size_t memory = 0;          ///< Bytes.
  std::size_t largest_buffer = 0;  ///< Bytes.
  bool computes_twice = false;     ///< Has double precision.
  std::string missing;             ///< What it lacks, in words; empty where it can be used.
};

/// All devices of all platforms, the usable first in the order that `auto` prefers: GPUs, accelerators, CPUs, the one
/// with more compute units first. Empty where there is no platform. Throws Unavailable where the build has no OpenCL.
std::vector<Device> opencl_devices();

/// The backend on a device: `device` is an index or a part of a name of opencl_devices(); empty takes the first usable.
/// Throws Unavailable, saying what there is, where none fits, the device lacks what `precision` needs, or the build has
/// no OpenCL.
std::shared_ptr<Backend> opencl_backend(const std::string& device = "", Precision precision = Precision::twice);

}  // namespace swage
#pragma GCC visibility pop

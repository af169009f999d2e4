// Preparing a plan: once, by whoever asks first, in stages that are told and can be cancelled.
#pragma once

#include <mutex>

#include "cancel.h"
#include "swage/report.h"

namespace swage {

/// Of a whole call's progress, what preparation is.
constexpr double kPrepared = 0.2;

/// Stages of work, told as the first part of a call's progress, and ended where the caller cancels.
class Stages {
 public:
  /// `whole`: what all of them are of the call.
  Stages(const ProgressFn& progress, int pass_limit, double whole);
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  /// `part` of all stages is done. Throws Cancelled.
  void begin(const char* stage, double part);
  /// Within a stage.
  const Poll& poll() const { return poll_; }

 private:
  bool goes_on() const { return !progress_ || progress_(now_); }

  const ProgressFn& progress_;
  Progress now_;
  double whole_;
  Poll poll_;
};

class Preparation : public Stages {
 public:
  Preparation(const ProgressFn& progress, int pass_limit) : Stages(progress, pass_limit, kPrepared) {}
};

/// Progress of what comes after the preparation.
ProgressFn after_preparation(const ProgressFn& progress);

/// Lets `make` prepare a plan unless it is `prepared`; others wait. False where it was cancelled: another call begins
/// anew.
template <class Plan, class Make>
bool prepare_once(Plan& plan, const Make& make) {
  const std::lock_guard lock(plan.preparing);
  if (plan.prepared) return true;
  try {
    make(plan);
    return plan.prepared = true;
  } catch (const Cancelled&) {
    return false;
  }
}

}  // namespace swage

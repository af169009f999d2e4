// How far a picture is.
#pragma once

#include <algorithm>

#include "swage/report.h"

namespace swage {

/// A stretch [from, to] of the whole call.
struct Watch {
  const ProgressFn& progress;
  double from = 0, to = 1;

  /// Tells that `part` of the stretch is done; false where the call is to stop.
  bool goes_on(const char* stage, double part) const {
    return !progress || progress({stage, 0, 0, from + std::clamp(part, 0.0, 1.0) * (to - from), 0});
  }
  Watch part(double low, double high) const { return {progress, from + low * (to - from), from + high * (to - from)}; }
};

}  // namespace swage

// A context of its own, on the first usable device, for tests of what lies under a backend.
#pragma once

#include <memory>

#include "context.h"
#include "devices.h"
#include "opencl_device.h"

namespace swage::test {

/// Null where opencl_or_skip() gives none.
inline std::shared_ptr<Context> context_or_skip(Precision precision = Precision::twice,
                                                const ProgramCache& cache = {}) {
  if (!opencl_or_skip(precision)) return nullptr;
  return std::make_shared<Context>(choose_device("", precision).handle, precision, cache);
}

/// A device's memory as if it were not the host's, so that all is copied.
inline std::shared_ptr<Context> context_apart_or_skip(Precision precision) {
  if (!opencl_or_skip(precision)) return nullptr;
  return std::make_shared<Context>(choose_device("", precision).handle, precision, ProgramCache(), false);
}

}  // namespace swage::test

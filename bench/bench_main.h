#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "swage/backend.h"

namespace swage::bench {

/// Registers what this program measures: once for each model there is.
void register_all();

/// Who does the local steps: the reference, and OpenCL in single and double precision.
struct NamedBackend {
  std::string name;
  std::shared_ptr<Backend> (*backend)();
};
std::vector<NamedBackend> named_backends();

/// In milliseconds of real time; left out, with the reason, where `run` finds that what it needs is unavailable.
benchmark::internal::Benchmark* add_benchmark(const std::string& name,
                                              const std::function<void(benchmark::State&)>& run);

}  // namespace swage::bench

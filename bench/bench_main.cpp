// Runs the benchmarks with what their figures depend on in the context: device, threads, commit.
#include "bench_main.h"

#include <benchmark/benchmark.h>

#include <string>

#include "machine.h"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::AddCustomContext("device", swage::bench::processor());
  benchmark::AddCustomContext("threads", std::to_string(swage::bench::threads()));
  benchmark::AddCustomContext("commit", SWAGE_COMMIT);
  swage::bench::register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

// Runs the benchmarks with what their figures depend on in the context: device, threads, commit.
#include "bench_main.h"

#include "machine.h"
#include "swage/error.h"

namespace swage::bench {

std::vector<NamedBackend> named_backends() {
  return {{"cpu/double", [] { return cpu_backend(); }},
          {"opencl/single", [] { return opencl_backend("", Precision::single); }},
          {"opencl/double", [] { return opencl_backend("", Precision::twice); }}};
}

benchmark::internal::Benchmark* add_benchmark(const std::string& name,
                                              const std::function<void(benchmark::State&)>& run) {
  return benchmark::RegisterBenchmark(name.c_str(),
                                      [run](benchmark::State& state) {
                                        try {
                                          run(state);
                                        } catch (const Unavailable& reason) {
                                          state.SkipWithError(reason.what());
                                        }
                                      })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace swage::bench

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

#include "device_peak.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <string>

namespace swage::bench {
namespace {

constexpr int kRounds = 1000, kRuns = 5;

/// The line once for each chain, its number for '#'.
std::string each(int chains, const std::string& line) {
  std::string lines;
  for (int chain = 0; chain < chains; ++chain) {
    for (const char c : line) lines += c == '#' ? std::to_string(chain) : std::string(1, c);
  }
  return lines;
}

/// Chains of products and sums that do not wait for each other: in variables, since an array would lie in memory.
std::string text_of(int chains) {
  return R"(
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/lane_memory.h"
kernel void run_chains(const int count, const int rounds, const scalar factor, const scalar summand,
                       global scalar* sums) {
  const int i = get_global_id(0);
  if (i >= count) return;
)" + each(chains, "  real c# = (real)(i + #);\n") +
         "  for (int round = 0; round < rounds; ++round) {\n" + each(chains, "    c# = c# * factor + summand;\n") +
         "  }\n" + "  store_lanes((real)0" + each(chains, " + c#") + ", sums, i);\n}\n";
}

double flops_in_chains(const Queue& queue, int chains) {
  const int lanes = queue.context->lanes("chains"), items = (1 << 18) / lanes;
  const Reals sums(queue, Eigen::Index{items} * lanes);
  Kernel kernel(queue, queue.context->program("chains", text_of(chains)), "run_chains");
  double best = 0;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    kernel.launch(items, kRounds, 0.5, 1., sums);
    queue.handle.finish();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    best = std::max(best, 2. * chains * kRounds * items * lanes / seconds.count());
  }
  return best;
}

}  // namespace

double peak_flops(const Queue& queue) {
  static std::map<Precision, double> peaks;
  double& peak = peaks[queue.context->precision()];
  if (peak == 0) {
    // Few leave units idle, many have no registers.
    for (const int chains : {3, 6, 12}) peak = std::max(peak, flops_in_chains(queue, chains));
  }
  return peak;
}

}  // namespace swage::bench

#include "plan.h"

namespace swage {

double hold_energy(const DeformOptions& options, const std::vector<Hold>& holds, const Positions& positions) {
  if (!options.handle_weight) return 0;
  double sum = 0;
  for (const Hold& hold : holds) {
    sum += hold.share * *options.handle_weight * (hold.point(positions) - hold.target).squaredNorm();
  }
  return sum;
}

}  // namespace swage

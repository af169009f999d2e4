#include "swage/report.h"

namespace swage {

const char* to_string(Termination termination) {
  switch (termination) {
    case Termination::moved_little:
      return "moved";
    case Termination::energy_rose:
      return "energy rose";
    case Termination::energy_settled:
      return "energy settled";
    case Termination::pass_limit:
      return "pass limit";
    case Termination::cancelled:
      return "cancelled";
  }
  return "unknown";
}

}  // namespace swage

#include "swage/when.h"

namespace swage {

const char* to_string(When when) {
  switch (when) {
    case When::never:
      return "never";
    case When::always:
      return "always";
    case When::automatic:
      break;
  }
  return "auto";
}

}  // namespace swage

#include "cancel.h"

#include <chrono>
#include <utility>

namespace swage {

Poll sparing(std::function<bool()> goes_on) {
  using Clock = std::chrono::steady_clock;
  static constexpr auto kPause = std::chrono::milliseconds(100);
  return [goes_on = std::move(goes_on), last = Clock::now()]() mutable {
    if (Clock::now() - last < kPause) return;
    if (!goes_on()) throw Cancelled();
    last = Clock::now();
  };
}

}  // namespace swage

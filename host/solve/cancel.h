// How long work is cancelled from within.
#pragma once

#include <functional>

namespace swage {

/// Thrown where the caller cancelled. Never leaves the library.
struct Cancelled {};

/// Called every few tenths of a second at least during long work. Throws Cancelled to end it.
using Poll = std::function<void()>;

/// Where there is one.
inline void ask(const Poll& poll) {
  if (poll) poll();
}

/// Asks `goes_on` a tenth of a second after the last time and not before; throws Cancelled where it says no.
Poll sparing(std::function<bool()> goes_on);

}  // namespace swage

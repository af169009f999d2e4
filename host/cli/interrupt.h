// Ctrl-C and SIGTERM.
#pragma once

namespace swage::cli {

/// From now on the first Ctrl-C or SIGTERM only sets a flag; a second one ends the program at once.
void watch_interrupts();

bool interrupted();

/// Throws Interrupted where the flag is set.
void stop_if_interrupted();

}  // namespace swage::cli

// What the program makes sure of before it begins.
#pragma once

namespace swage::cli {

/// From now on a pipe that nobody reads and a limit on the size of files are errors of writing, not signals; a closed
/// stream does not become the next file that is opened; and running out of memory ends in one line even where no
/// exception may pass.
void prepare_process();

/// As many threads as are wanted, or as can be started, at least 1.
int startable_threads(int wanted);

}  // namespace swage::cli

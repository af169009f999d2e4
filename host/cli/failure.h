// How the program ends when it cannot do what it was asked.
#pragma once

#include <stdexcept>

namespace swage::cli {

/// The command line asks for something that does not exist. Exit code 2.
struct WrongUsage : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// The user stopped the program. Exit code 130.
struct Interrupted {};

enum ExitCode { exit_done = 0, exit_wrong_usage = 2, exit_refused = 3, exit_failed = 4, exit_interrupted = 130 };

inline constexpr const char* kOutOfMemory =
    "out of memory: use a smaller mesh, fewer --threads or a machine with more memory; files not yet written are as "
    "they "
    "were";

/// Logs the exception being handled in one line and says which code to exit with.
int explain_failure();

}  // namespace swage::cli

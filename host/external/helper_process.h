// Optional parts under another licence run as programs of their own: a crash becomes a message, a hang and a greed for
// memory end at a limit, and their licence stays apart from the library's.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "cancel.h"

namespace swage {

struct HelperLimits {
  double seconds = 60;                       ///< Wall time, above 0.
  std::size_t bytes = std::size_t{4} << 30;  ///< Of address space, and of its answer.
};

/// Runs a helper, `input` on its stdin, and returns what it writes to its stdout. `program` is a path where it holds a
/// slash, else a name looked for in helper_folders(). Several may run at once, from several threads. Throws
/// - Unavailable where there is no such program, or it cannot be started;
/// - Unsolvable where it crashed, failed or went beyond a limit, with the last line that it wrote to stderr;
/// - what `poll` throws, called every tenth of a second.
/// In each case the helper has ended.
std::string run_helper(const std::string& program, const std::string& input, const HelperLimits& limits,
                       const Poll& poll = {});

/// Where helpers are looked for, in this order: the folder named by the environment's SWAGE_HELPERS, the running
/// program's, `swage` in its `../libexec` and `../lib*`, the build's, the installation's.
std::vector<std::filesystem::path> helper_folders();

}  // namespace swage

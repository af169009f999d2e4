// The five ways a call can fail. Not converging is none of them: it is a Termination (report.h).
#pragma once

#include <stdexcept>
#include <string>

#pragma GCC visibility push(default)
namespace swage {

/// An argument breaks the function's contract. The message names the function, the argument and the index.
struct InvalidInput : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A file is missing, unreadable or malformed. The message names the file, the line or byte, and a remedy.
struct UnreadableFile : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A result could not be written. Whatever stood at its path still stands there.
struct UnwritableFile : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What is asked for does not exist or was not found: a linear system's solution in double precision, tetrahedra around
/// a surface that crosses itself. The message says why.
struct Unsolvable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The call needs an optional part that this build leaves out. The message names the build option.
struct Unavailable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace swage
#pragma GCC visibility pop

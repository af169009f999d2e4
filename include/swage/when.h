// Whether to do something that not every mesh needs.
#pragma once

#pragma GCC visibility push(default)
namespace swage {

enum class When {
  automatic,  ///< Where the mesh needs it and it can be had; the report says what was done.
  never,
  always,  ///< Throws where it cannot be had.
};

/// "auto", "never", "always".
const char* to_string(When when);

}  // namespace swage
#pragma GCC visibility pop

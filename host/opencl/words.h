// OpenCL's errors in words.
#pragma once

#include <string>
#include <utility>

#include "cl.h"

namespace swage {

/// Throws Unavailable: what was asked, what came of it, and a remedy where there is one.
[[noreturn]] void refuse(const std::string& asked, const cl::Error& error);

/// Gives what `call` gives; what OpenCL refuses is Unavailable.
template <typename Call>
auto ask(const std::string& asked, Call&& call) {
  try {
    return std::forward<Call>(call)();
  } catch (const cl::Error& error) {
    refuse(asked, error);
  }
}

}  // namespace swage

// The text of the kernels.
#pragma once

#include <string>
#include <string_view>

#include "swage/backend.h"

namespace swage {

/// Work items of a group: kernels' GROUP.
constexpr int kGroup = 64;

/// A file of kernels/ by its path in there; the build embeds them all. Throws std::out_of_range.
std::string_view kernel_file(std::string_view path);

/// What kernels compute in: `scalar`, `scalar4`, and `lanes` of LANES scalars: 1, 8 or 16. What their arguments of the
/// host's are in: `host_scalar`, `host_scalar4`, the host's doubles or `scalar`.
struct Arithmetic {
  Precision precision = Precision::twice;
  int lanes = 1;
  bool host_doubles = false;
};

/// Lanes of kernels/<stem>.cl on a device that computes in vectors, by measurement: two vectors keep one busier than
/// one does, but what is gathered comes one by one and soon finds no register.
int lanes_of(std::string_view stem);

/// What the compiler gets for kernels/<stem>.cl: the arithmetic, then the file, each `#include "shared/..."` replaced
/// by that file the first time it stands there. Log lines name the files.
std::string program_source(const std::string& stem, const Arithmetic& arithmetic);

/// The same for a text that stands in no file.
std::string program_source(const std::string& name, std::string_view text, const Arithmetic& arithmetic);

}  // namespace swage

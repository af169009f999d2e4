// The text of the kernels.
#pragma once

#include <string>
#include <string_view>

#include "swage/backend.h"

namespace swage {

/// A file of kernels/ by its path in there; the build embeds them all. Throws std::out_of_range.
std::string_view kernel_file(std::string_view path);

/// What kernels compute in: `scalar`, `scalar4`, and `lanes` of LANES scalars, 1 or 16.
struct Arithmetic {
  Precision precision = Precision::twice;
  int lanes = 1;
};

/// What the compiler gets for kernels/<stem>.cl: the arithmetic, then the file, each `#include "shared/..."` replaced
/// by that file the first time it stands there. Log lines name the files.
std::string program_source(const std::string& stem, const Arithmetic& arithmetic);

/// The same for a text that stands in no file.
std::string program_source(const std::string& name, std::string_view text, const Arithmetic& arithmetic);

}  // namespace swage

// The text of the kernels.
#pragma once

#include <string>
#include <string_view>

#include "swage/backend.h"

namespace swage {

/// A file of kernels/ by its path in there; the build embeds them all. Throws std::out_of_range.
std::string_view kernel_file(std::string_view path);

/// What the compiler gets for kernels/<stem>.cl: `real`, then the file, each `#include "shared/..."` replaced by that
/// file the first time it stands there. Log lines name the files.
std::string program_source(const std::string& stem, Precision precision);

/// The same for a text that stands in no file.
std::string program_source(const std::string& name, std::string_view text, Precision precision);

}  // namespace swage

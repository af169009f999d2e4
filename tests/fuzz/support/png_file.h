// PNG files.
#pragma once

#include <string_view>

namespace swage::fuzz {

/// Whether the picture says that it has more than so many pixels and would be read all the same. Large ones find
/// nothing that small ones do not.
bool takes_long(std::string_view png, unsigned long long pixels);

}  // namespace swage::fuzz

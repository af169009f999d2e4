// The templates that are in the library.
#pragma once

#include <map>
#include <string_view>

namespace swage {

/// By name, their files' content.
const std::map<std::string_view, std::string_view>& shipped_files();

}  // namespace swage

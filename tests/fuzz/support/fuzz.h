// What every fuzz target needs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "swage/error.h"

namespace swage::fuzz {

/// The target, one in each program: reads these bytes and does with what it read what a user does next.
void use(std::string_view bytes);

/// A file called "fuzzed" with that extension, its content replaced by each call.
std::filesystem::path file_of(const std::string& extension, std::string_view bytes);
std::string content_of(const std::filesystem::path& path);

/// Ends the run where it does not hold.
void require(bool holds, const char* what);

/// What the reader gives, or nothing where it refuses by one of the errors that it is documented to throw. Any other
/// error ends the run, and so does the refusal of a file that does not name it.
template <typename... Refusals, typename Read>
auto unless_refused(const Read& read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const UnreadableFile& refusal) {
    if constexpr (!(std::is_same_v<Refusals, UnreadableFile> || ...)) throw;
    require(std::string_view(refusal.what()).find("fuzzed") != std::string_view::npos, "a refusal names the file");
  } catch (const InvalidInput&) {
    if constexpr (!(std::is_same_v<Refusals, InvalidInput> || ...)) throw;
  }
  return std::nullopt;
}

}  // namespace swage::fuzz

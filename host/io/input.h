// A file in memory, and refusals that say where in it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace swage {

struct Input {
  std::filesystem::path path;
  std::string bytes;
  char newline = '\n';  ///< '\r' in a text that has no '\n'.
  bool binary = false;  ///< Whether places in it are told by byte, not by line.
};

/// The whole file. Throws UnreadableFile where there is none.
Input slurp(const std::filesystem::path& path);

/// Refuses a file that is no text in an encoding which contains ASCII.
void require_text(const Input& input);

/// 3 after a UTF-8 byte order mark, else 0.
size_t text_begin(const Input& input);

/// "line 12" or "byte 340", both from 1.
std::string place(const Input& input, size_t offset);

/// The word in quotes: shortened, and without control characters.
std::string in_quotes(std::string_view word);

[[noreturn]] void refuse(const Input& input, const std::string& why);
[[noreturn]] void refuse(const Input& input, size_t offset, const std::string& why);

}  // namespace swage

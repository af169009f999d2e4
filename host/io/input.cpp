#include "input.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>

#include "swage/error.h"

namespace swage {
namespace {

[[noreturn]] void refuse_path(const std::filesystem::path& path, const std::string& why) {
  throw UnreadableFile(path.string() + ": " + why);
}

void require_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    refuse_path(path, "there is no such file; check the path");
  }
  if (error) refuse_path(path, error.message() + "; check the path and its permissions");
  if (std::filesystem::is_directory(status)) refuse_path(path, "is a folder; name a file in it");
  // Devices may never end.
  if (!std::filesystem::is_regular_file(status) && !std::filesystem::is_fifo(status)) {
    refuse_path(path, "is not an ordinary file; copy its content to one");
  }
}

std::string read_all(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file && errno == ENOMEM) throw std::bad_alloc();
  if (!file) refuse_path(path, std::string(std::strerror(errno)) + "; check its permissions");
  std::error_code no_size;
  const auto size = std::filesystem::file_size(path, no_size);
  std::string bytes(no_size ? 0 : static_cast<size_t>(size), '\0');
  size_t filled = 0;
  constexpr size_t kChunk = 1 << 16;
  while (true) {
    // One byte beyond the size, so that the end is seen.
    if (filled == bytes.size()) bytes.resize(filled + kChunk);
    const size_t got = std::fread(bytes.data() + filled, 1, bytes.size() - filled, file.get());
    if (got == 0) break;
    filled += got;
  }
  if (std::ferror(file.get()))
    refuse_path(path,
                "reading it failed: " + std::string(std::strerror(errno)) + "; check where it is kept, or copy it");
  bytes.resize(filled);
  return bytes;
}

bool looks_like_utf16(std::string_view bytes) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) return true;
  const std::string_view head = bytes.substr(0, 64);
  return head.size() >= 4 && static_cast<size_t>(std::count(head.begin(), head.end(), '\0')) * 5 >= head.size() * 2 &&
         ((head[0] == '\0') != (head[1] == '\0'));
}

}  // namespace

Input slurp(const std::filesystem::path& path) {
  require_file(path);
  Input input{path, read_all(path)};
  if (input.bytes.find('\n') == std::string::npos) input.newline = '\r';
  return input;
}

void require_text(const Input& input) {
  if (looks_like_utf16(input.bytes)) refuse(input, "is UTF-16 text; save it as UTF-8");
  const size_t zero = input.bytes.find('\0');
  if (zero == std::string::npos) return;
  refuse(input, "is not a text file: byte " + std::to_string(zero + 1) + " is zero; export the mesh again");
}

size_t text_begin(const Input& input) { return input.bytes.starts_with("\xef\xbb\xbf") ? 3 : 0; }

std::string place(const Input& input, size_t offset) {
  if (input.binary) return "byte " + std::to_string(offset + 1);
  const auto end = input.bytes.begin() + static_cast<std::ptrdiff_t>(std::min(offset, input.bytes.size()));
  return "line " + std::to_string(1 + std::count(input.bytes.begin(), end, input.newline));
}

std::string in_quotes(std::string_view word) {
  constexpr size_t kLongest = 40;
  std::string text(word.substr(0, kLongest));
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return "'" + text + (word.size() > kLongest ? "...'" : "'");
}

void refuse(const Input& input, const std::string& why) { refuse_path(input.path, why); }

void refuse(const Input& input, size_t offset, const std::string& why) {
  refuse_path(input.path, place(input, offset) + ": " + why);
}

}  // namespace swage

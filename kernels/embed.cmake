# Writes OUTPUT: kernel_file() with the FILES of FOLDER as arrays of bytes.
set(arrays "")
set(lines "")
foreach(file IN LISTS FILES)
  file(READ ${FOLDER}/${file} bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(MAKE_C_IDENTIFIER ${file} name)
  string(APPEND arrays "constexpr unsigned char ${name}[] = {${bytes} 0};\n")
  string(APPEND lines "  if (path == \"${file}\") return text(${name}, sizeof ${name} - 1);\n")
endforeach()

file(WRITE ${OUTPUT} "// Made by kernels/embed.cmake.
#include \"kernel_source.h\"

#include <stdexcept>

namespace swage {
namespace {

${arrays}
[[maybe_unused]] std::string_view text(const unsigned char* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace

std::string_view kernel_file(std::string_view path) {
${lines}  throw std::out_of_range(\"no file kernels/\" + std::string(path));
}

}  // namespace swage
")

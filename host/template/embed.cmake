# Writes OUTPUT: shipped_files() with the FILES of FOLDER as arrays of bytes, by their stems.
set(arrays "")
set(lines "")
foreach(file IN LISTS FILES)
  file(READ ${FOLDER}/${file} bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  cmake_path(GET file STEM stem)
  string(MAKE_C_IDENTIFIER ${stem} name)
  string(APPEND arrays "constexpr unsigned char ${name}[] = {${bytes} 0};\n")
  string(APPEND lines "      {\"${stem}\", text(${name}, sizeof ${name} - 1)},\n")
endforeach()

file(WRITE ${OUTPUT} "// Made by host/template/embed.cmake.
#include \"shipped.h\"

namespace swage {
namespace {

${arrays}
std::string_view text(const unsigned char* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace

const std::map<std::string_view, std::string_view>& shipped_files() {
  static const std::map<std::string_view, std::string_view> files = {
${lines}  };
  return files;
}

}  // namespace swage
")

# Writes OUTPUT: font_file() with the bytes of FONT.
file(READ ${FONT} bytes HEX)
string(REGEX REPLACE "(................................................................)" "\\1\n" bytes "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")

file(WRITE ${OUTPUT} "// Made by host/render/embed_font.cmake.
#include \"text.h\"

namespace swage {
namespace {

constexpr unsigned char kFont[] = {
${bytes}};

}  // namespace

std::span<const unsigned char> font_file() { return kFont; }

}  // namespace swage
")

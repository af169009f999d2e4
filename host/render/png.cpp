#include <cstdlib>
#include <new>

#include "swage/error.h"
#include "swage/mesh_io.h"
#include "swage/render.h"

namespace {

// stb does not look whether it got what it asked for.
void* again_or_throw(void* old, std::size_t size) {
  void* const memory = std::realloc(old, size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

#define STBIW_MALLOC(size) again_or_throw(nullptr, size)
#define STBIW_REALLOC(old, size) again_or_throw(old, size)
#define STBIW_FREE(memory) std::free(memory)
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

namespace swage {

std::string png(const Image& image) {
  const size_t bytes =
      3 * static_cast<size_t>(std::max(0, image.width)) * static_cast<size_t>(std::max(0, image.height));
  if (bytes == 0 || image.rgb.size() != bytes) {
    throw InvalidInput("png: image: " + std::to_string(image.rgb.size()) + " bytes are no picture of " +
                       std::to_string(image.width) + " x " + std::to_string(image.height) +
                       " pixels; give three a pixel");
  }
  std::string content;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<size_t>(size));
  };
  const int done =
      stbi_write_png_to_func(append, &content, image.width, image.height, 3, image.rgb.data(), 3 * image.width);
  if (done == 0) throw std::bad_alloc();
  return content;
}

void write_png(const std::filesystem::path& path, const Image& image) { write_file(path, png(image)); }

}  // namespace swage

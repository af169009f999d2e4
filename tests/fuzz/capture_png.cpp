// Painted spheres, PNG.
#include "fuzz.h"
#include "png_file.h"
#include "sphere_map.h"
#include "swage/style_io.h"

namespace swage::fuzz {

void use(std::string_view bytes) {
  if (takes_long(bytes, 1 << 12)) return;
  const std::filesystem::path path = file_of(".png", bytes);
  for (const CaptureLayout layout : {CaptureLayout::equirectangular, CaptureLayout::hemispheres}) {
    const auto map = unless_refused<UnreadableFile, InvalidInput>([&] { return read_normal_capture(path, layout); });
    if (map) require_sphere(*map);
  }
}

}  // namespace swage::fuzz

// Curvatures, .fk files.
#include "swage/curvature.h"

#include "fuzz.h"

void swage::fuzz::use(std::string_view bytes) {
  constexpr int kTriangles = 3;
  const auto curvatures =
      unless_refused<UnreadableFile>([&] { return read_unit_box_curvatures(file_of(".fk", bytes), kTriangles); });
  if (!curvatures) return;
  require(curvatures->rows() == kTriangles && curvatures->allFinite(), "each triangle has two finite curvatures");
}

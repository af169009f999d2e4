// Curvature files.
#include <cmath>

#include "scanner.h"
#include "swage/curvature.h"

namespace swage {

Curvatures read_unit_box_curvatures(const std::filesystem::path& path, int triangle_count) {
  const Input input = slurp(path);
  require_text(input);
  Scanner scan(input, text_begin(input));
  const std::string expected = "one line a triangle, " + std::to_string(triangle_count) + " in all, is expected";
  Curvatures curvatures(triangle_count, 2);
  int triangle = 0;
  for (; !scan.at_end(); scan.skip_line()) {
    if (scan.at_line_end()) continue;
    if (triangle == triangle_count) refuse(input, scan.at(), expected + ", but there are more; is it of another mesh?");
    for (int k = 0; k < 2; ++k) {
      Slot slot;
      scan.skip_blanks();
      curvatures(triangle, k) = scan.number(slot, "a curvature (a triangle has two)");
      if (!std::isfinite(curvatures(triangle, k))) refuse(input, slot.offset, "a curvature is not finite; mend it");
    }
    if (!scan.at_line_end()) refuse(input, scan.at(), "more than two curvatures stand on a line; mend it");
    ++triangle;
  }
  if (triangle < triangle_count) {
    refuse(input, scan.at(), expected + ", but there are " + std::to_string(triangle) + "; is it of another mesh?");
  }
  return curvatures;
}

}  // namespace swage

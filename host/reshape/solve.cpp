#include "swage/error.h"
#include "swage/reshape.h"
namespace swage {
struct Reshape::Plan {};
Reshape::Reshape(const PositionsRef&, const TrianglesRef&, const ReshapeOptions&, const ProgressFn&) {}
Reshape::~Reshape() = default;
Reshape::Reshape(Reshape&&) noexcept = default;
Reshape& Reshape::operator=(Reshape&&) noexcept = default;
ReshapeResult Reshape::solve(const Gesture&, const ProgressFn&) { throw Unavailable("not yet"); }
ReshapeResult reshape(const PositionsRef& p, const TrianglesRef& t, const Gesture& g, const ReshapeOptions& o,
                      const ProgressFn& f) {
  return Reshape(p, t, o, f).solve(g, f);
}
}  // namespace swage

// Stands in for host/render where the build leaves it out.
#include "swage/error.h"
#include "swage/render.h"
#include "swage/style_io.h"

namespace swage {
namespace {

[[noreturn]] void refuse(const char* function) {
  throw Unavailable(std::string(function) +
                    ": this build neither makes nor reads pictures; configure with -DSWAGE_RENDER=ON");
}

}  // namespace

bool can_render() { return false; }

std::vector<HandleMark> handle_marks(const Gesture&, const PositionsRef&, bool) { refuse("handle_marks"); }

Image render(const std::vector<Panel>&, const RenderOptions&, const ProgressFn&) { refuse("render"); }

Image contact_sheet(const std::vector<SheetRow>&, const std::vector<std::string>&, const RenderOptions&,
                    const ProgressFn&) {
  refuse("contact_sheet");
}

View automatic_view(const Mesh&, const std::vector<HandleMark>&, const Eigen::Vector3d&) { refuse("automatic_view"); }

std::string png(const Image&) { refuse("png"); }

void write_png(const std::filesystem::path&, const Image&) { refuse("write_png"); }

NormalPicture read_normal_picture(const std::filesystem::path&) { refuse("read_normal_picture"); }

}  // namespace swage

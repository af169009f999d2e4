#include "calls.h"
#include "swage/render.h"
#include "swage/style_io.h"

namespace swage::test {
namespace {

Panel panel(const Mesh& mesh = cube) { return {mesh, {}, {}, {}, {}}; }

Panel with_values(Eigen::Index count) {
  Panel made = panel();
  made.face_values = Eigen::VectorXd::Zero(count);
  return made;
}

Panel with_mark(double x) {
  Panel made = panel();
  made.handles = {{{x, 0, 0}, {0, 0, 0}, false}};
  return made;
}

Image render_with(const RenderOptions& options) { return render({panel()}, options); }

}  // namespace

std::vector<Call> picture_calls() {
  return {
      CALL(render({})),
      CALL(render({panel(Mesh{rows(3), rows<Triangles>(1, 0, 3)})})),
      CALL(render({panel(point)})),
      CALL(render({with_values(8)})),
      CALL(render({with_mark(nan)})),
      CALL(render_with(with(&RenderOptions::width, 63))),
      CALL(render_with(with(&RenderOptions::height, 16385))),
      CALL(render_with(with(&RenderOptions::feature_angle, 4))),
      CALL(render_with(with(&RenderOptions::supersampling, 0))),
      CALL(render_with(with(&RenderOptions::ambient_rays, 65))),
      CALL(render_with(with(&RenderOptions::columns, -1))),
      CALL(render_with(with(&RenderOptions::up, Eigen::Vector3d(0, 0, 0)))),
      CALL(render_with(with(&RenderOptions::heat_map, HeatMap{1, 0, {}}))),
      CALL(render_with(with(&RenderOptions::view, View{{0, 0, 0}, {0, 1, 0}}))),
      CALL(contact_sheet({})),
      CALL(contact_sheet({{"", {}, {}}})),
      CALL(contact_sheet({{"", {panel()}, {}}}, {"one", "two"})),
      CALL(automatic_view(cube, {}, {0, 0, 0})),
      CALL(png(Image{2, 2, {0}})),
      CALL(read_normal_picture("missing.png")),
  };
}

}  // namespace swage::test

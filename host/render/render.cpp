#include "swage/render.h"

#include <cmath>
#include <limits>

#include "draw.h"
#include "framing.h"
#include "heat.h"
#include "layout.h"
#include "lines.h"
#include "marks.h"
#include "messages.h"
#include "swage/error.h"
#include "text.h"

namespace swage {
namespace {

constexpr int kSmallest = 64, kLargest = 16384;

void refuse_unless(bool good, const char* function, const std::string& why) {
  if (!good) throw InvalidInput(std::string(function) + ": " + why);
}

void check_available(const char* function) {
  if (!has_embree()) {
    throw Unavailable(std::string(function) + ": this build has no Embree; configure with -DSWAGE_EMBREE=ON");
  }
}

void check_options(const RenderOptions& options, const char* function) {
  const auto check_range = [&](const char* name, double value, double low, double high) {
    refuse_unless(value >= low && value <= high, function,
                  std::string("options.") + name + ": " + digits(value) + " is not in [" + digits(low) + ", " +
                      digits(high) + "]");
  };
  check_range("width", options.width, kSmallest, kLargest);
  check_range("height", options.height, kSmallest, kLargest);
  check_range("feature_angle", options.feature_angle, 0, std::numbers::pi);
  check_range("supersampling", options.supersampling, 1, 8);
  check_range("ambient_rays", options.ambient_rays, 0, 64);
  check_range("columns", options.columns, 0, 1000);
  refuse_unless(options.up.allFinite() && options.up.norm() > 0, function,
                "options.up: it is zero or not finite; give a direction");
  if (!options.heat_map) return;
  const auto [low, high, label] = *options.heat_map;
  refuse_unless(std::isfinite(low) && std::isfinite(high) && low < high, function,
                "options.heat_map: low and high are not finite, or low is not below high; mend them");
}

/// Of all face values.
struct Values {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool any = false;

  void add(const Panel& panel) {
    any = any || panel.face_values.size() > 0;
    for (const double value : panel.face_values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  HeatMap heat_map(const std::optional<HeatMap>& given) const {
    if (given) return *given;
    if (!(low <= high)) return {};
    return low < high ? HeatMap{low, high, {}} : HeatMap{low, low + std::max(1.0, std::abs(low)), {}};
  }
};

/// Everything but the panels.
void draw_writings(Image& image, const Layout& layout) {
  for (const Writing& writing : layout.writings) {
    draw_text_within(image, writing.room, writing.at, writing.text, writing.size,
                     writing.is_faint ? palette::kFaintText : palette::kText,
                     writing.is_centred ? Align::middle : Align::left);
  }
}

struct Footing {
  Values values;
  MarkKinds kinds;
  bool any() const { return values.any || kinds.any(); }
};

void draw_footer(Image& image, const Layout& layout, const Footing& footing, const HeatMap& heat) {
  const PixelBox& footer = layout.footer;
  const double unit = layout.unit;
  const auto bar_top = static_cast<int>(footer.y + 34 * unit), bar_height = std::max(4, static_cast<int>(14 * unit));
  if (footing.values.any) {
    const auto width = static_cast<int>(footer.width * 0.36);
    const PixelBox bar{footer.x + (footer.width - width) / 2, bar_top, width, bar_height};
    draw_colour_bar(image, bar, heat, footing.values.high > heat.high * (1 + 1e-9), 17 * unit);
  }
  if (footing.kinds.any()) {
    draw_mark_legend(image, {footer.x + 12 * unit, bar_top + bar_height / 2.0}, footing.kinds, unit);
  }
}

/// What one panel is drawn with.
struct PanelTask {
  const Panel& panel;
  const Framing& framing;
  PixelBox box;
  double scale, unit;
};

bool draw_panel(Image& image, const PanelTask& task, const RenderOptions& options, const HeatMap& heat,
                const Watch& watch) {
  if (!watch.goes_on("prepare", 0)) return false;
  const RenderScene scene = scene_of(task.panel, task.framing.box, options.feature_angle, heat);
  Camera camera = task.framing.camera;
  camera.scale = task.scale;
  const double line_width = std::max(1.2, 1.5 * task.unit);
  const SurfaceView view{
      scene, camera, task.box, options.supersampling, options.ambient_rays, options.feature_lines ? line_width : 0};
  long covered = 0;
  if (!draw_surface(image, view, covered, watch.part(0.1, 0.9))) return false;
  if (options.feature_lines && !draw_lines(image, view, covered, line_width, watch.part(0.9, 1))) return false;
  const auto pixel_of = [&](const Eigen::Vector3d& point) -> Eigen::Vector2d {
    return task.box.middle() + camera.project(into(task.framing.box, point));
  };
  draw_marks(image, task.panel.handles, pixel_of, mark_radius(task.panel.handles.size(), task.unit));
  return true;
}

/// What both kinds of pictures are made of: groups of panels that share a view.
struct Group {
  const SheetRow& row;
  Framing framing;
};

Framing framing_of_row(const SheetRow& row, const RenderOptions& options, const char* function) {
  const Panel& first = row.panels.front();
  seen_positions(row.panels, function);  // Refused in this function's name.
  View view;
  if (row.view) {
    view = *row.view;
  } else {
    view = options.view ? *options.view : automatic_view(first.mesh, first.handles, options.up);
  }
  return framing_of(row.panels, view, function);
}

Image compose(const std::vector<Group>& groups, const Layout& layout, const RenderOptions& options,
              const Footing& footing, const ProgressFn& progress) {
  const size_t pixels = static_cast<size_t>(layout.width) * static_cast<size_t>(layout.height);
  Image image{layout.width, layout.height, std::vector<unsigned char>(3 * pixels, 255)};
  const HeatMap heat = footing.values.heat_map(options.heat_map);
  const Watch watch{progress};
  double total = 0, done = 0;
  for (const Group& group : groups) total += static_cast<double>(group.row.panels.size());
  for (size_t g = 0; g < groups.size(); ++g) {
    const std::vector<PixelBox>& boxes = layout.panels[g];
    const Framing& framing = groups[g].framing;
    const double scale = fitting_scale(framing.extent, boxes.front(), 14 * layout.unit);
    for (size_t p = 0; p < boxes.size(); ++p, ++done) {
      const PanelTask task{groups[g].row.panels[p], framing, boxes[p], scale, layout.unit};
      if (!draw_panel(image, task, options, heat, watch.part(done / total, (done + 1) / total))) return {};
    }
  }
  draw_writings(image, layout);
  if (footing.any()) draw_footer(image, layout, footing, heat);
  return watch.goes_on("picture", 1) ? std::move(image) : Image();
}

/// Checks the rows' panels and sees what they need.
std::pair<std::vector<Group>, Footing> groups_of(const std::vector<SheetRow>& rows, const RenderOptions& options,
                                                 const char* function) {
  check_available(function);
  check_options(options, function);
  Footing footing;
  std::vector<Group> groups;
  for (const SheetRow& row : rows) {
    refuse_unless(!row.panels.empty(), function, "there is no panel to draw; give one");
    for (size_t p = 0; p < row.panels.size(); ++p) {
      check_panel(row.panels[p], p, function);
      footing.values.add(row.panels[p]);
      footing.kinds.add(row.panels[p].handles);
    }
    groups.push_back({row, framing_of_row(row, options, function)});
  }
  return {std::move(groups), footing};
}

GroupShape shape_of(const Group& group) { return {group.row.panels, group.row.title, group.framing.extent}; }

}  // namespace

bool can_render() { return has_embree(); }

Image render(const std::vector<Panel>& panels, const RenderOptions& options, const ProgressFn& progress) {
  const std::vector<SheetRow> rows{{{}, panels, {}}};
  const auto [groups, footing] = groups_of(rows, options, "render");
  const Layout layout = grid_layout(shape_of(groups.front()), options, footing.any());
  return compose(groups, layout, options, footing, progress);
}

Image contact_sheet(const std::vector<SheetRow>& rows, const std::vector<std::string>& columns,
                    const RenderOptions& options, const ProgressFn& progress) {
  refuse_unless(!rows.empty(), "contact_sheet", "there is no row to draw; give one");
  const auto [groups, footing] = groups_of(rows, options, "contact_sheet");
  size_t longest = 0;
  std::vector<GroupShape> shapes;
  for (const Group& group : groups) {
    longest = std::max(longest, group.row.panels.size());
    shapes.push_back(shape_of(group));
  }
  refuse_unless(columns.empty() || columns.size() == longest, "contact_sheet",
                "columns: " + std::to_string(columns.size()) + " titles of " + std::to_string(longest) +
                    " columns; give one for each");
  return compose(groups, rows_layout(shapes, columns, options, footing.any()), options, footing, progress);
}

}  // namespace swage

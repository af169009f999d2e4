#include "layout.h"

#include <algorithm>
#include <cmath>

namespace swage {
namespace {

// In units.
constexpr double kEdge = 20, kGap = 12, kTitle = 27, kPanelTitle = 22, kCaption = 18, kFooter = 88;
constexpr double kLine = 1.7;  // Height of a line of text over its size.

int pixels(double length) { return static_cast<int>(std::lround(length)); }

/// No larger than lets the footer's parts stand beside each other, and meshes be larger than dots and words.
double unit_of(double width, double height) {
  return std::clamp(std::min({std::sqrt(width * height / (1600.0 * 900.0)), width / 1000, height / 500}), 0.4, 8.0);
}

/// Places panels and their texts in cells, and lines of text from the top.
class Placing {
 public:
  Placing(int width, double unit) : y_(kEdge * unit) {
    layout_.width = width;
    layout_.unit = unit;
  }

  double room() const { return layout_.width - 2 * kEdge * layout_.unit; }

  void add_title(const std::string& text) {
    if (!text.empty()) add_line({{text, {layout_.width / 2.0, 0}, kTitle, room(), true, false}});
  }

  void add_row_title(const std::string& text) {
    if (!text.empty()) add_line({{text, {kEdge * layout_.unit, 0}, kPanelTitle, room(), false, false}});
  }

  void add_column_titles(const std::vector<std::string>& columns) {
    std::vector<Writing> line;
    const double width = room() / static_cast<double>(columns.size());
    for (size_t c = 0; c < columns.size(); ++c) {
      line.push_back(
          {columns[c], {kEdge * layout_.unit + (double(c) + 0.5) * width, 0}, kPanelTitle, width, true, false});
    }
    if (!line.empty()) add_line(line);
  }

  /// Panels in a grid of cells, `height` for all of them.
  void add_cells(const std::vector<Panel>& panels, int columns, double height) {
    const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
    const double width = room() / columns, row_height = height / rows;
    const auto [title, caption] = lines_of(panels);
    std::vector<PixelBox>& boxes = layout_.panels.emplace_back();
    for (size_t i = 0; i < panels.size(); ++i) {
      const int row = static_cast<int>(i) / columns, column = static_cast<int>(i) % columns;
      const double x = kEdge * layout_.unit + column * width, y = y_ + row * row_height, gap = kGap * layout_.unit;
      add_writing({panels[i].title, {x + width / 2, y}, kPanelTitle, width - 2 * gap, true, false});
      add_writing({panels[i].caption, {x + width / 2, y + title}, kCaption, width - 2 * gap, true, true});
      boxes.push_back({pixels(x + gap), pixels(y + title + caption), std::max(1, pixels(width - 2 * gap)),
                       std::max(1, pixels(row_height - title - caption))});
    }
    y_ += height;
  }

  /// Heights that titles and captions take of a cell, pixels.
  std::pair<double, double> lines_of(const std::vector<Panel>& panels) const {
    const auto any = [&](std::string Panel::*text) {
      return std::any_of(panels.begin(), panels.end(), [&](const Panel& panel) { return !(panel.*text).empty(); });
    };
    const double line = kLine * layout_.unit;
    return {any(&Panel::title) ? line * kPanelTitle : 0, any(&Panel::caption) ? line * kCaption : 0};
  }

  double y() const { return y_; }

  Layout finish(int height, double footer) {
    layout_.height = height;
    const int top = pixels(height - footer);
    layout_.footer = {pixels(kEdge * layout_.unit), top, pixels(room()), footer > 0 ? height - top : 0};
    return std::move(layout_);
  }

 private:
  /// `writing` in units, its place above the line of text.
  void add_writing(Writing writing) {
    if (writing.text.empty()) return;
    writing.size *= layout_.unit;
    writing.at.y() += 1.1 * writing.size;
    layout_.writings.push_back(std::move(writing));
  }

  void add_line(const std::vector<Writing>& line) {
    for (Writing writing : line) {
      writing.at.y() = y_;
      add_writing(std::move(writing));
    }
    y_ += kLine * line.front().size * layout_.unit;
  }

  Layout layout_;
  double y_;
};

/// As many as make what is shown largest.
int best_columns(const GroupShape& group, const Placing& placing, double height) {
  const auto [title, caption] = placing.lines_of(group.panels);
  const auto count = static_cast<int>(group.panels.size());
  int best = 1;
  double largest = -1e9;
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    const double scale =
        std::min(placing.room() / columns / group.extent.x(), (height / rows - title - caption) / group.extent.y());
    if (scale > largest * (1 + 1e-9)) {
      largest = scale;
      best = columns;
    }
  }
  return best;
}

}  // namespace

Layout grid_layout(const GroupShape& group, const RenderOptions& options, bool has_footer) {
  const double unit = unit_of(options.width, options.height), footer = has_footer ? kFooter * unit : 0;
  Placing placing(options.width, unit);
  placing.add_title(options.title);
  const double height = options.height - placing.y() - std::max(footer, kEdge * unit);
  const int asked = std::min(options.columns, static_cast<int>(group.panels.size()));
  placing.add_cells(group.panels, asked > 0 ? asked : best_columns(group, placing, height), height);
  return placing.finish(options.height, footer);
}

Layout rows_layout(const std::vector<GroupShape>& groups, const std::vector<std::string>& columns,
                   const RenderOptions& options, bool has_footer) {
  size_t longest = 1;
  for (const GroupShape& group : groups) longest = std::max(longest, group.panels.size());
  const double unit = std::clamp(std::min(options.width / 1600.0, options.height / 250.0), 0.4, 8.0);
  Placing placing(options.width, unit);
  placing.add_title(options.title);
  placing.add_column_titles(columns);
  for (const GroupShape& group : groups) {
    const double top = placing.y();
    placing.add_row_title(group.title);
    placing.add_cells(group.panels, static_cast<int>(longest), options.height - (placing.y() - top));
  }
  const double footer = has_footer ? kFooter * unit : kEdge * unit;
  return placing.finish(pixels(placing.y() + footer), has_footer ? footer : 0);
}

}  // namespace swage

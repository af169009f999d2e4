#include "picture.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "edit.h"
#include "failure.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

std::vector<double> numbers_in(const std::string& text, char separator) {
  std::vector<double> numbers;
  for (const std::string& part : CLI::detail::split(text, separator)) {
    double number = 0;
    if (!CLI::detail::lexical_cast(part, number) || !std::isfinite(number)) return {};
    numbers.push_back(number);
  }
  return numbers;
}

Eigen::Vector3d axis_named(const std::string& name) { return Eigen::Vector3d::Unit(name[0] - 'x'); }

}  // namespace

double rounded_up(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (value <= factor * power * (1 + 1e-9)) return factor * power;
  }
  return 10 * power;
}

CLI::Option* add_picture_option(CLI::App& app, PictureOptions& options, const std::string& help) {
  return app.add_option("--picture", options.path, help)->group("Picture")->type_name("FILE.png");
}

std::vector<CLI::Option*> add_eye_options(CLI::App& app, PictureOptions& options, const char* size_option) {
  const std::string group = "Picture";
  options.size_option = size_option;
  CLI::Option* view = app.add_option("--view", options.view, "Direction towards the eye (one that shows most)")
                          ->type_name("X,Y,Z")
                          ->group(group);
  return {view, app.add_option(size_option, options.size, "Pixels (1600x900)")->type_name("WxH")->group(group)};
}

std::vector<CLI::Option*> add_view_options(CLI::App& app, PictureOptions& options, const char* size_option) {
  std::vector<CLI::Option*> all = add_eye_options(app, options, size_option);
  all.push_back(app.add_option("--up", options.up, "The axis that is up: x, y or z (y)")
                    ->check(CLI::IsMember({"x", "y", "z"}))
                    ->type_name("AXIS")
                    ->group("Picture"));
  return all;
}

void check(const PictureOptions& options, const char* option) {
  if (options.path.empty()) return;
  if (!options.path.ends_with(".png")) throw WrongUsage(fmt::format("{} {}: name a .png file", option, options.path));
  check_can_be_written(options.path, option);
  render_options_of(options);
  if (!can_render()) {
    throw Unavailable(std::string(option) +
                      ": this build makes no pictures; configure with -DSWAGE_RENDER=ON -DSWAGE_EMBREE=ON");
  }
}

RenderOptions render_options_of(const PictureOptions& options) {
  return render_options_of(options, axis_named(options.up));
}

RenderOptions render_options_of(const PictureOptions& options, const Eigen::Vector3d& up) {
  RenderOptions render;
  render.up = up;
  const std::vector<double> size = numbers_in(options.size, 'x');
  const auto is_side = [](double side) { return side >= 64 && side <= 16384 && side == std::floor(side); };
  if (size.size() != 2 || !is_side(size[0]) || !is_side(size[1])) {
    throw WrongUsage(fmt::format("{} {}: give width x height in pixels, 64 to 16384 each, such as 1600x900",
                                 options.size_option, options.size));
  }
  render.width = static_cast<int>(size[0]);
  render.height = static_cast<int>(size[1]);
  if (options.view.empty()) return render;
  const std::vector<double> view = numbers_in(options.view, ',');
  if (view.size() != 3 || (view[0] == 0 && view[1] == 0 && view[2] == 0)) {
    throw WrongUsage(
        fmt::format("--view {}: give the direction towards the eye as three numbers, such as 1,0.5,2", options.view));
  }
  render.view = View{{view[0], view[1], view[2]}, render.up};
  return render;
}

Image drawn(const std::vector<Panel>& panels, const RenderOptions& options, const CommonOptions& common) {
  Image image = with_progress(common, [&](const ProgressFn& progress) { return render(panels, options, progress); });
  stop_if_interrupted();
  return image;
}

Image drawn(const std::vector<SheetRow>& rows, const std::vector<std::string>& columns, const RenderOptions& options,
            const CommonOptions& common) {
  Image image = with_progress(
      common, [&](const ProgressFn& progress) { return contact_sheet(rows, columns, options, progress); });
  stop_if_interrupted();
  return image;
}

}  // namespace swage::cli

#include "picture.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "failure.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "report_json.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

/// A measure as colours.
struct Heat {
  const char* name;
  const char* label;
  Eigen::VectorXd FaceChanges::*faces;
  Spread Comparison::*spread;
  bool is_angle;
  double smallest_high;  ///< Of the colour bar, so that nothing much does not look like much.
};

constexpr std::array<Heat, 5> kHeats{
    {{"normals", "turn of normals, degrees", &FaceChanges::turn, &Comparison::turn, true, 5},
     {"size", "change of size, |ln| of scale", &FaceChanges::size, &Comparison::size, false, 0.1},
     {"slippage", "slippage loss", &FaceChanges::slippage_loss, &Comparison::slippage_loss, false, 0.5},
     {"uneven", "uneven stretch, ln of ratio", &FaceChanges::uneven, &Comparison::uneven, false, 0.1},
     {"shear", "shear, degrees", &FaceChanges::shear, &Comparison::shear, true, 5}}};

/// Null for none.
const Heat* heat_named(const std::string& name) {
  const auto* at = std::find_if(kHeats.begin(), kHeats.end(), [&](const Heat& heat) { return heat.name == name; });
  return at == kHeats.end() ? nullptr : at;
}

double in_words(const Heat& heat, double value) { return heat.is_angle ? degrees(value) : value; }

/// The next of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten.
double rounded_up(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (value <= factor * power * (1 + 1e-9)) return factor * power;
  }
  return 10 * power;
}

HeatMap scale_of(const Heat& heat, const std::vector<PictureEdit>& edits) {
  double high = heat.smallest_high;
  for (const PictureEdit& edit : edits) {
    high = std::max(high, in_words(heat, (edit.changes.*heat.spread).percentile_95));
  }
  return {0, rounded_up(high), heat.label};
}

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

RenderOptions render_options_of(const PictureOptions& options) {
  RenderOptions render;
  render.up = axis_named(options.up);
  const std::vector<double> size = numbers_in(options.size, 'x');
  const auto is_side = [](double side) { return side >= 64 && side <= 16384 && side == std::floor(side); };
  if (size.size() != 2 || !is_side(size[0]) || !is_side(size[1])) {
    throw WrongUsage(
        fmt::format("--size {}: give width x height in pixels, 64 to 16384 each, such as 1600x900", options.size));
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

/// Stems of the paths or, where two are the same, with the folders that they are in.
std::vector<std::string> titles_of(const std::vector<PictureEdit>& edits) {
  std::multiset<std::string> stems;
  const auto stem = [](const std::filesystem::path& path) { return path.stem().string(); };
  for (const PictureEdit& edit : edits) stems.insert(stem(edit.path));
  std::vector<std::string> titles;
  for (const PictureEdit& edit : edits) {
    const std::string folder = std::filesystem::path(edit.path).parent_path().filename().string();
    const bool is_clear = stems.count(stem(edit.path)) == 1 || folder.empty();
    titles.push_back(is_clear ? stem(edit.path) : folder + "/" + stem(edit.path));
  }
  return titles;
}

std::string caption_of(const Heat& heat, const Comparison& changes) {
  const Spread& spread = changes.*heat.spread;
  const char* sign = heat.is_angle ? "°" : "";
  const int digits = heat.is_angle ? 1 : 3;
  return fmt::format("mean {:.{}f}{}, 95 % below {:.{}f}{}", in_words(heat, spread.mean), digits, sign,
                     in_words(heat, spread.percentile_95), digits, sign);
}

Eigen::VectorXd values_of(const Heat& heat, const Comparison& changes) {
  return (changes.faces.*heat.faces).cwiseAbs() * in_words(heat, 1);
}

}  // namespace

void add_picture_options(CLI::App& app, PictureOptions& options) {
  const std::string group = "Picture";
  CLI::Option* picture =
      app.add_option("--picture", options.path, "The rest and its edits side by side, with a heat map on the edits")
          ->group(group)
          ->type_name("FILE.png");
  app.add_option("--heat", options.heat,
                 "What the colours tell: normals, size, slippage, uneven, shear or none (normals)")
      ->check(CLI::IsMember({"normals", "size", "slippage", "uneven", "shear", "none"}))
      ->type_name("NAME")
      ->group(group)
      ->needs(picture);
  app.add_option("--view", options.view, "Direction towards the eye (one that shows most)")
      ->type_name("X,Y,Z")
      ->group(group)
      ->needs(picture);
  app.add_option("--up", options.up, "The axis that is up: x, y or z (y)")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->type_name("AXIS")
      ->group(group)
      ->needs(picture);
  app.add_option("--size", options.size, "Pixels (1600x900)")->type_name("WxH")->group(group)->needs(picture);
}

void check(const PictureOptions& options) {
  if (options.path.empty()) return;
  if (!options.path.ends_with(".png")) throw WrongUsage(fmt::format("--picture {}: name a .png file", options.path));
  check_can_be_written(options.path, "--picture");
  render_options_of(options);
  if (!can_render()) {
    throw Unavailable("--picture: this build makes no pictures; configure with -DSWAGE_RENDER=ON -DSWAGE_EMBREE=ON");
  }
}

Image picture_of(const PictureOptions& options, const std::string& rest_path, const Mesh& rest,
                 const std::vector<PictureEdit>& edits, const std::optional<Gesture>& gesture,
                 const CommonOptions& common) {
  const Heat* heat = heat_named(options.heat);
  RenderOptions render_options = render_options_of(options);
  if (heat) render_options.heat_map = scale_of(*heat, edits);
  const auto marks = [&](bool reached) {
    return gesture ? handle_marks(*gesture, rest.positions, reached) : std::vector<HandleMark>();
  };
  std::vector<Panel> panels{{rest, std::filesystem::path(rest_path).stem().string(), marks(false), {}, "before"}};
  const std::vector<std::string> titles = titles_of(edits);
  for (size_t e = 0; e < edits.size(); ++e) {
    Panel panel{{edits[e].positions, rest.triangles}, titles[e], marks(true), {}, {}};
    if (heat) {
      panel.face_values = values_of(*heat, edits[e].changes);
      panel.caption = caption_of(*heat, edits[e].changes);
    }
    panels.push_back(std::move(panel));
  }
  ProgressBar bar(!common.quiet && !common.verbose);
  Image image = render(panels, render_options, [&](const Progress& now) {
    bar.show(now);
    return !interrupted();
  });
  stop_if_interrupted();
  return image;
}

}  // namespace swage::cli

#include "compare_picture.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "report_json.h"

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

HeatMap scale_of(const Heat& heat, const std::vector<PictureEdit>& edits) {
  double high = heat.smallest_high;
  for (const PictureEdit& edit : edits) {
    high = std::max(high, in_words(heat, (edit.changes.*heat.spread).percentile_95));
  }
  return {0, rounded_up(high), heat.label};
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

void add_heat_option(CLI::App& app, std::string& heat, CLI::Option& picture) {
  app.add_option("--heat", heat, "What the colours tell: normals, size, slippage, uneven, shear or none (normals)")
      ->check(CLI::IsMember({"normals", "size", "slippage", "uneven", "shear", "none"}))
      ->type_name("NAME")
      ->group("Picture")
      ->needs(&picture);
}

Image picture_of(const PictureOptions& options, const std::string& heat_name, const std::string& rest_path,
                 const Mesh& rest, const std::vector<PictureEdit>& edits, const std::optional<Gesture>& gesture,
                 const CommonOptions& common) {
  const Heat* heat = heat_named(heat_name);
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
  return drawn(panels, render_options, common);
}

}  // namespace swage::cli

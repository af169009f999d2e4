#include "gesture_options.h"

#include <spdlog/fmt/fmt.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cmath>
#include <filesystem>
#include <utility>

#include "failure.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

Selection selection(const std::string& text, const char* option) {
  try {
    return Selection(text);
  } catch (const InvalidInput& e) {
    throw WrongUsage(fmt::format("{} {}: {}", option, text, e.what()));
  }
}

/// "dx,dy,dz"
Eigen::RowVector3d displacement(const std::string& text, const std::string& move) {
  const std::vector<std::string> parts = CLI::detail::split(text, ',');
  Eigen::RowVector3d result;
  bool good = parts.size() == 3;
  for (size_t i = 0; good && i < 3; ++i) {
    good = CLI::detail::lexical_cast(parts[i], result[static_cast<Eigen::Index>(i)]);
  }
  if (good && result.allFinite()) return result;
  throw WrongUsage(fmt::format("--move {}: '{}' is no displacement: write SELECT=dx,dy,dz, in mesh units", move, text));
}

/// FILE and LABEL. Either may hold colons: the longest FILE that exists is taken.
std::pair<std::string, std::string> split_gesture(const std::string& text) {
  size_t colon = text.rfind(':');
  const size_t last = colon;
  while (colon != std::string::npos && colon > 0) {
    if (std::filesystem::exists(text.substr(0, colon))) break;
    colon = text.rfind(':', colon - 1);
  }
  if (colon == std::string::npos || colon == 0) colon = last;
  return {text.substr(0, colon), text.substr(colon + 1)};
}

std::string labels(const std::vector<Gesture>& gestures) {
  std::string text;
  for (const Gesture& gesture : gestures) text += (text.empty() ? "" : ", ") + gesture.label;
  return text;
}

Gesture only_gesture(const std::string& path, std::vector<Gesture> gestures) {
  if (gestures.size() == 1) return std::move(gestures.front());
  throw InvalidInput(fmt::format("{} holds {} gestures: choose one as --gesture {}:LABEL, of {}", path, gestures.size(),
                                 path, labels(gestures)));
}

Gesture labelled_gesture(const std::string& path, const std::string& label, const std::vector<Gesture>& gestures) {
  for (const Gesture& gesture : gestures) {
    if (gesture.label == label) return gesture;
  }
  throw InvalidInput(fmt::format("{} holds no gesture {}: choose one of {}", path, label, labels(gestures)));
}

Gesture read_gesture(const std::string& text, const Positions& rest) {
  if (std::filesystem::exists(text) || text.find(':') == std::string::npos) {
    return only_gesture(text, read_gestures(text, rest));
  }
  const auto [path, label] = split_gesture(text);
  return labelled_gesture(path, label, read_gestures(path, rest));
}

}  // namespace

bool asks_for_handles(const GestureOptions& options) {
  return !options.gesture.empty() || !options.pins.empty() || !options.moves.empty();
}

void add_gesture_options(CLI::App& app, GestureOptions& options) {
  const std::string group = "Handles";
  app.add_option("--gesture", options.gesture, "A gesture of a .deform file; LABEL where it holds several")
      ->group(group)
      ->type_name("FILE[:LABEL]");
  app.add_option("--pin", options.pins, "Vertices that stay, such as 12,40-52 or y<=5%; may be repeated")
      ->group(group)
      ->allow_extra_args(false)
      ->type_name("SELECT");
  app.add_option("--move", options.moves, "Vertices that move by dx,dy,dz, mesh units; may be repeated")
      ->group(group)
      ->allow_extra_args(false)
      ->type_name("SELECT=dx,dy,dz");
}

GestureRecipe::GestureRecipe(const GestureOptions& options) : file_(options.gesture) {
  for (const std::string& pin : options.pins) moves_.push_back({"--pin " + pin, selection(pin, "--pin"), {0, 0, 0}});
  for (const std::string& move : options.moves) {
    const size_t equals = move.rfind('=');
    if (equals == std::string::npos) throw WrongUsage("--move " + move + ": write SELECT=dx,dy,dz, in mesh units");
    const Eigen::RowVector3d by = displacement(move.substr(equals + 1), move);
    moves_.push_back({"--move " + move, selection(move.substr(0, equals), "--move"), by});
  }
  if (file_.empty() && moves_.empty()) {
    throw WrongUsage(
        "nothing to do: say what moves with --gesture FILE, or with --pin SELECT and --move SELECT=dx,dy,dz");
  }
}

Gesture GestureRecipe::on(const MeshFile& file) const {
  const Positions& rest = file.mesh.positions;
  Gesture gesture = file_.empty() ? Gesture{} : read_gesture(file_, rest);
  for (const Move& move : moves_) {
    try {
      for (const int v : move.selection.vertices(file)) gesture.add(v, (rest.row(v) + move.displacement).transpose());
    } catch (const InvalidInput& e) {
      throw InvalidInput(move.words + ": " + e.what());
    }
  }
  return gesture;
}

}  // namespace swage::cli

#include "resize_protection.h"

#include <spdlog/fmt/fmt.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <optional>
#include <utility>

#include "failure.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

constexpr const char* kExample = "write SELECT[:axes][=value], such as 'component:3', 'x<=10%:yz' or 'group:lid:x=0.5'";

/// Where a value begins: after an equals sign that is of no relation.
std::optional<double> value_behind(const std::string& text, size_t equals) {
  if (equals == std::string::npos || equals == 0) return std::nullopt;
  if (text[equals - 1] == '<' || text[equals - 1] == '>') return std::nullopt;
  double value = 0;
  if (!CLI::detail::lexical_cast(CLI::detail::trim_copy(text.substr(equals + 1)), value)) return std::nullopt;
  return value;
}

bool are_axes(const std::string& text) { return !text.empty() && text.find_first_not_of("xyz") == std::string::npos; }

std::vector<bool> chosen_vertices(const Selection& selection, const std::optional<Eigen::AlignedBox3d>& region,
                                  const MeshFile& file) {
  const Positions& positions = file.mesh.positions;
  std::vector<bool> chosen(static_cast<size_t>(positions.rows()), false);
  if (region) {
    for (size_t v = 0; v < chosen.size(); ++v) {
      chosen[v] = region->contains(positions.row(static_cast<Eigen::Index>(v)).transpose());
    }
  } else {
    for (const int v : selection.vertices(file)) chosen[static_cast<size_t>(v)] = true;
  }
  return chosen;
}

/// With all three corners chosen.
std::vector<int> triangles_of(const Triangles& triangles, const std::vector<bool>& chosen) {
  std::vector<int> found;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const auto corner = [&](int k) { return chosen[static_cast<size_t>(triangles(t, k))]; };
    if (corner(0) && corner(1) && corner(2)) found.push_back(static_cast<int>(t));
  }
  return found;
}

}  // namespace

void add_protection_options(CLI::App& app, std::vector<ProtectionText>& protections) {
  const auto add = [&](const char* name, bool is_release, const char* type, const char* help) {
    app.add_option_function<std::string>(
           name,
           [&protections, is_release](const std::string& text) {
             protections.push_back({is_release, text});
           },
           help)
        ->group("Vulnerability")
        ->allow_extra_args(false)
        ->trigger_on_parse()  // So that both are in the order given.
        ->type_name(type);
  };
  add("--protect", false, "SELECT[:axes][=value]",
      "Where vulnerability is this, 0 to 1 (1), along axes such as x or yz (all), whatever is found: in cells that "
      "triangles with three selected corners touch and, where SELECT is a box or half spaces joined by &, in all of "
      "that region; may be repeated and mixed with --release: the last one counts");
  add("--release", true, "SELECT[:axes]", "The same with value 0: what may take any stretch");
}

ProtectionRecipe::ProtectionRecipe(const ProtectionText& text) : words_(text.words()) {
  const size_t equals = text.text.rfind('=');
  const std::optional<double> value = text.is_release ? std::nullopt : value_behind(text.text, equals);
  if (value && !(*value >= 0 && *value <= 1)) {
    throw WrongUsage(fmt::format("{}: the value {} is not from 0 to 1", words_, text.text.substr(equals + 1)));
  }
  if (value) add_readings(text.text.substr(0, equals), *value);
  add_readings(text.text, text.is_release ? 0 : 1);
  if (readings_.empty()) throw WrongUsage(fmt::format("{}: {}; {}", words_, misunderstood_, kExample));
}

void ProtectionRecipe::add_readings(const std::string& text, double value) {
  const auto add = [&](const std::string& select, const std::string& axes) {
    try {
      readings_.push_back({select, axes, value, Selection(select)});
    } catch (const InvalidInput& e) {
      if (misunderstood_.empty()) misunderstood_ = e.what();
    }
  };
  const size_t colon = text.rfind(':');
  const std::string axes = colon == std::string::npos ? "" : CLI::detail::trim_copy(text.substr(colon + 1));
  if (are_axes(axes)) add(text.substr(0, colon), axes);
  add(text, "xyz");
}

Protection ProtectionRecipe::on(const MeshFile& file) const {
  if (readings_.size() == 1) return protection(readings_.front(), file);
  std::vector<std::pair<const Reading*, Protection>> found;
  for (const Reading& reading : readings_) {
    try {
      found.emplace_back(&reading, protection(reading, file));
    } catch (const InvalidInput&) {
    } catch (const UnreadableFile&) {
    }
  }
  if (found.empty()) return protection(readings_.front(), file);  // Which says why not.
  if (found.size() == 1) return std::move(found.front().second);
  const auto &one = *found[0].first, &other = *found[1].first;
  throw WrongUsage(fmt::format(
      "{}: '{}' and '{}' both select something: write '{} & x>=0%:{}={}' for the first or "
      "'{}:{}={}' for the second",
      words_, one.select, other.select, one.select, one.axes, one.value, other.select, other.axes, other.value));
}

Protection ProtectionRecipe::protection(const Reading& reading, const MeshFile& file) const {
  Protection protection;
  try {
    protection.box = reading.selection.region(file);
    protection.triangles = triangles_of(file.mesh.triangles, chosen_vertices(reading.selection, protection.box, file));
  } catch (const InvalidInput& e) {
    throw InvalidInput(words_ + ": " + e.what());
  }
  if (protection.triangles.empty() && !protection.box) {
    throw InvalidInput(
        fmt::format("{}: no triangle of {} has all three corners selected: select more vertices, or a "
                    "region such as box:x0,y0,z0,x1,y1,z1",
                    words_, file.path.string()));
  }
  for (size_t u = 0; u < 3; ++u) protection.axes[u] = reading.axes.find("xyz"[u]) != std::string::npos;
  protection.value = reading.value;
  return protection;
}

}  // namespace swage::cli

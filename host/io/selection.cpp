// Selections of vertices in words.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "adjacency.h"
#include "number.h"
#include "scanner.h"
#include "swage/error.h"
#include "swage/handles.h"

namespace swage {
namespace {

using Mask = std::vector<bool>;
using Choose = std::function<Mask(const MeshFile&)>;
using Eigen::AlignedBox3d;
using Region = std::function<AlignedBox3d(const MeshFile&)>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse_part(std::string_view part, const std::string& why) {
  throw InvalidInput("Selection: " + in_quotes(part) + ": " + why);
}

std::string_view trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

int parse_index(std::string_view part, std::string_view text) {
  constexpr int kLargest = std::numeric_limits<int>::max();
  long long value = 0;
  const bool is_index = !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos &&
                        parse_integer(text, value) == text.size();
  if (!is_index) refuse_part(part, in_quotes(text) + " is no number of a vertex or component, such as 12 or 40-52");
  return static_cast<int>(std::min<long long>(value, kLargest));
}

double parse_finite(std::string_view part, std::string_view text) {
  double value = 0;
  const bool is_number = !text.empty() && parse_number(text, value) == text.size() && std::isfinite(value);
  if (!is_number) refuse_part(part, in_quotes(text) + " is no finite number, such as 1.5");
  return value;
}

Mask none_of(const MeshFile& file) { return Mask(static_cast<size_t>(file.mesh.positions.rows()), false); }

Mask mask_within(const MeshFile& file, const AlignedBox3d& box) {
  Mask mask = none_of(file);
  for (size_t v = 0; v < mask.size(); ++v) {
    mask[v] = box.contains(file.mesh.positions.row(static_cast<Eigen::Index>(v)).transpose());
  }
  return mask;
}

void require_below(std::string_view part, const char* what, int number, size_t count) {
  if (static_cast<size_t>(number) < count) return;
  refuse_part(part, std::string(what) + " " + std::to_string(number) + " is not there; they run from 0 to " +
                        std::to_string(count - 1));
}

Choose parse_vertices(std::string_view part) {
  std::vector<std::pair<int, int>> ranges;
  for (const std::string_view item : split(part, ',')) {
    const std::vector<std::string_view> ends = split(item, '-');
    if (ends.size() > 2) refuse_part(part, in_quotes(item) + " is no range of vertices, such as 40-52");
    ranges.emplace_back(parse_index(part, ends.front()), parse_index(part, ends.back()));
    if (ranges.back().first > ranges.back().second)
      refuse_part(part, in_quotes(item) + " runs backwards; swap its ends");
  }
  return [ranges, part = std::string(part)](const MeshFile& file) {
    Mask mask = none_of(file);
    for (const auto& [first, last] : ranges) {
      require_below(part, "vertex", last, mask.size());
      std::fill(mask.begin() + first, mask.begin() + last + 1, true);
    }
    return mask;
  };
}

Mask read_vertices(const std::string& path, const MeshFile& file) {
  Input input = slurp(path);
  require_text(input);
  std::replace(input.bytes.begin(), input.bytes.end(), ',', ' ');
  Scanner scan(input, text_begin(input));
  Mask mask = none_of(file);
  for (scan.skip_space(); !scan.at_end(); scan.skip_space()) {
    const size_t begin = scan.at();
    const long long vertex = scan.integer("a vertex number");
    if (vertex < 0 || static_cast<size_t>(vertex) >= mask.size()) {
      refuse(
          input, begin,
          "vertex " + std::to_string(vertex) + " is not there; they run from 0 to " + std::to_string(mask.size() - 1));
    }
    mask[static_cast<size_t>(vertex)] = true;
  }
  return mask;
}

Choose parse_file(std::string_view part) {
  const std::string path(part.substr(1));
  if (path.empty()) refuse_part(part, "name the file of vertices after the @");
  return [path](const MeshFile& file) { return read_vertices(path, file); };
}

Region parse_box(std::string_view part, std::string_view numbers) {
  const std::vector<std::string_view> items = split(numbers, ',');
  if (items.size() != 6) refuse_part(part, "a box takes six numbers: box:x0,y0,z0,x1,y1,z1");
  AlignedBox3d box;
  for (size_t corner = 0; corner < 6; corner += 3) {
    Eigen::Vector3d point;
    for (size_t k = 0; k < 3; ++k) point[static_cast<int>(k)] = parse_finite(part, items[corner + k]);
    box.extend(point);
  }
  return [box](const MeshFile&) { return box; };
}

/// Without its bound where the relation excludes it: up to the next number before, or from the next after.
AlignedBox3d half_space(int axis, std::string_view relation, double bound) {
  AlignedBox3d box(Eigen::Vector3d::Constant(-kInfinity), Eigen::Vector3d::Constant(kInfinity));
  if (relation == "<") box.max()[axis] = std::nextafter(bound, -kInfinity);
  if (relation == "<=") box.max()[axis] = bound;
  if (relation == ">") box.min()[axis] = std::nextafter(bound, kInfinity);
  if (relation == ">=") box.min()[axis] = bound;
  return box;
}

Region parse_half_space(std::string_view part) {
  const int axis = part[0] - 'x';
  std::string_view rest = trimmed(part.substr(1));
  const size_t length = rest.size() > 1 && rest[1] == '=' ? 2 : 1;
  const std::string relation(rest.substr(0, length));
  if (relation != "<" && relation != "<=" && relation != ">" && relation != ">=") {
    refuse_part(part, "a half space is an axis, one of < <= > >= and a number, such as x<1.2 or z>=90%");
  }
  rest = trimmed(rest.substr(length));
  const bool is_percent = rest.ends_with('%');
  if (is_percent) rest = trimmed(rest.substr(0, rest.size() - 1));
  const double number = parse_finite(part, rest);
  return [axis, relation, number, is_percent](const MeshFile& file) {
    const auto along = file.mesh.positions.col(axis);
    // At 100 % lerp gives the upper end exactly.
    const double bound = is_percent ? std::lerp(along.minCoeff(), along.maxCoeff(), number / 100) : number;
    return half_space(axis, relation, bound);
  };
}

Choose parse_component(std::string_view part, std::string_view text) {
  const int number = parse_index(part, text);
  return [number, part = std::string(part)](const MeshFile& file) {
    Mask mask = none_of(file);
    const std::vector<int> component = components(file.mesh.triangles, static_cast<int>(mask.size()));
    const int count = 1 + *std::max_element(component.begin(), component.end());
    require_below(part, "component", number, static_cast<size_t>(count));
    for (size_t v = 0; v < mask.size(); ++v) mask[v] = component[v] == number;
    return mask;
  };
}

Choose parse_group(std::string_view part, std::string_view name) {
  if (name.empty()) refuse_part(part, "name the group after group:");
  return [part = std::string(part), name = std::string(name)](const MeshFile& file) {
    const auto group = file.groups.find(name);
    if (group == file.groups.end()) {
      std::string names;
      for (const auto& [other, vertices] : file.groups) names += (names.empty() ? "" : ", ") + other;
      refuse_part(part, file.groups.empty() ? "the mesh has no groups; select by numbers or places"
                                            : "no such group; take one of " + names);
    }
    Mask mask = none_of(file);
    for (const int v : group->second) {
      require_below(part, "vertex", v, mask.size());
      mask[static_cast<size_t>(v)] = true;
    }
    return mask;
  };
}

/// One of these says what is selected.
struct Parsed {
  Choose choose;
  Region region;
};

Parsed parse_part(std::string_view part) {
  auto after = [&](std::string_view key) -> std::optional<std::string_view> {
    if (!part.starts_with(key)) return std::nullopt;
    return trimmed(part.substr(key.size()));
  };
  if (part.empty()) refuse_part(part, "nothing stands here; write such as 12,40-52 or x<1.2");
  if (part[0] == '@') return {parse_file(part), {}};
  if (const auto numbers = after("box:")) return {{}, parse_box(part, *numbers)};
  if (const auto number = after("component:")) return {parse_component(part, *number), {}};
  if (const auto name = after("group:")) return {parse_group(part, *name), {}};
  if (part[0] >= 'x' && part[0] <= 'z') return {{}, parse_half_space(part)};
  if (part[0] >= '0' && part[0] <= '9') return {parse_vertices(part), {}};
  refuse_part(part, "not understood; write 12,40-52, @file, box:..., x<1.2, component:N or group:NAME, joined by &");
}

}  // namespace

struct Selection::Term : Parsed {
  Mask mask(const MeshFile& file) const { return region ? mask_within(file, region(file)) : choose(file); }
};

Selection::Selection(std::string_view text) : text_(text) {
  for (const std::string_view part : split(text, '&'))
    terms_.push_back(std::make_unique<Term>(Term{{parse_part(part)}}));
}
Selection::~Selection() = default;
Selection::Selection(Selection&&) noexcept = default;
Selection& Selection::operator=(Selection&&) noexcept = default;

std::vector<int> Selection::vertices(const MeshFile& file) const {
  check(file.mesh.positions, file.mesh.triangles);
  Mask chosen(static_cast<size_t>(file.mesh.positions.rows()), true);
  for (const auto& term : terms_) {
    const Mask mask = term->mask(file);
    for (size_t v = 0; v < chosen.size(); ++v) chosen[v] = chosen[v] && mask[v];
  }
  std::vector<int> vertices;
  for (size_t v = 0; v < chosen.size(); ++v) {
    if (chosen[v]) vertices.push_back(static_cast<int>(v));
  }
  if (vertices.empty())
    throw InvalidInput("Selection: " + in_quotes(text_) + " selects no vertex of the mesh; widen it");
  return vertices;
}

std::optional<AlignedBox3d> Selection::region(const MeshFile& file) const {
  check(file.mesh.positions, file.mesh.triangles);
  AlignedBox3d common(file.mesh.positions.colwise().minCoeff().transpose(),
                      file.mesh.positions.colwise().maxCoeff().transpose());
  for (const auto& term : terms_) {
    if (!term->region) return std::nullopt;
    common = common.intersection(term->region(file));
  }
  if (common.isEmpty())
    throw InvalidInput("Selection: " + in_quotes(text_) + " is outside of the mesh's box; move or widen it");
  return common;
}

}  // namespace swage

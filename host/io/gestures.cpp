// Gestures in .deform files.
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "input.h"
#include "number.h"
#include "swage/error.h"
#include "swage/handles.h"

namespace swage {
namespace {

using Json = nlohmann::ordered_json;

// A repeated key, which the parsed document no longer shows: in the how-many-th object of the list, and its name.
struct Repeated {
  size_t object;
  std::string key;
};

class KeyWatch {
 public:
  void see(int depth, Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start) open_.emplace_back();
    if (event == Event::object_end) open_.pop_back();
    if (event == Event::object_end && depth == 1) ++object_;
    if (event != Event::key) return;
    const std::string key = parsed.get<std::string>();
    if (!open_.back().insert(key).second) repeated_.push_back({object_, key});
  }
  const std::vector<Repeated>& repeated() const { return repeated_; }

 private:
  std::vector<std::set<std::string>> open_;
  std::vector<Repeated> repeated_;
  size_t object_ = 0;
};

Json parse(const Input& input, KeyWatch& watch) {
  try {
    return Json::parse(input.bytes, [&](int depth, Json::parse_event_t event, Json& parsed) {
      watch.see(depth, event, parsed);
      return true;
    });
  } catch (const Json::parse_error& error) {
    refuse(input, error.byte == 0 ? 0 : error.byte - 1, "not valid JSON; mend it or export the gestures again");
  } catch (const Json::exception&) {
    refuse(input, "holds a number beyond double precision; mend it");
  }
}

std::string label_of(const Input& input, const Json& item, size_t number) {
  const std::string nth = "gesture " + std::to_string(number + 1);
  if (!item.is_object()) refuse(input, nth + " is no object with a label and displacements; mend it");
  const auto label = item.find("label");
  if (label == item.end() || !label->is_string()) refuse(input, nth + " has no label that is a text; add one");
  return label->get<std::string>();
}

int vertex_of(const Input& input, const std::string& where, const std::string& key, Eigen::Index vertex_count) {
  long long vertex = 0;
  const bool is_plain = !key.empty() && key.find_first_not_of("0123456789") == std::string::npos &&
                        parse_integer(key, vertex) == key.size() && (key == "0" || key[0] != '0');
  if (!is_plain) refuse(input, where + ": " + in_quotes(key) + " is no vertex number; mend it");
  if (vertex >= vertex_count) {
    refuse(input, where + ": vertex " + in_quotes(key) + " is not there: they run from 0 to " +
                      std::to_string(vertex_count - 1) + "; is it a gesture for another mesh?");
  }
  return static_cast<int>(vertex);
}

Eigen::Vector3d displacement_of(const Input& input, const std::string& where, const Json& value) {
  const bool is_triple =
      value.is_array() && value.size() == 3 && value[0].is_number() && value[1].is_number() && value[2].is_number();
  if (!is_triple) refuse(input, where + ": a displacement is a list of three numbers; mend it");
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

Gesture gesture_of(const Input& input, const Json& item, size_t number, const PositionsRef& rest) {
  Gesture gesture;
  gesture.label = label_of(input, item, number);
  const std::string where = "gesture " + in_quotes(gesture.label);
  const auto displacements = item.find("displacements");
  if (displacements == item.end() || !displacements->is_object()) {
    refuse(input, where + " has no displacements by vertex; add them");
  }
  const double diagonal = box_diagonal(rest);
  for (const auto& [key, value] : displacements->items()) {
    const int vertex = vertex_of(input, where, key, rest.rows());
    const Eigen::Vector3d displacement = displacement_of(input, where + ", vertex " + key, value);
    const Eigen::Vector3d target = rest.row(vertex).transpose() + diagonal * displacement;
    if (!target.allFinite()) refuse(input, where + ", vertex " + key + ": the displacement is too large; mend it");
    gesture.add(vertex, target);
  }
  return gesture;
}

void refuse_repeated(const Input& input, const KeyWatch& watch, const std::vector<Gesture>& gestures) {
  if (watch.repeated().empty()) return;
  const Repeated& first = watch.repeated().front();
  const std::string label = first.object < gestures.size() ? gestures[first.object].label : "?";
  refuse(input, "gesture " + in_quotes(label) + ": " + in_quotes(first.key) + " comes twice; keep one");
}

void refuse_same_labels(const Input& input, const std::vector<Gesture>& gestures) {
  std::set<std::string> labels;
  for (const Gesture& gesture : gestures) {
    if (labels.insert(gesture.label).second) continue;
    refuse(input, "two gestures have the label " + in_quotes(gesture.label) + "; rename one");
  }
}

}  // namespace

std::vector<Gesture> read_gestures(const std::filesystem::path& path, const PositionsRef& rest) {
  const Input input = slurp(path);
  KeyWatch watch;
  const Json list = parse(input, watch);
  if (!list.is_array()) refuse(input, "is not a JSON list of gestures; mend it");
  if (list.empty()) refuse(input, "holds no gesture; add one");
  std::vector<Gesture> gestures;
  for (const Json& item : list) gestures.push_back(gesture_of(input, item, gestures.size(), rest));
  refuse_repeated(input, watch, gestures);
  refuse_same_labels(input, gestures);
  return gestures;
}

void write_gestures(const std::filesystem::path& path, const std::vector<Gesture>& gestures, const PositionsRef& rest) {
  const double diagonal = box_diagonal(rest);
  if (!(diagonal > 0))
    throw InvalidInput(
        "write_gestures: rest: the mesh has no extent to measure displacements by; check its units and coordinates");
  Json list = Json::array();
  for (const Gesture& gesture : gestures) {
    Json displacements = Json::object();
    for (const auto& [vertex, target] : gesture.targets) {
      if (vertex < 0 || vertex >= rest.rows() || !target.allFinite()) {
        throw InvalidInput("write_gestures: gesture " + in_quotes(gesture.label) + ": handle " +
                           std::to_string(vertex) +
                           " is no vertex of the mesh, or its target is not finite; mend or remove it");
      }
      const Eigen::Vector3d displacement = (target - rest.row(vertex).transpose()) / diagonal;
      displacements[std::to_string(vertex)] = {displacement.x(), displacement.y(), displacement.z()};
    }
    list.push_back({{"displacements", std::move(displacements)}, {"label", gesture.label}});
  }
  write_file(path, list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace swage

#include "fit_file.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "swage/error.h"

namespace swage::cli {
namespace {

constexpr double kRounding = 1e-6;  // By which a rotation may miss one.
constexpr int kDeepest = 100;       // What is nested is written by functions that call themselves.

/// An object in the file, whose keys are read strictly.
class Reader {
 public:
  Reader(const Json& json, std::string file, std::string path)
      : json_(json), file_(std::move(file)), path_(std::move(path)) {
    if (!json_.is_object()) refuse("", "an object is expected");
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& why) const {
    const std::string place = path_ + (path_.empty() || key.empty() ? "" : ".") + key;
    throw UnreadableFile(fmt::format("{}: {}{}{}; make it anew by swage template fit --json", file_, place,
                                     place.empty() ? "" : ": ", why));
  }

  const Json& get(const std::string& key) const {
    if (!json_.contains(key)) refuse(key, "is missing");
    return json_[key];
  }
  Reader object(const std::string& key) const { return {get(key), file_, path_.empty() ? key : path_ + "." + key}; }

  double number(const std::string& key) const { return number(key, get(key)); }
  double number(const std::string& key, const Json& value) const {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      refuse(key, "a finite number is expected, not " + value.dump());
    }
    return value.get<double>();
  }
  Eigen::Index count(const std::string& key) const {
    if (!get(key).is_number_unsigned()) refuse(key, "a count is expected, not " + get(key).dump());
    return get(key).get<Eigen::Index>();
  }
  Eigen::RowVector3d row(const std::string& key, const Json& list) const {
    if (!list.is_array() || list.size() != 3) refuse(key, "three numbers are expected, not " + list.dump());
    Eigen::RowVector3d numbers;
    for (size_t u = 0; u < 3; ++u) {
      numbers[static_cast<Eigen::Index>(u)] = number(fmt::format("{}[{}]", key, u), list[u]);
    }
    return numbers;
  }
  /// Throws where there is another key.
  void check_keys(const std::set<std::string>& known, const std::string& what) const {
    for (const auto& [key, value] : json_.items()) {
      if (!known.contains(key)) refuse(key, what);
    }
  }

 private:
  const Json& json_;
  std::string file_, path_;
};

/// Refuses what is nested too deep, and keys that are there twice: of such only one would count.
class KeyWatch {
 public:
  explicit KeyWatch(const std::string& file) : file_(file) {}

  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (depth > kDeepest) throw UnreadableFile(file_ + ": brackets are nested too deep; mend it");
    if (event == Event::object_start) open_.emplace_back();
    if (event == Event::object_end) open_.pop_back();
    if (event == Event::key && !open_.back().insert(parsed.get<std::string>()).second) {
      throw UnreadableFile(
          fmt::format("{}: the key {} is there twice in one object; remove one", file_, parsed.dump()));
    }
    return true;
  }

 private:
  const std::string& file_;
  std::vector<std::set<std::string>> open_;
};

Json parsed(const std::string& path) {
  std::error_code ignored;
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path, ignored))
    throw UnreadableFile(path + ": cannot be read: is it there, and the report of swage template fit?");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  try {
    KeyWatch watch(path);
    return Json::parse(text,
                       [&](int depth, Json::parse_event_t event, Json& value) { return watch(depth, event, value); });
  } catch (const Json::parse_error& e) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(text.size(), e.byte));
    throw UnreadableFile(
        fmt::format("{}: line {}: not valid JSON; mend it", path, 1 + std::count(text.begin(), end, '\n')));
  } catch (const Json::exception&) {
    throw UnreadableFile(path + ": holds a number beyond double precision; mend it");
  }
}

Eigen::VectorXd parameters_in(const Reader& reader, const Template& of) {
  const Reader values = reader.object("parameters");
  Eigen::VectorXd parameters(static_cast<Eigen::Index>(of.parameters().size()));
  std::set<std::string> names;
  for (const TemplateParameter& parameter : of.parameters()) {
    parameters[static_cast<Eigen::Index>(names.size())] = values.number(parameter.name);
    names.insert(parameter.name);
  }
  values.check_keys(names, fmt::format("the template {} has no such parameter", of.name()));
  return parameters;
}

TemplatePose pose_in(const Reader& reader) {
  const Reader fields = reader.object("pose");
  fields.check_keys({"scale", "rotation", "offset"}, "a pose has scale, rotation and offset");
  TemplatePose pose;
  pose.scale = fields.number("scale");
  if (pose.scale <= 0) fields.refuse("scale", "is not above 0");
  pose.offset = fields.row("offset", fields.get("offset"));
  const Json& rows = fields.get("rotation");
  if (!rows.is_array() || rows.size() != 3) fields.refuse("rotation", "three rows are expected");
  for (size_t u = 0; u < 3; ++u) {
    pose.rotation.row(static_cast<Eigen::Index>(u)) = fields.row(fmt::format("rotation[{}]", u), rows[u]);
  }
  const Eigen::Matrix3d square = pose.rotation * pose.rotation.transpose();
  if (!square.isIdentity(kRounding) || pose.rotation.determinant() < 0) fields.refuse("rotation", "is no rotation");
  return pose;
}

/// Whatever the order of keys.
nlohmann::json document_of(const Template& of) { return nlohmann::json::parse(of.text()); }

}  // namespace

void FitFile::check_is_of(const Template& other, const std::string& name) const {
  if (document_of(of) == document_of(other)) return;
  throw InvalidInput(fmt::format(
      "{}: template_document: is a fit of another template{}{}, not of {}: fit that, or leave --template out", path,
      of.name() == other.name() ? " called " : ", ", of.name(), name));
}

std::string FitFile::warning_of(const MeshFile& mesh) const {
  if (mesh.mesh.positions.rows() == vertices && mesh.mesh.triangles.rows() == triangles) return "";
  return fmt::format("{} is of a mesh of {} vertices and {} triangles, {} has {} and {}: does it lie where that lay?",
                     path, vertices, triangles, mesh.path.string(), mesh.mesh.positions.rows(),
                     mesh.mesh.triangles.rows());
}

void add_fit(Json& json, const std::string& name, const Template& of, const Eigen::VectorXd& parameters,
             const TemplatePose& pose) {
  json["template"] = name;
  json["parameters"] = values_json(of, parameters);
  json["pose"] = pose_json(pose);
}

void add_document(Json& json, const Template& of) { json["template_document"] = Json::parse(of.text()); }

FitFile read_fit(const std::string& path) {
  const Json json = parsed(path);
  const Reader reader(json, path, "");
  Template of = parse_template(reader.get("template_document").dump(), path + ": template_document");
  const Eigen::VectorXd parameters = parameters_in(reader, of);
  return {path, std::move(of), parameters, pose_in(reader), reader.count("vertices"), reader.count("triangles")};
}

}  // namespace swage::cli

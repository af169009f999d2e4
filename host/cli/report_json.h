// Reports as JSON, piece by piece.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "swage/backend.h"
#include "swage/handles.h"
#include "swage/report.h"

namespace swage::cli {

using Json = nlohmann::ordered_json;

/// Wall time since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

struct RunSeconds {
  double read = 0, precompute = 0, solve = 0, write = 0, total = 0;
};

/// What ran on what: the report's first lines.
Json run_json(const char* command, const std::string& input, const Mesh& mesh, const std::string& method);
void add_backend(Json& json, const Backend& backend);
void add_solve(Json& json, const Report& report, std::vector<std::string>& warnings);
/// How far handles were missed, normals turned, and what turned over or crosses.
void add_changes(Json& json, const Mesh& rest, const Gesture& gesture, const Positions& positions,
                 std::vector<std::string>& warnings);
void add_costs(Json& json, const Report& report, const Backend& backend, const RunSeconds& seconds);

inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// `value`, but null where it is not finite, with a line in `warnings`: JSON has no word for infinity.
Json finite(double value, const std::string& name, std::vector<std::string>& warnings);

/// To a file or, where `path` is "-", to stdout; nothing where it is empty. Throws UnwritableFile.
void write_json(const std::string& path, const Json& json);

}  // namespace swage::cli

// Reports as JSON.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "reshape.h"

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

Json report_json(const ReshapeJob& job, const MeshFile& file, const Gesture& gesture, const ReshapeResult& result,
                 const Backend& backend, const RunSeconds& seconds);

inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// `value`, but null where it is not finite, with a line in `warnings`: JSON has no word for infinity.
Json finite(double value, const std::string& name, std::vector<std::string>& warnings);

/// To a file or, where `path` is "-", to stdout; nothing where it is empty. Throws UnwritableFile.
void write_json(const std::string& path, const Json& json);

}  // namespace swage::cli

// What `swage stylize` tells of a run, in numbers and as a picture.
#pragma once

#include "report_json.h"
#include "stylize.h"
#include "swage/style_measures.h"

namespace swage::cli {

/// A run that is done.
struct Stylized {
  const MeshFile& file;
  const Gesture& handles;
  StylizeResult result;
  StyleMeasures before, after;
  std::vector<std::string> warnings;
};

Json report_json(const StylizeJob& job, const Stylized& run, const Backend& backend, const RunSeconds& seconds);

/// Before and after, with angles to targets as colours. Throws Interrupted.
Image picture_of(const StylizeJob& job, const Stylized& run, const CommonOptions& common);

}  // namespace swage::cli

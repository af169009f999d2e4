// What `swage resize` tells of a run, in numbers.
#pragma once

#include "report_json.h"
#include "resize.h"

namespace swage::cli {

/// Of one result on the top level, of several in a list.
Json report_json(const ResizeJob& job, Resized& run, const Backend& backend, const RunSeconds& seconds);

/// --vulnerability, --grid-before and --grid-after. Throws UnwritableFile.
void write_faces(const ResizeJob& job, Resized& run);

}  // namespace swage::cli

// The report of `swage reshape`.
#pragma once

#include "report_json.h"
#include "reshape.h"

namespace swage::cli {

Json report_json(const ReshapeJob& job, const MeshFile& file, const Gesture& gesture, const ReshapeResult& result,
                 const Backend& backend, const RunSeconds& seconds);

}  // namespace swage::cli

// A slice of the protective grid over the model, before and after.
#pragma once

#include "resize.h"

namespace swage::cli {

/// A row for each result; of none the grid at rest. Throws Interrupted.
Image picture_of_grid(const ResizeJob& job, Resized& run, const CommonOptions& common);

}  // namespace swage::cli

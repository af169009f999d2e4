// What `swage resize` shows of a run.
#pragma once

#include "resize.h"

namespace swage::cli {

/// Each without pixels where it is not asked for.
struct ResizePictures {
  Image results, vulnerability, grid;
};

/// Throws Interrupted.
ResizePictures pictures_of(const ResizeJob& job, Resized& run, const CommonOptions& common);

/// The name of the mesh, without folder and extension.
std::string title_of(const ResizeJob& job);

/// With its box's middle at the origin: panels are compared by what is at one place.
Positions centred(const Positions& positions);

/// Throws UnwritableFile.
void write_pictures(const ResizeJob& job, const ResizePictures& pictures);

}  // namespace swage::cli

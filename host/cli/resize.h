// `swage resize` as the command line asks for it.
#pragma once

#include <string>
#include <vector>

#include "edit.h"
#include "options.h"
#include "picture.h"
#include "resize_protection.h"
#include "resize_targets.h"
#include "swage/resize.h"

namespace swage::cli {

/// Texts are empty where their option is not given.
struct ResizeJob : EditFiles {
  TargetOptions target;
  std::vector<ProtectionText> protections;
  std::string grid;           ///< N or NX,NY,NZ
  double crease_angle = 150;  ///< Degrees.
  std::string vulnerability, grid_before, grid_after;
  std::string vulnerability_picture, grid_picture;
  PictureOptions picture;  ///< Of rest and results; its view is that of all pictures.
};

// resize_options.cpp
void add_resize_options(CLI::App& app, ResizeJob& job);
/// Throws WrongUsage where options contradict each other, and as check_outputs() and check(PictureOptions) do.
void check_job(const ResizeJob& job);
/// All but the backend. Throws WrongUsage where the grid is not understood.
ResizeOptions options_of(const ResizeJob& job);

/// A run that is done.
struct Resized {
  const MeshFile& file;
  Resize plan;
  std::vector<ResizeTarget> targets;
  std::vector<ResizeResult> results;  ///< One of each target.
};

}  // namespace swage::cli

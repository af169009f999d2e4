// `swage stylize` as the command line asks for it.
#pragma once

#include <optional>
#include <string>

#include "edit.h"
#include "gesture_options.h"
#include "options.h"
#include "picture.h"
#include "swage/stylize.h"

namespace swage::cli {

/// Texts are empty where their option is not given.
struct StylizeJob : EditFiles {
  // Exactly one of these is given, or the sheet.
  std::string style;       ///< A preset or a mesh file.
  std::string capture;     ///< A painted sphere, .png or .ply.
  std::string normals;     ///< A .ply.
  std::string normal_map;  ///< A .png.
  bool developable = false;
  bool polycube = false;  ///< With a style or without, which is a cube then.

  std::string target;                        ///< Of the style: closest or sphere.
  bool dynamic = false, no_dynamic = false;  ///< What is asked for; dynamic where neither is.
  std::string layout;                        ///< Of the capture.
  std::string normal_space;                  ///< Of the normal map: tangent or object.
  std::string green;                         ///< Of the normal map: up or down.
  std::optional<double> tau, threshold;

  std::optional<double> lambda;
  std::string energy, weights;
  bool accelerate = false, published = false;
  std::optional<int> iterations;
  GestureOptions gesture;
  PictureOptions picture;
  std::string heat = "targets";  ///< Of the picture: targets or none.
  std::string sheet;             ///< For a picture of the mesh under several styles.
};

// stylize_options.cpp
void add_stylize_options(CLI::App& app, StylizeJob& job);
/// Throws WrongUsage where options contradict each other, and as check_outputs() and check(PictureOptions) do.
void check_job(const StylizeJob& job);
/// As asked for, or else as the paper has it for the style.
double lambda_of(const StylizeJob& job);
StylizeEnergy energy_of(const StylizeJob& job);
StylizeWeights weights_of(const StylizeJob& job);

// stylize_sheet.cpp
/// The mesh and what six styles make of it. Throws Interrupted.
Image style_sheet(const StylizeJob& job, const MeshFile& file, const Gesture& handles, const BackendChoice& choice,
                  const CommonOptions& common);

}  // namespace swage::cli

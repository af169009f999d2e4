// Fits in files: the reports of `swage template fit` and, so that edits can be edited again, of `edit`.
#pragma once

#include <optional>
#include <string>

#include "swage/mesh_io.h"
#include "swage/template_fit.h"
#include "template_json.h"

namespace swage::cli {

/// Where a template lies.
struct FitFile {
  std::string path;
  Template of;
  Eigen::VectorXd parameters;
  TemplatePose pose;
  Eigen::Index vertices, triangles;  ///< Of the mesh that it was fitted to.

  /// Throws InvalidInput, naming the file, where it is of another template.
  void check_is_of(const Template& other, const std::string& name) const;
  /// Empty where the mesh has as many vertices and triangles.
  std::string warning_of(const MeshFile& mesh) const;
};

/// The template's name as it was asked for, its parameters and where it lies.
void add_fit(Json& json, const std::string& name, const Template& of, const Eigen::VectorXd& parameters,
             const TemplatePose& pose);
/// The template itself, by which a file is known to be of it: the end of a report, as it is long.
void add_document(Json& json, const Template& of);

/// Throws UnreadableFile, naming the path within the file and a remedy, where it is missing, no JSON, or lacks what
/// add_fit(), add_document() and run_json() write, or where that is not as they write it.
FitFile read_fit(const std::string& path);

}  // namespace swage::cli

// Surfaces of templates, made and shown.
#pragma once

#include "edit.h"
#include "picture.h"
#include "swage/template_fit.h"

namespace swage::cli {

/// --resolution
CLI::Option* add_resolution_option(CLI::App& app, int& resolution);

/// At about how many points the field is asked for.
int points_of_surface(int resolution);

/// Throws Interrupted, and as template_mesh() does.
Mesh surface_of(const Template& of, const Eigen::VectorXd& values, const TemplateMeshOptions& options,
                const CommonOptions& common);

/// A mesh that came from no file. Nothing where there is no path. Throws UnwritableFile.
void write_surface(const std::string& path, const Mesh& mesh);

/// What is up in a mesh in which the template lies so.
Eigen::Vector3d up_of(const Template& of, const TemplatePose& pose);

}  // namespace swage::cli

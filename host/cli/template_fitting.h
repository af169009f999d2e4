// How a template is fitted, and what is known of a fit that was made before.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "edit.h"
#include "swage/template_fit.h"

namespace swage::cli {

/// --samples, --up and the like. Those that are given are WrongUsage where one of `excluded` is.
std::vector<CLI::Option*> add_fitting_options(CLI::App& app, FitOptions& options);

/// At how many points the field is asked for.
int points_of(const FitOptions& options);

/// Throws InvalidInput as fit_template() does, naming the mesh.
TemplateFit fitted(const Template& of, const MeshFile& file, const FitOptions& options, const ProgressFn& progress);

/// Of a fit what is not as one would like it, in words.
std::vector<std::string> warnings_of(const TemplateFit& fit, const std::string& mesh);

}  // namespace swage::cli

// How a template is fitted, and what is known of a fit that was made before.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "backend_choice.h"
#include "edit.h"
#include "swage/template_fit.h"

namespace swage::cli {

/// An axis or auto, which is 0.
CLI::Option* add_up_option(CLI::App& app, const char* name, const std::function<void(char)>& set,
                           const std::string& help);

/// --up, --samples and the like.
std::vector<CLI::Option*> add_fitting_options(CLI::App& app, FitOptions& options);

/// Where `auto` evaluates the field: a fit asks for it at its points as often as it has iterations.
std::shared_ptr<Backend> backend_of(const FitOptions& options, const BackendChoice& choice);

/// Throws InvalidInput as fit_template() does, naming the mesh.
TemplateFit fitted(const Template& of, const MeshFile& file, const FitOptions& options, const ProgressFn& progress);

/// Of a fit what is not as one would like it, in words.
std::vector<std::string> warnings_of(const TemplateFit& fit, const std::string& mesh);

}  // namespace swage::cli

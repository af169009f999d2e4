// What edits by templates share: the fit that they start from, how they are done, and what is told of them.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "edit.h"
#include "fit_file.h"
#include "options.h"
#include "swage/template_edit.h"

namespace swage::cli {

struct FitSource {
  std::string name;    ///< Of the template; may be empty where there is a file, which has it.
  std::string file;    ///< Empty where it is fitted on the spot.
  FitOptions options;  ///< For that.
};

/// --template, --fit and those for fitting on the spot.
void add_fit_source(CLI::App& app, FitSource& source);

/// Throws WrongUsage where two outputs name one file, or one of them an input's.
void check_apart(const std::vector<Output>& outputs, const std::vector<Output>& inputs);

/// --tracking, --smoothing and the like.
void add_editing_options(CLI::App& app, TemplateEditOptions& options);

/// What is known before the mesh is read.
struct KnownFit {
  std::string name;  ///< Of the template, as it was asked for.
  Template of;
  std::optional<FitFile> file;
};

/// Throws WrongUsage where there is neither a template nor a file, as template_named() and read_fit() do, and
/// InvalidInput where the file is of another template.
KnownFit known_fit(const std::string& name, const std::string& file);

/// As the file has it, or made now. Throws as fitted() does.
TemplateFit fit_of(const KnownFit& known, const FitOptions& options, const MeshFile& mesh, const BackendChoice& choice,
                   const ProgressFn& progress);

/// Throws InvalidInput as TemplateEdit does, naming the mesh.
TemplateEdit edit_of(const Template& of, const TemplateFit& fit, const MeshFile& mesh,
                     const TemplateEditOptions& options);

/// Of a fit by a file that it is of another mesh, of one made now as warnings_of() has it.
std::vector<std::string> warnings_of(const KnownFit& known, const TemplateFit& fit, const MeshFile& mesh);

/// By what file, or how well.
Json source_json(const KnownFit& known, const TemplateFit& fit, std::vector<std::string>& warnings);

/// Of one of the results: what it took, how far it follows, and what became of the triangles.
void add_edit(Json& json, const Mesh& rest, const TemplateEditResult& result, std::vector<std::string>& warnings);

}  // namespace swage::cli

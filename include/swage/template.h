// Parametric implicit templates: a surface as the zero set of a field of space that named parameters shape.
//
// Kusupati, Gaillard, Thiery, Kaiser: Semantic Shape Editing with Parametric Implicit Templates. SIGGRAPH 2024.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "swage/backend.h"
#include "swage/mesh.h"
#include "swage/report.h"
#include "swage/tape.h"

#pragma GCC visibility push(default)
namespace swage {

struct TemplateParameter {
  std::string name;  ///< Letters, digits and underscores, no digit first.
  std::string group, description;
  double value = 0;            ///< By default.
  double least = 0, most = 0;  ///< What it may be, the first below the second.
};

/// A field at points (#P × 3), with parameters: #P values, negative inside. Continuous in both. Called from one thread
/// at a time.
using FieldFunction =
    std::function<void(const Positions& points, const Eigen::VectorXd& parameters, Eigen::VectorXd& values)>;

/// A field of space with parameters, as a template's file describes it: a graph of nodes whose numbers are parameters,
/// expressions of them, or constants; or any function of a point. The field is negative inside; it is continuous in
/// space and parameters, and neither a true distance nor differentiable everywhere.
class Template {
 public:
  Template(const Template&);
  Template(Template&&) noexcept;
  Template& operator=(const Template&);
  Template& operator=(Template&&) noexcept;
  ~Template();

  const std::string& name() const;
  const std::string& description() const;
  char up() const;  ///< 'x', 'y' or 'z'.
  const std::vector<TemplateParameter>& parameters() const;
  /// Throws InvalidInput, naming those that there are, where none is called so.
  int parameter(std::string_view name) const;
  Eigen::VectorXd defaults() const;
  /// Evaluates the field. Of a function derivatives are central differences, over 1e-5 units of space and of a
  /// parameter's range.
  std::unique_ptr<FieldStep> field(const Backend& backend) const;
  /// Throws InvalidInput where the field is a function.
  const Tape& tape() const;
  /// The file's content: reading it again gives the same template. Throws InvalidInput where the field is a function.
  std::string text() const;

 private:
  friend class TemplateReader;
  friend Template template_of(const std::string&, const std::vector<TemplateParameter>&, FieldFunction, char);
  struct Content;
  explicit Template(std::shared_ptr<const Content> content);
  std::shared_ptr<const Content> content_;
};

/// Throws UnreadableFile where the file cannot be read, and, naming the path within it and a remedy, where it is no
/// JSON, has a key, type or name that is not known, lacks one, a number is out of its range, or nodes refer to each
/// other in a circle.
Template read_template(const std::filesystem::path& path);
/// The same of a text; errors call it by the name.
Template parse_template(std::string_view text, const std::string& name);

/// Of any function: a body model's distance, a mesh's.
///
/// Throws InvalidInput where there is no function, a parameter's name is none or there twice, its value is not within
/// its bounds, or `up` is not x, y or z.
Template template_of(const std::string& name, const std::vector<TemplateParameter>& parameters, FieldFunction function,
                     char up = 'y');

/// Those that come with the library: "box", "couch", ...
std::vector<std::string> shipped_templates();
/// Throws InvalidInput, naming those that there are.
Template shipped_template(std::string_view name);

/// Of the zero set of a template.
struct TemplateMeshOptions {
  int resolution = 128;              ///< Cells along the longest side of its box, [8, 1024].
  std::shared_ptr<Backend> backend;  ///< Evaluates the field; cpu_backend() where none is given.
};

/// The surface where the field vanishes, by dual contouring: a vertex in each cell that it passes, where the planes
/// tangent to it there meet, so that edges stay sharp; wound so that normals point to where the field grows. Parts
/// thinner than a cell may be lost.
///
/// Throws InvalidInput where the parameters are not as many as the template's or not finite, or the resolution is out
/// of its range, and Unsolvable where there is no surface within 64 units of the origin, or it does not end there.
/// Empty where `progress` cancelled.
Mesh template_mesh(const Template& of, const Eigen::VectorXd& parameters, const TemplateMeshOptions& options = {},
                   const ProgressFn& progress = {});

}  // namespace swage
#pragma GCC visibility pop

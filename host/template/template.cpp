// Templates from their files.
#include "swage/template.h"
#include "messages.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "expression.h"
#include "fields.h"
#include "function_field.h"
#include "nodes.h"
#include "swage/error.h"

namespace swage {

struct Template::Content {
  Json document;
  std::string name, description;
  char up = 'y';
  std::vector<TemplateParameter> parameters;
  Tape tape;
  FieldFunction function;  // In place of the document and its tape.
};

namespace {

constexpr std::size_t kManyParameters = 256, kManyNodes = 4096;
constexpr std::size_t kMostPlaces = 10'000;  // Of one node.
// What is nested is read by functions that call themselves.
constexpr int kDeepestJson = 100;
constexpr std::size_t kDeepestNodes = 256;

std::string path_in(const char* list, std::size_t i) { return std::string(list) + "[" + std::to_string(i) + "]"; }

/// Refuses what is nested too deep, and keys that are there twice, which the parsed document no longer shows.
class KeyWatch {
 public:
  explicit KeyWatch(const std::string& file) : file_(file) {}

  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (depth > kDeepestJson) throw UnreadableFile(file_ + ": brackets are nested too deep; mend it");
    if (event == Event::object_start) open_.emplace_back();
    if (event == Event::object_end) open_.pop_back();
    if (event == Event::key && !open_.back().insert(parsed.get<std::string>()).second) {
      throw UnreadableFile(file_ + ": the key " + parsed.dump() + " is there twice in one object; remove one");
    }
    return true;
  }

 private:
  const std::string& file_;
  std::vector<std::set<std::string>> open_;
};

Json parsed(std::string_view text, const std::string& file) {
  try {
    KeyWatch watch(file);
    return Json::parse(text,
                       [&](int depth, Json::parse_event_t event, Json& value) { return watch(depth, event, value); });
  } catch (const Json::parse_error& error) {
    const std::size_t end = std::min(text.size(), error.byte);
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    throw UnreadableFile(file + ": line " + std::to_string(line) + ": not valid JSON; mend it");
  } catch (const Json::exception&) {
    throw UnreadableFile(file + ": holds a number beyond double precision; mend it");
  }
}

TemplateParameter read_parameter(Fields& fields) {
  TemplateParameter parameter;
  parameter.name = fields.text("name");
  if (!is_parameter_name(parameter.name)) {
    fields.refuse("name", "'" + parameter.name + "' is no name: letters, digits and underscores, none of a function");
  }
  parameter.value = fields.plain_number("default");
  parameter.least = fields.plain_number("min");
  parameter.most = fields.plain_number("max");
  parameter.group = fields.text_or("group", "");
  parameter.description = fields.text_or("description", "");
  if (!(parameter.least < parameter.most)) fields.refuse("min", "is not below max; swap or mend them");
  if (!(parameter.value >= parameter.least && parameter.value <= parameter.most)) {
    fields.refuse("default", "is not between min and max; mend one of them");
  }
  fields.end();
  return parameter;
}

/// The same shape, which is asked only once at each place, since nodes may be used again and again, and copied for
/// nothing.
Shape once_at_each_place(Shape shape) {
  struct Known {
    Shape shape;
    std::map<std::array<int, 3>, Scalar> values;
  };
  const auto known = std::make_shared<Known>(Known{std::move(shape), {}});
  return [known](const Point& p) {
    const std::array<int, 3> place = {p[0].id, p[1].id, p[2].id};
    if (const auto found = known->values.find(place); found != known->values.end()) return found->second;
    if (known->values.size() == kMostPlaces) throw TapeTooLong();
    return known->values.emplace(place, known->shape(p)).first->second;
  };
}

void refuse_function(const FieldFunction& function, const std::string& name, const std::string& why) {
  if (function) throw InvalidInput("template " + name + ": is a function, and " + why);
}

}  // namespace

class TemplateReader {
 public:
  TemplateReader(std::string_view text, std::string file) : file_(std::move(file)) {
    content_->document = parsed(text, file_);
  }

  Template read() {
    Fields top(content_->document, file_, "");
    try {
      return read(top);
    } catch (const TapeTooLong&) {
      top.refuse("nodes", "the template is too large: use fewer numbers, or fewer copies of copies");
    }
  }

 private:
  struct Known {
    NodeShape shape;
    std::size_t depth;  ///< Of nodes one below the other, itself the first.
  };

  Template read(Fields& top) {
    top.integer("version", 1, 1);
    content_->name = top.text("name");
    content_->description = top.text_or("description", "");
    content_->up = top.choice("up", {"x", "y", "z"}, "y")[0];
    read_parameters(top.list("parameters", 0, kManyParameters));
    builder_.emplace(defaults());
    const Json& nodes = top.list("nodes", 1, kManyNodes);
    list_nodes(nodes);
    const NodeShape root = node_of(top, "root", top.get("root")).shape;
    if (root.is_flat) top.refuse("root", "is a flat shape; extrude or revolve it");
    top.end();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!known_.contains(i)) top.refuse(path_in("nodes", i), "nothing refers to it; remove it or use it");
    }
    const Scalar field = root.shape({builder_->coordinate(0), builder_->coordinate(1), builder_->coordinate(2)});
    content_->tape = builder_->tape(field);
    return Template(content_);
  }

  void read_parameters(const Json& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      Fields fields(list[i], file_, path_in("parameters", i));
      content_->parameters.push_back(read_parameter(fields));
      const std::string& name = content_->parameters.back().name;
      if (!numbers_.emplace(name, static_cast<int>(i)).second)
        fields.refuse("name", "'" + name + "' is there twice; rename one");
    }
  }

  void list_nodes(const Json& nodes) {
    nodes_ = &nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      Fields fields(nodes[i], file_, path_in("nodes", i));
      const std::string id = fields.text("id");
      if (!ids_.emplace(id, i).second) fields.refuse("id", "'" + id + "' is there twice; rename one");
    }
  }

  const Known& node_of(const Fields& fields, const std::string& key, const Json& id) {
    if (!id.is_string()) fields.refuse(key, "the id of a node is expected, not " + id.dump());
    const auto found = ids_.find(id.get<std::string>());
    if (found == ids_.end()) fields.refuse(key, "there is no node " + id.dump() + "; add it or name another");
    const std::size_t i = found->second;
    if (const auto known = known_.find(i); known != known_.end()) return known->second;
    if (!open_.insert(i).second) fields.refuse(key, "node " + id.dump() + " refers back to itself; break the circle");
    const auto require_depth = [&](std::size_t depth) {
      if (depth > kDeepestNodes) fields.refuse(key, "more than 256 nodes are one within the other; use fewer");
    };
    require_depth(open_.size());
    std::size_t below = 0;
    const auto part = [&](const Fields& at, const std::string& name, const Json& value) {
      const Known& found_part = node_of(at, name, value);
      below = std::max(below, found_part.depth);
      return found_part.shape;
    };
    Fields own((*nodes_)[i], file_, path_in("nodes", i));
    own.text("id");
    const NodeReader reader = {
        *builder_,
        [&](const Fields& at, const std::string& name, const Json& value) { return number(at, name, value); }, part};
    NodeShape shape = read_node(own, reader);
    shape.shape = once_at_each_place(std::move(shape.shape));
    open_.erase(i);
    require_depth(below + 1);
    return known_.emplace(i, Known{std::move(shape), below + 1}).first->second;
  }

  Scalar number(const Fields& fields, const std::string& key, const Json& value) {
    if (value.is_number() && std::isfinite(value.get<double>())) return builder_->constant(value.get<double>());
    if (!value.is_string())
      fields.refuse(key, "a number or an expression of parameters is expected, not " + value.dump());
    try {
      const auto named = [&](std::string_view name) {
        const auto found = numbers_.find(name);
        if (found == numbers_.end()) {
          throw ExpressionError{"there is no parameter '" + std::string(name) + "'; add it or name another"};
        }
        return builder_->parameter(found->second);
      };
      const Scalar result = parse_expression(value.get<std::string>(), *builder_, named);
      if (!std::isfinite(builder_->by_default(result))) fields.refuse(key, "is not finite by default; mend it");
      return result;
    } catch (const ExpressionError& error) {
      fields.refuse(key, error.what);
    }
  }

  std::vector<double> defaults() const {
    std::vector<double> values;
    for (const TemplateParameter& parameter : content_->parameters) values.push_back(parameter.value);
    return values;
  }

  std::string file_;
  std::shared_ptr<Template::Content> content_ = std::make_shared<Template::Content>();
  std::optional<TapeBuilder> builder_;
  std::map<std::string, int, std::less<>> numbers_;
  const Json* nodes_ = nullptr;
  std::map<std::string, std::size_t> ids_;
  std::map<std::size_t, Known> known_;
  std::set<std::size_t> open_;
};

Template::Template(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
Template::Template(const Template&) = default;
Template::Template(Template&&) noexcept = default;
Template& Template::operator=(const Template&) = default;
Template& Template::operator=(Template&&) noexcept = default;
Template::~Template() = default;

const std::string& Template::name() const { return content_->name; }
const std::string& Template::description() const { return content_->description; }
char Template::up() const { return content_->up; }
const std::vector<TemplateParameter>& Template::parameters() const { return content_->parameters; }

const Tape& Template::tape() const {
  refuse_function(content_->function, name(), "has no tape; call field()");
  return content_->tape;
}

std::string Template::text() const {
  refuse_function(content_->function, name(), "has no text; write it by the program that made it");
  return content_->document.dump(2) + "\n";
}

std::unique_ptr<FieldStep> Template::field(const Backend& backend) const {
  if (content_->function) return std::make_unique<FunctionField>(content_->function, parameters());
  return backend.field(content_->tape);
}

int Template::parameter(std::string_view name) const {
  std::vector<std::string> names;
  for (const TemplateParameter& parameter : parameters()) {
    if (parameter.name == name) return static_cast<int>(names.size());
    names.push_back(parameter.name);
  }
  throw InvalidInput("template " + content_->name + ": there is no parameter '" + std::string(name) + "'; there are " +
                     listed(names));
}

Eigen::VectorXd Template::defaults() const {
  Eigen::VectorXd values(static_cast<Eigen::Index>(parameters().size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = parameters()[static_cast<std::size_t>(i)].value;
  return values;
}

Template template_of(const std::string& name, const std::vector<TemplateParameter>& parameters, FieldFunction function,
                     char up) {
  const std::string caller = "template_of: ";
  if (!function) throw InvalidInput(caller + "function: there is none; give one");
  if (up != 'x' && up != 'y' && up != 'z') {
    throw InvalidInput(caller + "up: '" + std::string(1, up) + "' is not x, y or z");
  }
  std::set<std::string> names;
  for (const TemplateParameter& p : parameters) {
    const std::string at = caller + "parameters: '" + p.name + "': ";
    if (!is_parameter_name(p.name))
      throw InvalidInput(at + "no name: letters, digits and underscores, none of a function");
    if (!names.insert(p.name).second) throw InvalidInput(at + "there twice; rename one");
    if (!(p.least < p.most && p.value >= p.least && p.value <= p.most && std::isfinite(p.most - p.least))) {
      throw InvalidInput(at + digits(p.value) + " is not from " + digits(p.least) + " to " + digits(p.most) +
                         ", bounds that differ and are finite; mend them");
    }
  }
  auto content = std::make_shared<Template::Content>();
  content->name = name;
  content->up = up;
  content->parameters = parameters;
  content->function = std::move(function);
  return Template(std::move(content));
}

Template parse_template(std::string_view text, const std::string& name) { return TemplateReader(text, name).read(); }

}  // namespace swage

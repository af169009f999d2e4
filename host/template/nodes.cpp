#include "nodes.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace swage {
namespace {

constexpr std::size_t kManyParts = 256;
constexpr int kManyCopies = 64;
constexpr std::size_t kManyCorners = 256;

/// What one node reads, in the words of its type.
class Node {
 public:
  Node(Fields& fields, const NodeReader& reader) : fields_(fields), reader_(reader) {}

  Scalar constant(double value) const { return reader_.builder.constant(value); }
  Scalar number(const char* key) { return read(key, fields_.get(key)); }
  Scalar number(const char* key, double otherwise) { return fields_.may_have(key) ? number(key) : constant(otherwise); }
  /// Above 0 by default; where parameters bring it down, it counts as next to nothing.
  Scalar size(const char* key) { return above_zero(key, number(key)); }
  Scalar at_least_zero(const char* key) {
    const Scalar value = number(key, 0);
    if (reader_.builder.by_default(value) < 0) fields_.refuse(key, "is below 0 by default; make it 0 or more");
    return is_nothing(value) ? value : max(value, 0);
  }
  Point point(const char* key) {
    const Json& list = fields_.list(key, 3, 3);
    return {read(key, list[0], 0), read(key, list[1], 1), read(key, list[2], 2)};
  }
  Point sizes(const char* key) {
    Point all = point(key);
    for (Scalar& one : all) one = above_zero(key, one);
    return all;
  }
  std::vector<Scalar> numbers(const char* key, std::size_t least) {
    std::vector<Scalar> all;
    for (const Json& one : fields_.list(key, least, kManyCorners)) all.push_back(read(key, one, all.size()));
    return all;
  }
  std::vector<Corner> corners(const char* key) {
    std::vector<Corner> all;
    for (const Json& one : fields_.list(key, 3, kManyCorners)) {
      const std::string at = indexed(key, all.size());
      if (!one.is_array() || one.size() != 2) fields_.refuse(at, "two numbers in brackets are expected");
      all.push_back({reader_.number(fields_, at + "[0]", one[0]), reader_.number(fields_, at + "[1]", one[1])});
    }
    return all;
  }
  int axis(const char* key = "axis") { return axis_named(fields_.choice(key, {"x", "y", "z"}, "y")); }
  int count() { return fields_.integer("count", 1, kManyCopies); }

  NodeShape part() { return reader_.node(fields_, "of", fields_.get("of")); }
  Shape flat_part() {
    const NodeShape found = part();
    if (!found.is_flat) fields_.refuse("of", "a flat shape is expected: circle, rectangle or polygon");
    return found.shape;
  }
  /// All flat, or none.
  std::vector<NodeShape> parts(std::size_t least, std::size_t most) {
    std::vector<NodeShape> all;
    for (const Json& id : fields_.list("of", least, most)) {
      all.push_back(reader_.node(fields_, indexed("of", all.size()), id));
      if (all.back().is_flat != all.front().is_flat) {
        fields_.refuse(indexed("of", all.size() - 1), "flat shapes and bodies do not go together; extrude or revolve");
      }
    }
    return all;
  }
  /// A body, as those that turn and bend.
  Shape body() {
    const NodeShape found = part();
    if (found.is_flat) fields_.refuse("of", "is flat; extrude or revolve it first");
    return found.shape;
  }

  Fields& fields() { return fields_; }

 private:
  static int axis_named(const std::string& name) { return name[0] - 'x'; }
  static std::string indexed(const char* key, std::size_t i) {
    return std::string(key) + "[" + std::to_string(i) + "]";
  }
  bool is_nothing(Scalar value) const { return value.id == reader_.builder.constant(0).id; }
  Scalar read(const char* key, const Json& value) { return reader_.number(fields_, key, value); }
  Scalar read(const char* key, const Json& value, std::size_t i) {
    return reader_.number(fields_, indexed(key, i), value);
  }
  Scalar above_zero(const char* key, Scalar value) const {
    if (!(reader_.builder.by_default(value) > 0)) fields_.refuse(key, "is not above 0 by default; make it larger");
    return max(value, 1e-6);
  }

  Fields& fields_;
  const NodeReader& reader_;
};

NodeShape body(Shape shape) { return {std::move(shape), false}; }
NodeShape flat(Shape shape) { return {std::move(shape), true}; }

using Combine = Shape (*)(const std::vector<Shape>&, Scalar);

NodeShape combined(Node& node, Combine combine) {
  std::vector<Shape> shapes;
  const std::vector<NodeShape> parts = node.parts(1, kManyParts);
  shapes.reserve(parts.size());
  for (const NodeShape& part : parts) shapes.push_back(part.shape);
  return {combine(shapes, node.at_least_zero("radius")), parts[0].is_flat};
}

using ReadNode = NodeShape (*)(Node&);

const std::map<std::string, ReadNode>& types() {
  static const std::map<std::string, ReadNode> kTypes = {
      {"sphere", [](Node& n) { return body(sphere(n.size("radius"))); }},
      {"ellipsoid", [](Node& n) { return body(ellipsoid(n.sizes("radii"))); }},
      {"box", [](Node& n) { return body(box(n.sizes("size"), n.at_least_zero("rounding"))); }},
      {"cylinder",
       [](Node& n) {
         return body(cylinder(n.axis(), n.size("radius"), n.size("height"), n.at_least_zero("rounding")));
       }},
      {"capsule", [](Node& n) { return body(capsule(n.point("from"), n.point("to"), n.size("radius"))); }},
      {"cone",
       [](Node& n) {
         return body(cone(n.axis(), n.at_least_zero("bottom"), n.at_least_zero("top"), n.size("height")));
       }},
      {"torus", [](Node& n) { return body(torus(n.axis(), n.size("radius"), n.size("tube"))); }},
      {"plane", [](Node& n) { return body(plane(n.point("normal"), n.number("offset", 0))); }},
      {"lathe",
       [](Node& n) {
         const std::vector<Scalar> heights = n.numbers("heights", 2), radii = n.numbers("radii", 2);
         if (heights.size() != radii.size()) n.fields().refuse("radii", "is not as long as heights; give one for each");
         return body(lathe(n.axis(), heights, radii));
       }},
      {"circle", [](Node& n) { return flat(circle(n.size("radius"))); }},
      {"rectangle",
       [](Node& n) { return flat(rectangle(n.size("width"), n.size("height"), n.at_least_zero("rounding"))); }},
      {"polygon", [](Node& n) { return flat(polygon(n.corners("corners"))); }},
      {"extrude", [](Node& n) { return body(extrude(n.flat_part(), n.axis(), n.size("height"))); }},
      {"revolve", [](Node& n) { return body(revolve(n.flat_part(), n.axis(), n.number("offset", 0))); }},
      {"union", [](Node& n) { return combined(n, unite); }},
      {"intersection", [](Node& n) { return combined(n, intersect); }},
      {"difference", [](Node& n) { return combined(n, subtract); }},
      {"morph",
       [](Node& n) {
         const std::vector<NodeShape> parts = n.parts(2, 2);
         return NodeShape{morph(parts[0].shape, parts[1].shape, n.number("weight")), parts[0].is_flat};
       }},
      {"shell",
       [](Node& n) {
         const NodeShape part = n.part();
         return NodeShape{shell(part.shape, n.size("thickness")), part.is_flat};
       }},
      {"offset",
       [](Node& n) {
         const NodeShape part = n.part();
         return NodeShape{offset(part.shape, n.number("by")), part.is_flat};
       }},
      {"translate",
       [](Node& n) {
         const NodeShape part = n.part();
         return NodeShape{translate(part.shape, n.point("by")), part.is_flat};
       }},
      {"rotate", [](Node& n) { return body(rotate(n.body(), n.point("direction"), n.number("angle"))); }},
      {"scale",
       [](Node& n) {
         const NodeShape part = n.part();
         return NodeShape{scale(part.shape, n.sizes("by")), part.is_flat};
       }},
      {"mirror", [](Node& n) { return body(mirror(n.body(), n.axis())); }},
      {"repeat", [](Node& n) { return body(repeat(n.body(), n.axis(), n.count(), n.number("spacing"))); }},
      {"repeat_around", [](Node& n) { return body(repeat_around(n.body(), n.axis(), n.count())); }},
      {"taper",
       [](Node& n) {
         return body(taper(n.body(), n.axis(), n.number("from"), n.number("to"), n.size("bottom"), n.size("top")));
       }},
      {"twist", [](Node& n) { return body(twist(n.body(), n.axis(), n.number("rate"))); }},
      {"bend",
       [](Node& n) {
         const int axis = n.axis(), towards = n.axis("towards");
         if (axis == towards) n.fields().refuse("towards", "is the axis itself; name another, or twist");
         return body(bend(n.body(), axis, towards, n.number("rate")));
       }},
      {"shear",
       [](Node& n) {
         const int axis = n.axis(), along = n.axis("along");
         if (axis == along) n.fields().refuse("along", "is the axis itself; name another");
         return body(shear(n.body(), axis, along, n.number("amount")));
       }},
  };
  return kTypes;
}

}  // namespace

NodeShape read_node(Fields& fields, const NodeReader& reader) {
  const std::string type = fields.text("type");
  const auto found = types().find(type);
  if (found == types().end()) {
    std::vector<std::string> names;
    for (const auto& [name, read] : types()) names.push_back(name);
    fields.refuse("type", "'" + type + "' is none of " + listed(names));
  }
  Node node(fields, reader);
  NodeShape shape = found->second(node);
  fields.end();
  return shape;
}

}  // namespace swage

// The nodes of a template's graph: what each type reads, and the shape that it makes.
#pragma once

#include <functional>
#include <string>

#include "fields.h"
#include "shapes.h"

namespace swage {

/// A shape in the plane is there to be extruded or revolved.
struct NodeShape {
  Shape shape;
  bool is_flat;
};

/// What nodes are read with.
struct NodeReader {
  TapeBuilder& builder;
  /// A number or an expression of parameters. Throws UnreadableFile, naming the key in the fields.
  std::function<Scalar(const Fields& fields, const std::string& key, const Json& value)> number;
  /// The node of that name.
  std::function<NodeShape(const Fields& fields, const std::string& key, const Json& id)> node;
};

/// Of a node's object. Throws UnreadableFile.
NodeShape read_node(Fields& fields, const NodeReader& reader);

}  // namespace swage

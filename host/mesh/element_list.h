// What keeps its shape: elements and their edges.
#pragma once

#include <cstddef>
#include <vector>

#include "swage/mesh.h"
#include "swage/steps.h"

namespace swage {

struct Elements {
  PairsRest pairs;             ///< Its vertices: the mesh's, then those of what joins or fills it.
  std::vector<int> of_vertex;  ///< An element that has the vertex; of vertices of none, -1.
};

struct WeightedEdge {
  int first, second;  ///< First below second.
  double weight;
};

/// Elements one after another. An edge added twice to one is there once, of both weights.
class ElementList {
 public:
  explicit ElementList(Eigen::Index vertex_count) : of_vertex_(static_cast<size_t>(vertex_count), -1) {}

  /// An edge of the element that is open. From a vertex to itself there is none.
  void add(int i, int j, double weight);
  void close();

  /// The number of the element that is open.
  int next() const { return static_cast<int>(offsets_.size()) - 1; }
  int& of_vertex(int v) { return of_vertex_[static_cast<size_t>(v)]; }

  /// All of them; the list is empty then.
  Elements take(const Positions& vertices);

 private:
  std::vector<WeightedEdge> open_, edges_;
  std::vector<int> offsets_{0}, of_vertex_;
};

/// #T × 9: of each triangle the mean of the matrices of its corners' elements.
Transforms matrices_of_triangles(const Elements& elements, const Triangles& triangles, const Transforms& matrices);

/// Memory that they take.
std::size_t bytes(const PairsRest& pairs);

/// sum over elements n and their edges of w |e - M_n e0|², e0 the edge at rest.
double edge_energy(const PairsRest& pairs, const Positions& positions, const Transforms& matrices);

}  // namespace swage

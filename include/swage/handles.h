// What the user asks for: vertices and where they shall go.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swage/mesh.h"
#include "swage/mesh_io.h"

#pragma GCC visibility push(default)
namespace swage {

/// Handles of one edit. A handle whose target is its rest position is an anchor.
struct Gesture {
  std::string label;
  std::map<int, Eigen::Vector3d> targets;  ///< Vertex → target position in mesh units.

  /// Throws InvalidInput where the vertex already has another target.
  void add(int vertex, const Eigen::Vector3d& target);
};

/// Throws InvalidInput where there is no handle, and, naming the vertex, where one is not a vertex of the mesh or its
/// target is not finite.
void check(const Gesture& gesture, const PositionsRef& positions, const TrianglesRef& triangles);

/// Reads the gestures of a `.deform` file: a JSON list of {label, displacements: {vertex: [dx, dy, dz]}}, with
/// displacements in units of the box diagonal of `rest`. Throws UnreadableFile, naming the gesture and vertex.
std::vector<Gesture> read_gestures(const std::filesystem::path& path, const PositionsRef& rest);

/// Writes gestures as read_gestures reads them. Throws UnwritableFile.
void write_gestures(const std::filesystem::path& path, const std::vector<Gesture>& gestures, const PositionsRef& rest);

/// Reads chains of vertices that stay straight: one a line, vertex indices from 0 separated by blanks.
/// Throws UnreadableFile, naming the line, where an index is malformed or outside [0, vertex_count), or a chain
/// visits a vertex twice in a row.
std::vector<std::vector<int>> read_straight_chains(const std::filesystem::path& path, int vertex_count);

/// Writes chains as read_straight_chains reads them. Throws InvalidInput where one is empty, holds a negative index or
/// visits a vertex twice in a row, and UnwritableFile.
void write_straight_chains(const std::filesystem::path& path, const std::vector<std::vector<int>>& chains);

/// A set of vertices described in words, one of these or several joined by & (and):
/// - `12,40-52`: vertices and ranges of vertices
/// - `@file`: vertex indices in a file, separated by white space or commas
/// - `box:x0,y0,z0,x1,y1,z1`: inside a box, mesh units
/// - `x<1.2`, `z>=90%`: half space; in percent of the bounding box along that axis
/// - `component:N`: the N-th connected component,
///   from 0, in the order of their first vertices
/// - `group:NAME`: an OBJ group
class Selection {
 public:
  /// Throws InvalidInput, quoting the part that is not understood.
  explicit Selection(std::string_view text);
  ~Selection();
  Selection(Selection&&) noexcept;
  Selection& operator=(Selection&&) noexcept;

  /// The vertices selected, ascending. Throws InvalidInput where a vertex, component or group does not exist or
  /// nothing is selected, and UnreadableFile for a bad `@file`.
  std::vector<int> vertices(const MeshFile& file) const;

  /// Where only a box and half spaces are joined, what of the mesh's bounding box they have in common; it may hold no
  /// vertex. None for other selections. Throws InvalidInput where they have nothing in common.
  std::optional<Eigen::AlignedBox3d> region(const MeshFile& file) const;

 private:
  struct Term;
  std::string text_;
  std::vector<std::unique_ptr<Term>> terms_;
};

}  // namespace swage
#pragma GCC visibility pop

// What a reader finds in a file, and the mesh made of it.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "input.h"
#include "source.h"
#include "swage/mesh_io.h"

namespace swage {

/// Tells the first few places of each kind of trouble, and the number of the others.
class Warnings {
 public:
  void add(const Input& input, size_t offset, const std::string& what);
  std::vector<std::string> told() const;

 private:
  struct Kind {
    std::string what;
    std::vector<std::string> places;
    size_t count = 0;
  };
  std::vector<Kind> kinds_;
};

struct Draft {
  std::vector<double> coordinates;  ///< Three a vertex.
  std::vector<std::vector<int>> polygons;
  std::vector<size_t> polygon_offsets;            ///< In the bytes, for messages.
  std::vector<std::pair<int, int>> normal_users;  ///< (normal, polygon), polygons ascending.
  std::map<std::string, std::vector<int>> groups;
  std::string skipped_face;  ///< Place of the first.
  Warnings warnings;
  MeshSource source;

  int vertex_count() const { return static_cast<int>(coordinates.size() / 3); }
};

/// A new vertex, and its number.
int add_vertex(const Input& input, Draft& draft, const Eigen::Vector3d& position, size_t offset);
/// Where coordinates of a vertex stand.
void add_point(Draft& draft, int vertex, const Slots& slots);
/// False, with a warning, where there are fewer than three corners.
bool add_polygon(const Input& input, Draft& draft, const std::vector<int>& corners, size_t offset);
/// The vertex of a file whose vertices are numbered from 0. Refuses an index outside [0, count).
int checked_index(const Input& input, size_t offset, long long index, long long count);
/// Refuses a count of things, at least `bytes_each` long, that the bytes left cannot hold.
void require_room(const Input& input, size_t offset, const std::string& things, long long count, size_t bytes_each,
                  size_t bytes_left);
/// Where normal i is that of vertex i: every polygon around the vertex uses it.
void use_vertex_normals(Draft& draft);

void read_obj(Input& input, Draft& draft);
void read_ply(Input& input, Draft& draft);
void read_stl(Input& input, Draft& draft);
void read_off(Input& input, Draft& draft);

/// Triangulates. Refuses a draft without triangles.
MeshFile finish(Input&& input, Draft&& draft);

}  // namespace swage

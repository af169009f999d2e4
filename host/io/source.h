// Where in a file's bytes the numbers stand that an edit changes.
#pragma once

#include <string>
#include <vector>

#include "adjacency.h"
#include "number.h"
#include "swage/mesh_io.h"

namespace swage {

struct MeshSource {
  MeshFormat format = MeshFormat::obj;
  std::string bytes;
  std::vector<Slots> points;        ///< A vertex may stand at several: STL repeats it at each corner.
  std::vector<int> point_vertices;  ///< Vertex of each point.
  std::vector<Slots> normals;
  Lists normal_polygons;       ///< Polygons that use each normal, ascending; one may come twice in a row.
  bool facet_normals = false;  ///< Normals follow from their polygons alone (STL).
  int vertex_count = 0;
  size_t polygon_count = 0;
  std::vector<size_t> face_offsets;  ///< Of each polygon the f statement (OBJ).
};

/// The file's bytes with other coordinates and normals.
std::string written_back(const MeshSource& source, const std::vector<std::vector<int>>& polygons,
                         const PositionsRef& positions);

}  // namespace swage

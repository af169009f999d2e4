#include "neighbourhoods.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "adjacency.h"
#include "measures.h"
#include "swage/error.h"

namespace swage {
namespace {

// Coefficients of a fit, and so the fewest neighbours that can tell it.
constexpr size_t kFewestNeighbours = 5;
// A neighbour whose normal is at a right angle to the vertex's, or beyond, is not on the same sheet of the surface.
// Above 0, so that rounding does not decide about right angles.
constexpr double kFacing = 1e-6;
// A ring grows no further from more edges than this: around the hub of a large fan, every vertex would see every other.
constexpr int kMostEdges = 2000;

Positions vertex_normals(const Mesh& mesh) {
  const Positions areas = area_vectors(mesh.positions, mesh.triangles);
  Positions normals = Positions::Zero(mesh.positions.rows(), 3);
  for (Eigen::Index t = 0; t < areas.rows(); ++t) {
    for (int k = 0; k < 3; ++k) normals.row(mesh.triangles(t, k)) += areas.row(t);
  }
  normals.rowwise().normalize();
  return normals;
}

/// Finds the vertices within some edges of a vertex.
class Rings {
 public:
  explicit Rings(const Mesh& mesh)
      : near_(one_rings(edges_of(mesh.triangles), static_cast<int>(mesh.positions.rows()))),
        seen_from_(static_cast<size_t>(mesh.positions.rows()), -1) {}

  /// Nearest rings first, the vertex itself left out.
  std::vector<int> around(int vertex, int rings) {
    std::vector<int> found{vertex};
    seen_from_[static_cast<size_t>(vertex)] = vertex;
    size_t inner = 0;
    for (int ring = 0; ring < rings && inner < found.size(); ++ring) {
      const size_t outer = found.size();
      if (ring > 0 && edges_at(found, inner) > kMostEdges) break;
      for (; inner < outer; ++inner) add_neighbours(vertex, found[inner], found);
    }
    found.erase(found.begin());
    return found;
  }

 private:
  long edges_at(const std::vector<int>& found, size_t inner) const {
    long count = 0;
    for (size_t i = inner; i < found.size(); ++i) count += near_[found[i]].size();
    return count;
  }
  void add_neighbours(int vertex, int of, std::vector<int>& found) {
    for (int neighbour : near_[of]) {
      int& from = seen_from_[static_cast<size_t>(neighbour)];
      if (std::exchange(from, vertex) != vertex) found.push_back(neighbour);
    }
  }

  Lists near_;
  std::vector<int> seen_from_;
};

/// The neighbours that face the vertex's way, or all where those would be too few.
std::vector<int> facing(int vertex, const Positions& normals, const std::vector<int>& neighbours) {
  std::vector<int> kept;
  std::copy_if(neighbours.begin(), neighbours.end(), std::back_inserter(kept),
               [&](int neighbour) { return normals.row(vertex).dot(normals.row(neighbour)) > kFacing; });
  return kept.size() < kFewestNeighbours ? neighbours : kept;
}

}  // namespace

CurvatureStep::Rest neighbourhoods(const Mesh& mesh, int rings) {
  CurvatureStep::Rest rest{mesh.positions, vertex_normals(mesh), {0}, {}};
  Rings finder(mesh);
  for (int v = 0; v < mesh.positions.rows(); ++v) {
    // A vertex of triangles without area has no normal, hence no plane to fit over.
    if (!rest.normals.row(v).isZero(0)) {
      const std::vector<int> kept = facing(v, rest.normals, finder.around(v, rings));
      rest.neighbours.insert(rest.neighbours.end(), kept.begin(), kept.end());
    }
    if (rest.neighbours.size() > static_cast<size_t>(std::numeric_limits<int>::max())) {
      throw InvalidInput("rings: neighbourhoods of " + std::to_string(rings) +
                         " rings are too large for this mesh; use fewer");
    }
    rest.offsets.push_back(static_cast<int>(rest.neighbours.size()));
  }
  return rest;
}

}  // namespace swage

// Creases and boundaries, the lines they make, and the points where these must stay.
#include <CGAL/Polygon_mesh_processing/connected_components.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "surface.h"

namespace swage {
namespace {

double turn(const Surface& surface, Edge edge) {
  const HalfEdge side = surface.halfedge(edge);
  const auto one = area_vector(surface, surface.face(side));
  const auto other = area_vector(surface, surface.face(surface.opposite(side)));
  return std::atan2(std::sqrt(CGAL::cross_product(one, other).squared_length()), one * other);
}

using Line = std::vector<Vertex>;  ///< First and last are the same where it is closed.

/// Follows feature edges from one kept vertex to the next, or around.
class Lines {
 public:
  Lines(const Surface& surface, const Features& features) : kept_(features.vertices) {
    neighbours_.resize(surface.number_of_vertices());
    for (const Edge edge : surface.edges()) {
      if (!features.edges[edge] && !surface.is_border(edge)) continue;
      const Vertex a = surface.vertex(edge, 0), b = surface.vertex(edge, 1);
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(a);
    }
  }

  bool is_end(Vertex vertex) const { return !neighbours_[vertex].empty() && neighbours_[vertex].size() != 2; }

  std::vector<Line> all(const Surface& surface) {
    std::vector<Line> lines;
    for (const bool from_kept : {true, false}) {
      for (const Vertex vertex : surface.vertices()) {
        if (kept_[vertex] != from_kept) continue;
        while (!neighbours_[vertex].empty()) lines.push_back(line_from(vertex));
      }
    }
    return lines;
  }

 private:
  /// Strikes out the edges that it takes.
  Line line_from(Vertex start) {
    Line line{start};
    do {
      const Vertex from = line.back(), to = neighbours_[from].front();
      erase(from, to);
      erase(to, from);
      line.push_back(to);
    } while (!kept_[line.back()] && line.back() != start);
    return line;
  }
  void erase(Vertex from, Vertex to) {
    auto& list = neighbours_[from];
    list.erase(std::find(list.begin(), list.end(), to));
  }

  const Map<Vertex, bool> kept_;
  std::vector<std::vector<Vertex>> neighbours_;
};

/// Keeps the vertices of line[first, last] that its straight would miss (Douglas, Peucker 1973).
void keep_bends(const Surface& surface, const Line& line, std::size_t first, std::size_t last, double tolerance,
                Map<Vertex, bool> kept) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    const Kernel::Segment_3 straight(surface.point(line[a]), surface.point(line[b]));
    double farthest = tolerance * tolerance;
    std::size_t at = a;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double distance = CGAL::squared_distance(straight, surface.point(line[i]));
      if (distance > farthest) std::tie(farthest, at) = std::pair(distance, i);
    }
    if (at == a) continue;
    kept[line[at]] = true;
    open.insert(open.end(), {{a, at}, {at, b}});
  }
}

void keep_bends(const Surface& surface, const Line& line, double tolerance, Map<Vertex, bool> kept) {
  std::size_t middle = 0;
  if (line.front() == line.back()) {
    const auto away = [&](Vertex v) { return CGAL::squared_distance(surface.point(v), surface.point(line.front())); };
    const auto farthest =
        std::max_element(line.begin(), line.end(), [&](Vertex v, Vertex w) { return away(v) < away(w); });
    middle = static_cast<std::size_t>(farthest - line.begin());
  }
  kept[line.front()] = kept[line.back()] = kept[line[middle]] = true;
  if (middle > 0) keep_bends(surface, line, 0, middle, tolerance, kept);
  keep_bends(surface, line, middle, line.size() - 1, tolerance, kept);
}

}  // namespace

std::vector<Vertex> joined_vertices(const Surface& surface) {
  std::map<Point, std::vector<Vertex>> at_place;
  for (const Vertex vertex : surface.vertices()) at_place[surface.point(vertex)].push_back(vertex);
  std::vector<Vertex> joined;
  for (const auto& [place, vertices] : at_place) {
    if (vertices.size() > 1) joined.insert(joined.end(), vertices.begin(), vertices.end());
  }
  return joined;
}

Features features_of(Surface& surface, double angle, double tolerance) {
  Features features{surface.add_property_map<Edge, bool>("e:feature", false).first,
                    surface.add_property_map<Vertex, bool>("v:kept", false).first,
                    surface.add_property_map<Face, std::size_t>("f:patch", 0).first};
  Map<Edge, bool> edges = features.edges;
  Map<Vertex, bool> kept = features.vertices;
  for (const Edge edge : surface.edges()) edges[edge] = !surface.is_border(edge) && turn(surface, edge) > angle;
  for (const Vertex vertex : joined_vertices(surface)) kept[vertex] = true;
  Lines lines(surface, features);
  for (const Vertex vertex : surface.vertices()) kept[vertex] = kept[vertex] || lines.is_end(vertex);
  for (const Line& line : lines.all(surface)) keep_bends(surface, line, tolerance, kept);
  CGAL::Polygon_mesh_processing::connected_components(surface, features.patches,
                                                      CGAL::parameters::edge_is_constrained_map(edges));
  return features;
}

}  // namespace swage

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "surface.h"

namespace swage {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

constexpr int kLevels = 3;                                      // Each halves the length.
constexpr double kSmallestAngle = 20 * std::numbers::pi / 180;  // A triangle with a smaller one is badly shaped,
constexpr double kAway = 0.1;                                   // and one this many lengths from the surface is off.
constexpr double kLowest = 1.0 / 40;                            // Lengths: no level would help a flatter one.
constexpr int kRings = 2;                                       // Of triangles around one that is to be finer.

/// The surface as it was, patch by patch.
class Original {
 public:
  Original(const Surface& surface, const Features& features) {
    for (const Face face : surface.faces()) {
      const std::size_t patch = features.patches[face];
      if (patch >= patches_.size()) patches_.resize(patch + 1);
      const auto [a, b, c] = corners(surface, face);
      const Kernel::Triangle_3 triangle(a, b, c);
      if (!triangle.is_degenerate()) patches_[patch].push_back(triangle);
    }
    for (const auto& patch : patches_) trees_.push_back(std::make_unique<Tree>(patch.begin(), patch.end()));
  }

  Point closest(std::size_t patch, const Point& point) const {
    return trees_[patch]->empty() ? point : trees_[patch]->closest_point(point);
  }

 private:
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Tree =
      CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;
  std::vector<Triangles> patches_;
  std::vector<std::unique_ptr<Tree>> trees_;
};

class Remesher {
 public:
  Remesher(Surface& surface, const Features& features, const Sizes& sizes)
      : surface_(surface), features_(features), sizes_(sizes), original_(surface, features) {}

  void run() {
    remesh(all_faces(), sizes_.edge_length);
    for (int level = 1; level <= kLevels; ++level) {
      const double length = std::ldexp(sizes_.edge_length, -level);
      const std::vector<Face> faces = around(unfit(2 * length), length);
      if (faces.empty()) return;
      remesh(faces, length);
      constexpr int kBlending = 3;
      isotropic(all_faces(), 0, kBlending);
    }
  }

 private:
  std::vector<Face> all_faces() const { return {surface_.faces().begin(), surface_.faces().end()}; }

  void remesh(std::vector<Face> faces, double length) {
    split_copies(faces, 4.0 / 3 * length);  // No longer than the isotropic remesher lets edges be.
    Map<Vertex, bool> kept = features_.vertices;
    for (const Vertex vertex : joined_vertices(surface_)) kept[vertex] = true;
    isotropic(faces, length, sizes_.iterations);
  }

  /// Where the surface was cut beside one of the faces all copies of the edge are split, and so alike. Adds faces made.
  void split_copies(std::vector<Face>& faces, double longest) {
    for (const HalfEdge side : copied_sides(faces)) split(side, longest, faces);
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  }

  std::vector<HalfEdge> copied_sides(const std::vector<Face>& faces) const {
    std::map<std::pair<Point, Point>, std::vector<HalfEdge>> copies;
    for (const Edge edge : surface_.edges()) {
      if (!surface_.is_border(edge)) continue;
      const HalfEdge side = surface_.halfedge(edge);
      const Point &a = surface_.point(surface_.source(side)), &b = surface_.point(surface_.target(side));
      copies[std::minmax(a, b)].push_back(surface_.is_border(side) ? surface_.opposite(side) : side);
    }
    std::vector<bool> taken(surface_.num_faces(), false);
    for (const Face face : faces) taken[face] = true;
    std::vector<HalfEdge> copied;
    for (const auto& [ends, sides] : copies) {
      const bool beside = std::any_of(sides.begin(), sides.end(), [&](HalfEdge s) { return taken[surface_.face(s)]; });
      if (sides.size() > 1 && beside) copied.insert(copied.end(), sides.begin(), sides.end());
    }
    return copied;
  }

  void split(HalfEdge side, double longest, std::vector<Face>& made) {
    const Point &a = surface_.point(surface_.source(side)), &b = surface_.point(surface_.target(side));
    if (CGAL::squared_distance(a, b) <= longest * longest) return;
    const Point middle = CGAL::midpoint(a, b);
    Map<Face, std::size_t> patches = features_.patches;
    const std::size_t patch = patches[surface_.face(side)];
    const HalfEdge half = CGAL::Euler::split_edge(side, surface_);
    surface_.point(surface_.target(half)) = middle;
    const HalfEdge across = CGAL::Euler::split_face(half, surface_.next(side), surface_);
    for (const HalfEdge inner : {across, surface_.opposite(across)}) {
      patches[surface_.face(inner)] = patch;
      made.push_back(surface_.face(inner));
    }
    split(half, longest, made);
    split(side, longest, made);
  }

  /// Of length 0: flips and moves vertices only.
  void isotropic(const std::vector<Face>& faces, double length, int iterations) {
    const auto place = [&](Vertex vertex) {
      const HalfEdge side = surface_.halfedge(vertex);
      const Face face = surface_.is_border(side) ? surface_.face(surface_.opposite(side)) : surface_.face(side);
      return original_.closest(features_.patches[face], surface_.point(vertex));
    };
    constexpr int kRelaxations = 3;
    pmp::isotropic_remeshing(faces, length, surface_,
                             CGAL::parameters::number_of_iterations(static_cast<unsigned>(iterations))
                                 .number_of_relaxation_steps(kRelaxations)
                                 .edge_is_constrained_map(features_.edges)
                                 .vertex_is_constrained_map(features_.vertices)
                                 .face_patch_map(features_.patches)
                                 .projection_functor(place));
  }

  double longest_side(Face face) const {
    const auto [a, b, c] = corners(surface_, face);
    return std::sqrt(std::max({(b - a).squared_length(), (c - b).squared_length(), (a - c).squared_length()}));
  }

  bool is_unfit(Face face) const {
    const auto [a, b, c] = corners(surface_, face);
    const double area = twice_area(surface_, face);
    const double cosine = std::max({(b - a) * (c - a), (c - b) * (a - b), (a - c) * (b - c)});
    if (std::atan2(area, cosine) < kSmallestAngle) return area > kLowest * sizes_.edge_length * longest_side(face);
    const Point middle = CGAL::centroid(a, b, c);
    const double away = std::sqrt(CGAL::squared_distance(middle, original_.closest(features_.patches[face], middle)));
    return away > kAway * sizes_.edge_length;
  }

  /// Among those made at this length: not those that blend into coarser ones.
  std::vector<Face> unfit(double length) const {
    constexpr double kSlack = 1.4;
    std::vector<Face> faces;
    for (const Face face : surface_.faces()) {
      if (longest_side(face) < kSlack * length && is_unfit(face)) faces.push_back(face);
    }
    return faces;
  }

  /// With as many rings around as the limit allows at this length; none where it allows not even the faces.
  std::vector<Face> around(const std::vector<Face>& faces, double length) {
    for (int rings = kRings; rings >= 0; --rings) {
      std::vector<Face> wider = with_rings(faces, rings);
      const double others = static_cast<double>(surface_.number_of_faces() - wider.size());
      if (others + triangles_expected(wider, length) < static_cast<double>(sizes_.triangle_limit)) return wider;
    }
    return {};
  }

  double triangles_expected(const std::vector<Face>& faces, double length) const {
    const double equilateral = std::sqrt(3) / 4 * length * length;
    constexpr double kCrowding = 1.3;
    double count = 0;
    for (const Face face : faces) {
      const double area = twice_area(surface_, face) / 2;
      count += std::max(kCrowding * area / equilateral, longest_side(face) / length);
    }
    return count;
  }

  std::vector<Face> with_rings(std::vector<Face> faces, int rings) {
    std::vector<bool> taken(surface_.num_faces(), false);
    for (const Face face : faces) taken[face] = true;
    std::size_t begin = 0;
    for (int ring = 0; ring < rings; ++ring) {
      const std::size_t end = faces.size();
      for (; begin < end; ++begin) {
        for (const HalfEdge side : surface_.halfedges_around_face(surface_.halfedge(faces[begin]))) {
          for (const Face face : surface_.faces_around_target(side)) {
            if (!face.is_valid() || taken[face]) continue;
            taken[face] = true;
            faces.push_back(face);
          }
        }
      }
    }
    return faces;
  }

  Surface& surface_;
  const Features& features_;
  const Sizes& sizes_;
  const Original original_;
};

}  // namespace

void remesh_between(Surface& surface, const Features& features, const Sizes& sizes) {
  Remesher(surface, features, sizes).run();
  surface.collect_garbage();
}

}  // namespace swage

#include "links.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "by_place.h"
#include "measures.h"
#include "nearest.h"
#include "sets.h"

namespace swage {
namespace {

using Eigen::Vector3d;

constexpr double kTouch = 1e-4;     // Of the unit box: how near is together.
constexpr double kRounding = 1e-7;  // Of an edge or a triangle: rounding does not decide whether they cross.
// A contact is as stiff as that many edges of mean length.
constexpr double kContactStiffness = 10;
constexpr double kLinkWeight = 1e-2;  // The paper's w_edge.
constexpr size_t kMostOfTwo = 100;    // Contacts of two components, links of a group: more say nothing new.

/// The mesh, its components, and the tree to ask.
struct Parts {
  const Mesh& mesh;
  std::vector<int> of_vertex;
  int count;
  TriangleTree tree;

  explicit Parts(const Mesh& unit_mesh)
      : mesh(unit_mesh),
        of_vertex(components(unit_mesh.triangles, static_cast<int>(unit_mesh.positions.rows()))),
        count(1 + *std::max_element(of_vertex.begin(), of_vertex.end())),
        tree(unit_mesh.positions, unit_mesh.triangles) {}

  int of_triangle(int t) const { return of_vertex[static_cast<size_t>(mesh.triangles(t, 0))]; }
  Vector3d point(int v) const { return mesh.positions.row(v); }
};

Tie tie(const Mesh& mesh, const std::vector<std::pair<int, double>>& factors, double scale, double weight) {
  Tie result{{}, Eigen::RowVector3d::Zero(), weight};
  for (const auto& [v, factor] : factors) {
    if (factor == 0) continue;
    result.factors.emplace_back(v, scale * factor);
    result.rest += scale * factor * mesh.positions.row(v);
  }
  return result;
}

std::vector<std::pair<int, double>> point_less_foot(const Mesh& mesh, int v, const Foot& foot) {
  std::vector<std::pair<int, double>> factors{{v, 1}};
  for (int k = 0; k < 3; ++k) factors.emplace_back(mesh.triangles(foot.triangle, k), -foot.barycentric[k]);
  return factors;
}

/// Of many every few, in their order.
std::vector<int> some_of(const std::vector<int>& all) {
  const size_t stride = (all.size() + kMostOfTwo - 1) / kMostOfTwo;
  std::vector<int> some;
  for (size_t i = 0; i < all.size(); i += stride) some.push_back(all[i]);
  return some;
}

/// Contacts by the two components that they join, no more of each two than tell enough.
class ContactList {
 public:
  ContactList(const Parts& parts, double scale) : parts_(parts), scale_(scale) {}

  void add(int component, int other, std::vector<std::pair<int, double>> factors) {
    of_two_[std::minmax(component, other)].push_back(std::move(factors));
  }

  std::vector<Tie> ties(Sets& sets) {
    std::vector<Tie> result;
    for (const auto& [two, all] : of_two_) {
      sets.join(two.first, two.second);
      Positions points(static_cast<Eigen::Index>(all.size()), 3);
      for (size_t i = 0; i < all.size(); ++i) points.row(static_cast<Eigen::Index>(i)) = point(all[i]);
      for (const int i : some_of(by_place(points))) {
        result.push_back(tie(parts_.mesh, all[static_cast<size_t>(i)], scale_, kContactStiffness));
      }
    }
    return result;
  }

 private:
  Eigen::RowVector3d point(const std::vector<std::pair<int, double>>& factors) const {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const auto& [v, factor] : factors) sum += std::max(factor, 0.0) * parts_.mesh.positions.row(v);
    return sum;
  }

  const Parts& parts_;
  double scale_;
  std::map<std::pair<int, int>, std::vector<std::vector<std::pair<int, double>>>> of_two_;
};

void find_touches(const Parts& parts, const Poll& poll, ContactList& contacts) {
  for (int v = 0; v < parts.mesh.positions.rows(); ++v) {
    if (v % 1024 == 0) ask(poll);
    const int own = parts.of_vertex[static_cast<size_t>(v)];
    const Foot foot = parts.tree.nearest(parts.point(v), kTouch, [&](int t) { return parts.of_triangle(t) != own; });
    if (foot.triangle < 0) continue;
    contacts.add(own, parts.of_triangle(foot.triangle), point_less_foot(parts.mesh, v, foot));
  }
}

/// Where a segment from a to b crosses a triangle, its ends and sides counted to: how far along, and where in it. None
/// within its plane.
std::optional<std::pair<double, Vector3d>> crossing(const Vector3d& a, const Vector3d& b,
                                                    const std::array<Vector3d, 3>& corners) {
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double from = (a - corners[0]).dot(normal), to = (b - corners[0]).dot(normal);
  if (std::abs(from - to) <= kRounding * (b - a).norm() * normal.norm()) return std::nullopt;
  const double along = from / (from - to);
  if (along < -kRounding || along > 1 + kRounding) return std::nullopt;
  const Vector3d at = a + along * (b - a);
  Vector3d barycentric;
  for (size_t k = 0; k < 3; ++k) {
    const Vector3d& corner = corners[(k + 1) % 3];
    barycentric[static_cast<Eigen::Index>(k)] =
        (corners[(k + 2) % 3] - corner).cross(at - corner).dot(normal) / normal.squaredNorm();
  }
  if (!(barycentric.array() >= -kRounding).all()) return std::nullopt;
  return std::pair(along, barycentric);
}

void find_crossings(const Parts& parts, const Edges& edges, const Poll& poll, ContactList& contacts) {
  const Mesh& mesh = parts.mesh;
  for (int e = 0; e < edges.vertices.rows(); ++e) {
    if (e % 1024 == 0) ask(poll);
    const int v = edges.vertices(e, 0), w = edges.vertices(e, 1), own = parts.of_vertex[static_cast<size_t>(v)];
    const Vector3d a = parts.point(v), b = parts.point(w);
    std::vector<std::pair<int, double>> seen;  // A side is two triangles'.
    parts.tree.near({a.cwiseMin(b), a.cwiseMax(b)}, [&](int t) {
      if (parts.of_triangle(t) == own) return;
      const Eigen::RowVector3i corners = mesh.triangles.row(t);
      const auto found = crossing(a, b, {parts.point(corners[0]), parts.point(corners[1]), parts.point(corners[2])});
      if (!found) return;
      const auto& [along, barycentric] = *found;
      const int other = parts.of_triangle(t);
      const auto is_same = [&, place = along](const auto& one) {
        return one.first == other && std::abs(one.second - place) <= 2 * kRounding;
      };
      if (std::any_of(seen.begin(), seen.end(), is_same)) return;
      seen.emplace_back(other, along);
      std::vector<std::pair<int, double>> factors{{v, 1 - along}, {w, along}};
      for (int k = 0; k < 3; ++k) factors.emplace_back(corners[k], -barycentric[k]);
      contacts.add(own, other, std::move(factors));
    });
  }
}

/// Of each vertex the nearest point of another group.
std::vector<Foot> feet_on_others(const Parts& parts, const std::vector<int>& group_of_part, const Poll& poll) {
  std::vector<Foot> feet(static_cast<size_t>(parts.mesh.positions.rows()));
  const auto group = [&](int part) { return group_of_part[static_cast<size_t>(part)]; };
  for (int v = 0; v < parts.mesh.positions.rows(); ++v) {
    if (v % 1024 == 0) ask(poll);
    const int own = group(parts.of_vertex[static_cast<size_t>(v)]);
    feet[static_cast<size_t>(v)] = parts.tree.nearest(parts.point(v), std::numeric_limits<double>::infinity(),
                                                      [&](int t) { return group(parts.of_triangle(t)) != own; });
  }
  return feet;
}

/// Links each group's vertices that face another nearly as near as the nearest does.
void link_once(const Parts& parts, double mean_length, const Poll& poll, Sets& sets, Links& links) {
  std::vector<int> group_of_part(static_cast<size_t>(parts.count));
  for (int part = 0; part < parts.count; ++part) group_of_part[static_cast<size_t>(part)] = sets.of(part);
  const std::vector<Foot> feet = feet_on_others(parts, group_of_part, poll);
  const auto group_of = [&](size_t v) { return group_of_part[static_cast<size_t>(parts.of_vertex[v])]; };
  std::map<int, double> nearest;
  for (size_t v = 0; v < feet.size(); ++v) {
    double& least = nearest.try_emplace(group_of(v), std::numeric_limits<double>::infinity()).first->second;
    least = std::min(least, feet[v].distance);
  }
  std::map<int, std::vector<int>> facing;
  for (const int v : by_place(parts.mesh.positions)) {
    const auto at = static_cast<size_t>(v);
    if (feet[at].distance <= 1.5 * nearest[group_of(at)] + mean_length) facing[group_of(at)].push_back(v);
  }
  for (const auto& [group, vertices] : facing) {
    for (const int v : some_of(vertices)) {
      const Foot& foot = feet[static_cast<size_t>(v)];
      const double gap = std::max(foot.distance, 0.1 * mean_length);
      links.ties.push_back(tie(parts.mesh, point_less_foot(parts.mesh, v, foot), 1 / gap, kLinkWeight));
    }
    for (const int v : vertices) sets.join(group, parts.of_triangle(feet[static_cast<size_t>(v)].triangle));
  }
}

Sets groups_of(const Parts& parts, const Links& links) {
  Sets sets(parts.count);
  for (const Tie& contact : links.ties) {
    for (const auto& [v, factor] : contact.factors) {
      sets.join(parts.of_vertex[static_cast<size_t>(contact.factors[0].first)],
                parts.of_vertex[static_cast<size_t>(v)]);
    }
  }
  return sets;
}

}  // namespace

Links contacts(const Mesh& unit_mesh, const Edges& edges, const Poll& poll) {
  const Parts parts(unit_mesh);
  ContactList list(parts, 1 / mean_edge_length(unit_mesh.positions, unit_mesh.triangles));
  find_touches(parts, poll, list);
  find_crossings(parts, edges, poll, list);
  Sets sets(parts.count);
  Links links;
  links.ties = list.ties(sets);
  links.contacts = static_cast<int>(links.ties.size());
  links.groups = sets.count();
  return links;
}

void add_links(const Mesh& unit_mesh, const Poll& poll, Links& links) {
  const Parts parts(unit_mesh);
  const double mean_length = mean_edge_length(unit_mesh.positions, unit_mesh.triangles);
  Sets sets = groups_of(parts, links);
  while (sets.count() > 1) link_once(parts, mean_length, poll, sets, links);
}

}  // namespace swage

// Splices new numbers into the bytes of the file a mesh came from.
#include <Eigen/Geometry>
#include <algorithm>

#include "source.h"
#include "triangulate.h"

namespace swage {
namespace {

// Turns below this, in radians, are rounding: a mesh that only slides keeps its normals.
constexpr double kLeastTurn = 1e-9;

struct Edit {
  Slot slot;
  double value;
};

void add_edits(std::vector<Edit>& edits, const std::string& bytes, const Slots& slots, const Eigen::Vector3d& values) {
  for (int k = 0; k < 3; ++k) {
    const Slot& slot = slots[static_cast<size_t>(k)];
    if (!holds(bytes, slot, values[k])) edits.push_back({slot, values[k]});
  }
}

Eigen::Vector3d read_slots(const std::string& bytes, const Slots& slots) {
  return {read_number(bytes, slots[0]), read_number(bytes, slots[1]), read_number(bytes, slots[2])};
}

// Positions as the file has them, whatever became of the mesh since.
Positions rest_positions(const MeshSource& source) {
  Positions rest(source.vertex_count, 3);
  for (size_t p = source.points.size(); p-- > 0;) {
    rest.row(source.point_vertices[p]) = read_slots(source.bytes, source.points[p]);
  }
  return rest;
}

Positions area_vectors(const std::vector<std::vector<int>>& polygons, const PositionsRef& positions) {
  Positions areas(static_cast<Eigen::Index>(polygons.size()), 3);
  for (size_t p = 0; p < polygons.size(); ++p) {
    areas.row(static_cast<Eigen::Index>(p)) = area_vector(polygons[p], positions);
  }
  return areas;
}

// The unit normal of the polygons together; zero where their areas cancel.
Eigen::Vector3d mean_normal(const Lists::Range& polygons, const Positions& areas) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = 0; k < polygons.size(); ++k) {
    if (k == 0 || polygons[k] != polygons[k - 1]) sum += areas.row(polygons[k]);
  }
  return sum.stableNormalized();
}

void edit_normals(std::vector<Edit>& edits, const MeshSource& source, const Positions& rest_areas,
                  const Positions& areas) {
  for (size_t n = 0; n < source.normals.size(); ++n) {
    const Lists::Range users = source.normal_polygons[static_cast<int>(n)];
    const Eigen::Vector3d from = mean_normal(users, rest_areas);
    const Eigen::Vector3d to = mean_normal(users, areas);
    if (to.isZero(0) || (to - from).norm() <= kLeastTurn) continue;
    Eigen::Vector3d normal = to;
    if (!source.facet_normals) {
      const Eigen::Vector3d kept = read_slots(source.bytes, source.normals[n]);
      if (from.isZero(0) || !kept.allFinite()) continue;
      normal = Eigen::Quaterniond::FromTwoVectors(from, to) * kept;
    }
    add_edits(edits, source.bytes, source.normals[n], normal);
  }
}

std::string spliced(const std::string& bytes, std::vector<Edit>& edits) {
  const auto before = [](const Edit& a, const Edit& b) { return a.slot.offset < b.slot.offset; };
  if (!std::is_sorted(edits.begin(), edits.end(), before)) std::sort(edits.begin(), edits.end(), before);
  constexpr size_t kUsualGrowth = 10;
  std::string out;
  out.reserve(bytes.size() + kUsualGrowth * edits.size());
  size_t copied = 0;
  for (const Edit& edit : edits) {
    out.append(bytes, copied, edit.slot.offset - copied);
    append_number(out, edit.slot.kind, edit.value);
    copied = edit.slot.offset + edit.slot.length;
  }
  return out.append(bytes, copied);
}

}  // namespace

std::string written_back(const MeshSource& source, const std::vector<std::vector<int>>& polygons,
                         const PositionsRef& positions) {
  std::vector<Edit> edits;
  for (size_t p = 0; p < source.points.size(); ++p) {
    add_edits(edits, source.bytes, source.points[p], positions.row(source.point_vertices[p]));
  }
  if (!edits.empty() && !source.normals.empty()) {
    edit_normals(edits, source, area_vectors(polygons, rest_positions(source)), area_vectors(polygons, positions));
  }
  return spliced(source.bytes, edits);
}

}  // namespace swage

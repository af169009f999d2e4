#include "draft.h"

#include <limits>

#include "triangulate.h"

namespace swage {
namespace {

constexpr long long kLargestInt = std::numeric_limits<int>::max();
// A longer polygon would take ear cutting, quadratic at best, minutes.
constexpr size_t kLongestConcavePolygon = 20000;

bool repeats_vertex(const int* corners) {
  return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

Triangles triangulated(const Input& input, Draft& draft, const Positions& positions, std::vector<int>& of_polygon) {
  std::vector<int> corners;
  std::vector<int> cut;
  for (size_t p = 0; p < draft.polygons.size(); ++p) {
    cut.clear();
    if (!triangulate(draft.polygons[p], positions, kLongestConcavePolygon, cut)) {
      refuse(input, draft.polygon_offsets[p],
             "a face that is not convex has " + std::to_string(draft.polygons[p].size()) +
                 " corners; triangulate it before, beyond " + std::to_string(kLongestConcavePolygon));
    }
    for (size_t t = 0; t < cut.size(); t += 3) {
      if (repeats_vertex(&cut[t])) {
        draft.warnings.add(input, draft.polygon_offsets[p], "a triangle that repeats a vertex is left out");
      } else {
        corners.insert(corners.end(), &cut[t], &cut[t] + 3);
        of_polygon.push_back(static_cast<int>(p));
      }
    }
  }
  const size_t count = corners.size() / 3;
  if (count == 0) {
    refuse(input, "has " + std::to_string(positions.rows()) +
                      " vertices and no triangles; export the surface of the shape as faces");
  }
  if (count > static_cast<size_t>(kLargestInt)) refuse(input, "has more than 2^31 triangles; split it");
  return Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(count), 3);
}

}  // namespace

void Warnings::add(const Input& input, size_t offset, const std::string& what) {
  constexpr size_t kToldPlaces = 3;
  size_t k = 0;
  while (k < kinds_.size() && kinds_[k].what != what) ++k;
  if (k == kinds_.size()) kinds_.push_back({what, {}, 0});
  if (kinds_[k].count++ < kToldPlaces) kinds_[k].places.push_back(place(input, offset));
}

std::vector<std::string> Warnings::told() const {
  std::vector<std::string> lines;
  for (const Kind& kind : kinds_) {
    for (const std::string& where : kind.places) lines.push_back(where + ": " + kind.what);
    const size_t others = kind.count - kind.places.size();
    if (others > 0) lines.push_back("and " + std::to_string(others) + " more times: " + kind.what);
  }
  return lines;
}

int add_vertex(const Input& input, Draft& draft, const Eigen::Vector3d& position, size_t offset) {
  const size_t vertex = draft.coordinates.size() / 3;
  if (vertex >= static_cast<size_t>(kLargestInt)) refuse(input, offset, "more than 2^31 vertices; split the mesh");
  draft.coordinates.insert(draft.coordinates.end(), position.data(), position.data() + 3);
  return static_cast<int>(vertex);
}

void add_point(Draft& draft, int vertex, const Slots& slots) {
  draft.source.points.push_back(slots);
  draft.source.point_vertices.push_back(vertex);
}

bool add_polygon(const Input& input, Draft& draft, const std::vector<int>& corners, size_t offset) {
  if (corners.size() < 3) {
    if (draft.skipped_face.empty()) draft.skipped_face = place(input, offset);
    draft.warnings.add(input, offset, "a face of fewer than three vertices is skipped");
    return false;
  }
  if (draft.polygons.size() >= static_cast<size_t>(kLargestInt)) {
    refuse(input, offset, "more than 2^31 faces; split the mesh");
  }
  draft.polygons.push_back(corners);
  draft.polygon_offsets.push_back(offset);
  return true;
}

int checked_index(const Input& input, size_t offset, long long index, long long count) {
  if (index < 0 || index >= count) {
    refuse(input, offset,
           "a face names vertex " + std::to_string(index) + ", but vertices run from 0 to " +
               std::to_string(count - 1) + "; mend the face or export the mesh again");
  }
  return static_cast<int>(index);
}

void require_room(const Input& input, size_t offset, const std::string& things, long long count, size_t bytes_each,
                  size_t bytes_left) {
  if (count < 0) refuse(input, offset, "the number of " + things + " is negative; export the mesh again");
  // The last may lack the blank after it.
  if (static_cast<unsigned long long>(count) <= (bytes_left + 1) / bytes_each) return;
  refuse(input, offset,
         std::to_string(count) + " " + things + " are promised, but only " + std::to_string(bytes_left) +
             " bytes follow; the file is truncated or its counts are wrong: export it again");
}

void use_vertex_normals(Draft& draft) {
  for (size_t p = 0; p < draft.polygons.size(); ++p) {
    for (const int v : draft.polygons[p]) draft.normal_users.emplace_back(v, static_cast<int>(p));
  }
}

MeshFile finish(Input&& input, Draft&& draft) {
  MeshFile file;
  file.mesh.positions = Eigen::Map<const Positions>(draft.coordinates.data(), draft.vertex_count(), 3);
  file.mesh.triangles = triangulated(input, draft, file.mesh.positions, file.triangle_polygons);
  file.skipped_face = std::move(draft.skipped_face);
  file.warnings = draft.warnings.told();
  file.path = input.path;
  file.groups = std::move(draft.groups);

  MeshSource& source = draft.source;
  source.normal_polygons = lists_from(static_cast<int>(source.normals.size()), draft.normal_users);
  source.vertex_count = draft.vertex_count();
  source.polygon_count = draft.polygons.size();
  if (source.format == MeshFormat::obj) source.face_offsets = std::move(draft.polygon_offsets);
  source.bytes = std::move(input.bytes);
  file.polygons = std::move(draft.polygons);
  file.source = std::make_shared<const MeshSource>(std::move(source));
  return file;
}

}  // namespace swage

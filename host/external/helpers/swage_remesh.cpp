// Isotropic remeshing between features and alpha wrapping by CGAL (GPL-3.0-or-later), under whose licence this program
// is.
//
// In: points (3 doubles each), triangles (3 ints); edge length, feature angle in radians, alpha and offset (4 doubles);
// iterations, whether to wrap first, about how many triangles at most (3 ints). Out: points, triangles.
#include "serve.h"
#include "surface.h"
#include "wire.h"

namespace swage {
namespace {

// In edge lengths: triangles less high are dropped at first, and at last; what feature lines may stray.
constexpr double kSliver = 0.05, kFlat = 1e-6, kStraying = 0.03;

Soup read_soup(wire::Reader& reader) {
  const auto coordinates = reader.read<double>(3);
  const auto corners = reader.read<std::int32_t>(3);
  Soup soup;
  for (std::size_t i = 0; i < coordinates.size(); i += 3) {
    soup.points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  }
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    soup.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  return soup;
}

/// Without garbage, so that its vertices are numbered from 0 without gaps.
std::string written(const Surface& surface) {
  std::vector<double> coordinates;
  for (const Vertex vertex : surface.vertices()) {
    const Point& point = surface.point(vertex);
    coordinates.insert(coordinates.end(), {point.x(), point.y(), point.z()});
  }
  std::vector<std::int32_t> triangles;
  for (const Face face : surface.faces()) {
    for (const Vertex vertex : surface.vertices_around_face(surface.halfedge(face))) {
      triangles.push_back(static_cast<std::int32_t>(vertex.idx()));
    }
  }
  return wire::Writer().add(coordinates).add(triangles).take();
}

std::string remeshed(std::string_view message) {
  wire::Reader reader(message);
  Soup soup = read_soup(reader);
  const auto reals = reader.read<double>(4);
  const auto ints = reader.read<std::int32_t>(3);
  reader.finish();
  const double edge_length = reals.at(0);

  Surface surface = ints.at(1) != 0 ? wrapped(soup, reals[2], reals[3]) : surface_of(std::move(soup));
  drop_slivers(surface, kSliver * edge_length);
  const Features features = features_of(surface, reals[1], kStraying * edge_length);
  remesh_between(surface, features, {edge_length, ints[0], static_cast<std::size_t>(ints[2])});
  drop_slivers(surface, kFlat * edge_length);
  return written(surface);
}

}  // namespace
}  // namespace swage

int main() { return swage::serve(swage::remeshed); }

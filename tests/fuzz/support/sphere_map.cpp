#include "sphere_map.h"

#include "fuzz.h"

namespace swage::fuzz {
namespace {

bool are_units(const Positions& all) { return ((all.rowwise().norm().array() - 1).abs() < 1e-9).all(); }

}  // namespace

void require_sphere(const SphereMap& map) {
  require(map.directions.rows() > 0 && map.directions.rows() == map.normals.rows(), "each point has a normal");
  require(are_units(map.directions) && are_units(map.normals), "points and normals are units");
  require(map.triangles.minCoeff() >= 0 && map.triangles.maxCoeff() < map.directions.rows(), "triangles are of points");
}

}  // namespace swage::fuzz

// A panel's surface, ready to be seen.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "measures.h"
#include "palette.h"
#include "rays_embree.h"
#include "swage/render.h"

namespace swage {

/// A surface in the unit box of its group of panels. Vertices at one place are one, triangles wind alike.
struct RenderScene {
  Mesh mesh;
  std::unique_ptr<RayScene> rays;               ///< Null where there are no triangles.
  std::vector<Eigen::Vector3f> normals;         ///< A triangle, unit; zero where it has no area.
  std::vector<Eigen::Vector3f> corner_normals;  ///< Three a triangle: the mean over what is smooth around a vertex.
  std::vector<Colour> colours;                  ///< A triangle.
  bool is_heat_map = false;
  std::vector<std::array<int, 2>> lines;  ///< Edges that are creases or boundaries, by their vertices.
};

RenderScene scene_of(const Panel& panel, const UnitBox& box, double feature_angle, const HeatMap& heat);

}  // namespace swage

// A coarse stand-in for a mesh.
#pragma once

#include <functional>
#include <vector>

#include "swage/mesh.h"

namespace swage {

/// A coarser mesh of the same surface.
struct Proxy {
  Mesh mesh;
  std::vector<int> vertices;     ///< Of the original, for each of the proxy's, ascending.
  std::vector<int> vertex_of;    ///< #V: proxy vertex into which each original vertex was collapsed.
  std::vector<int> triangle_of;  ///< #F: proxy triangle that stands for each original triangle.
};

/// Half-edge collapses by quadric error (Garland, Heckbert 1997) to about `triangle_count` triangles, never fewer; more
/// where a further collapse would turn a normal by over 45 degrees, fold the surface or change its topology. Vertices
/// of the original named in `kept` stay, as do those where the surface is open or not manifold. Deterministic.
/// `goes_on` is asked every few hundredths of a second, with the part done; the answer no gives an empty proxy.
Proxy decimate(const Mesh& mesh, int triangle_count, const std::vector<int>& kept,
               const std::function<bool(double)>& goes_on = {});

}  // namespace swage

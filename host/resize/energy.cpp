#include "energy.h"

#include <algorithm>

#include "assemble.h"
#include "scales.h"

namespace swage {
namespace {

using Eigen::Index;

double square(double x) { return x * x; }

/// Sum of work(i, j, k) over an array's places.
template <typename Work>
double sum_over(const Extents& extents, const Work& work) {
  double sum = 0;
  for (int k = 0; k < extents[2]; ++k) {
    for (int j = 0; j < extents[1]; ++j) {
      for (int i = 0; i < extents[0]; ++i) sum += work(i, j, k);
    }
  }
  return sum;
}

double modulation(const GridShape& shape, const CellMap& map, const AxisValues& acceptable, const AxisValues& scales) {
  double sum = 0;
  for (int u = 0; u < 3; ++u) {
    const int v = (u + 1) % 3;
    if (!shape.extends(u) || !shape.extends(v)) continue;
    for (Index c = 0; c < scales.rows(); ++c) {
      const double weight = std::max(std::min(map.theta(c, u), map.theta(c, v)), kLeastModulation);
      sum += weight * square(scales(c, u) / acceptable(c, u) - scales(c, v) / acceptable(c, v));
    }
  }
  return sum;
}

double compatibility(const GridShape& shape, const CellMap& map, const AxisValues& scales) {
  return sum_over(shape.cells, [&](int i, int j, int k) {
    const std::array<int, 3> at = {i, j, k};
    const Index c = shape.cells.at(i, j, k);
    double sum = 0;
    for (int w = 0; w < 3; ++w) {
      if (at[static_cast<size_t>(w)] + 1 == shape.cells[w]) continue;
      const Index d = c + shape.cells.stride(w);
      const double weight = kCompatibility * map.phi[c] * map.phi[d];
      for (int u = 0; u < 3; ++u) {
        if (u != w && shape.extends(u)) sum += weight * square(scales(c, u) - scales(d, u));
      }
    }
    return sum;
  });
}

struct AssemblyTerms {
  double scale = 0, orthogonality = 0;
};

AssemblyTerms assembly_terms(const GridShape& shape, const CellMap& map, const AxisValues& scales,
                             const AxisValues& vertices) {
  const Extents grid = shape.vertices();
  AssemblyTerms terms;
  for (int u = 0; u < 3; ++u) {
    if (!shape.extends(u)) continue;
    const double length = shape.size[u] / shape.cells[u];
    sum_over(shape.cells, [&](int i, int j, int k) {
      const Index c = shape.cells.at(i, j, k);
      for (int corner = 0; corner < 8; ++corner) {
        const Index first = grid.at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
        for (int axis = 0; axis < 3; ++axis) {
          if ((corner >> axis & 1) == 1) continue;
          const double off = (vertices(first + grid.stride(axis), u) - vertices(first, u)) / length;
          if (axis == u) {
            terms.scale += std::max(map.theta(c, u), kLeastVulnerability) * square(off - scales(c, u));
          } else {
            terms.orthogonality += kOrthogonality * map.phi[c] * square(off);
          }
        }
      }
      return 0.0;
    });
  }
  return terms;
}

}  // namespace

std::map<std::string, double> energy_by_term(const GridShape& shape, const CellMap& map, const ResizeTarget& target,
                                             const AxisValues& scales, const AxisValues& vertices) {
  const bool keeps_size = target.keep == ResizeKeep::size;
  const double unit = keeps_size ? 1 : unit_scale(shape, target.factors);
  AxisValues acceptable = map.theta;
  for (int u = 0; u < 3; ++u) {
    acceptable.col(u) = unit + (1 - map.theta.col(u).array()) * (target.factors[u] - unit);
  }
  const AssemblyTerms assembly = assembly_terms(shape, map, scales, vertices);
  std::map<std::string, double> terms = {{"modulation", modulation(shape, map, acceptable, scales)},
                                         {"compatibility", compatibility(shape, map, scales)},
                                         {"scale", assembly.scale},
                                         {"orthogonality", assembly.orthogonality}};
  if (keeps_size) {
    terms["size"] = target.size_weight * (map.theta.array() * (scales.array() - 1).square()).sum();
  }
  return terms;
}

}  // namespace swage

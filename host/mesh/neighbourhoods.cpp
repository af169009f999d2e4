#include "neighbourhoods.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "measures.h"
#include "swage/error.h"
#include "swage/thrown.h"

namespace swage {
namespace {

using Eigen::Index;

// Coefficients of a fit, and so the fewest neighbours that can tell it.
constexpr size_t kFewestNeighbours = 5;
// A neighbour whose normal is at a right angle to the vertex's, or beyond, is not on the same sheet of the surface.
// Above 0, so that rounding does not decide about right angles.
constexpr double kFacing = 1e-6;
// A ring grows no further from more edges than this: around the hub of a large fan, every vertex would see every other.
constexpr int kMostEdges = 2000;

Positions vertex_normals(const Mesh& mesh, const Lists& corners) {
  const Positions areas = area_vectors(mesh.positions, mesh.triangles);
  Positions normals(mesh.positions.rows(), 3);
#pragma omp parallel for schedule(static)
  for (int v = 0; v < corners.size(); ++v) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const int corner : corners[v]) sum += areas.row(corner / 3);
    normals.row(v) = sum.isZero(0) ? sum : sum.normalized();
  }
  return normals;
}

/// Lists of `count` things: of each what `tell()` appends, made anew for each block of them.
template <typename Make>
Lists lists_of(Index count, const Make& make_tell) {
  constexpr Index kBlock = 4096;
  const Index blocks = (count + kBlock - 1) / kBlock;
  std::vector<std::vector<int>> items(static_cast<size_t>(blocks));
  std::vector<size_t> ends(static_cast<size_t>(count));  // In the block.
  Thrown thrown;
#pragma omp parallel for schedule(dynamic)
  for (Index block = 0; block < blocks; ++block) {
    thrown.keep([&] {
      auto tell = make_tell();
      std::vector<int>& own = items[static_cast<size_t>(block)];
      for (Index i = block * kBlock; i < std::min((block + 1) * kBlock, count); ++i) {
        tell(i, own);
        ends[static_cast<size_t>(i)] = own.size();
      }
    });
  }
  thrown.rethrow();
  std::vector<size_t> firsts(static_cast<size_t>(blocks) + 1, 0);
  std::transform_inclusive_scan(items.begin(), items.end(), firsts.begin() + 1, std::plus(),
                                [](const std::vector<int>& own) { return own.size(); });
  if (firsts.back() > static_cast<size_t>(std::numeric_limits<int>::max())) {
    throw InvalidInput("rings: neighbourhoods of so many rings are too large for this mesh; use fewer");
  }
  Lists lists{std::vector<int>(static_cast<size_t>(count) + 1, 0), std::vector<int>(firsts.back())};
#pragma omp parallel for schedule(dynamic)
  for (Index block = 0; block < blocks; ++block) {
    const size_t first = firsts[static_cast<size_t>(block)];
    std::vector<int> own = std::move(items[static_cast<size_t>(block)]);
    std::copy(own.begin(), own.end(), lists.items.begin() + static_cast<std::ptrdiff_t>(first));
    for (Index i = block * kBlock; i < std::min((block + 1) * kBlock, count); ++i) {
      lists.offsets[static_cast<size_t>(i) + 1] = static_cast<int>(first + ends[static_cast<size_t>(i)]);
    }
  }
  return lists;
}

/// The vertices joined to each by a side, ascending.
Lists near_each(const Triangles& triangles, const Lists& corners) {
  return lists_of(corners.size(), [&] {
    return [&](Index v, std::vector<int>& near) {
      const auto first = static_cast<std::ptrdiff_t>(near.size());
      for (const int corner : corners[static_cast<int>(v)]) {
        for (const int k : {(corner + 1) % 3, (corner + 2) % 3}) {
          const int other = triangles(corner / 3, k);
          if (other != v) near.push_back(other);
        }
      }
      std::sort(near.begin() + first, near.end());
      near.erase(std::unique(near.begin() + first, near.end()), near.end());
    };
  });
}

/// Vertices that were met from one vertex, then from the next: a hash table that nobody empties.
class Met {
 public:
  /// Whether `vertex` was not met from this one.
  bool add(int from, int vertex) {
    if (std::exchange(from_, from) != from) count_ = 0;
    if (2 * ++count_ > slots_.size()) grow();
    return insert({from, vertex});
  }

 private:
  struct Slot {
    int from = -1, vertex = -1;
  };

  bool insert(const Slot& slot) {
    size_t at = static_cast<std::uint32_t>(slot.vertex) * 0x9E3779B9U & (slots_.size() - 1);
    for (; slots_[at].from == slot.from; at = (at + 1) & (slots_.size() - 1)) {
      if (slots_[at].vertex == slot.vertex) return false;
    }
    slots_[at] = slot;
    return true;
  }

  void grow() {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
    for (const Slot& slot : old) {
      if (slot.from == from_) insert(slot);
    }
  }

  std::vector<Slot> slots_ = std::vector<Slot>(256);  // A power of two.
  size_t count_ = 0;                                  // Asked for from this vertex.
  int from_ = -1;
};

/// Finds the vertices within some edges of a vertex.
class Rings {
 public:
  explicit Rings(const Lists& near) : near_(near) {}

  /// Nearest rings first, the vertex itself left out.
  const std::vector<int>& around(int vertex, int rings) {
    found_.clear();
    met_.add(vertex, vertex);
    add_neighbours(vertex, vertex);
    size_t inner = 0;
    for (int ring = 1; ring < rings && inner < found_.size(); ++ring) {
      const size_t outer = found_.size();
      if (edges_at(inner) > kMostEdges) break;
      for (; inner < outer; ++inner) add_neighbours(vertex, found_[inner]);
    }
    return found_;
  }

 private:
  long edges_at(size_t inner) const {
    long count = 0;
    for (size_t i = inner; i < found_.size(); ++i) count += near_[found_[i]].size();
    return count;
  }
  void add_neighbours(int vertex, int of) {
    for (const int neighbour : near_[of]) {
      if (met_.add(vertex, neighbour)) found_.push_back(neighbour);
    }
  }

  const Lists& near_;
  std::vector<int> found_;
  Met met_;
};

/// Adds the neighbours that face the vertex's way, or all where those would be too few.
void add_facing(int vertex, const Positions& normals, const std::vector<int>& neighbours, std::vector<int>& kept) {
  const auto before = static_cast<std::ptrdiff_t>(kept.size());
  std::copy_if(neighbours.begin(), neighbours.end(), std::back_inserter(kept),
               [&](int neighbour) { return normals.row(vertex).dot(normals.row(neighbour)) > kFacing; });
  if (kept.size() - static_cast<size_t>(before) >= kFewestNeighbours) return;
  kept.erase(kept.begin() + before, kept.end());
  kept.insert(kept.end(), neighbours.begin(), neighbours.end());
}

}  // namespace

Neighbourhoods::Neighbourhoods(const Mesh& mesh, int rings)
    : mesh_(mesh), rings_(rings), places_(static_cast<size_t>(mesh.positions.rows()), -1) {
  const Lists corners = corners_of_vertices(mesh.triangles, static_cast<int>(mesh.positions.rows()));
  normals_ = vertex_normals(mesh, corners);
  near_ = near_each(mesh.triangles, corners);
}

Lists Neighbourhoods::facing(Slice vertices) const {
  return lists_of(vertices.count(), [&] {
    return [&, rings = Rings(near_)](Index i, std::vector<int>& kept) mutable {
      const auto v = static_cast<int>(vertices.first + i);
      // A vertex of triangles without area has no normal, hence no plane to fit over.
      if (!normals_.row(v).isZero(0)) add_facing(v, normals_, rings.around(v, rings_), kept);
    };
  });
}

CurvatureStep::Rest Neighbourhoods::of(Slice vertices) {
  Lists lists = facing(vertices);
  std::vector<int> members(static_cast<size_t>(vertices.count()));
  std::iota(members.begin(), members.end(), static_cast<int>(vertices.first));
  const auto place_of = [&](int v) -> int& { return places_[static_cast<size_t>(v)]; };
  for (size_t i = 0; i < members.size(); ++i) place_of(members[i]) = static_cast<int>(i);
  for (int& neighbour : lists.items) {
    int& place = place_of(neighbour);
    if (place < 0) {
      place = static_cast<int>(members.size());
      members.push_back(neighbour);
    }
    neighbour = place;
  }
  for (const int v : members) place_of(v) = -1;
  lists.offsets.resize(members.size() + 1, lists.offsets.back());
  return {mesh_.positions(members, Eigen::all), normals_(members, Eigen::all), std::move(lists.offsets),
          std::move(lists.items)};
}

CurvatureStep::Rest neighbourhoods(const Mesh& mesh, int rings) {
  return Neighbourhoods(mesh, rings).of({0, mesh.positions.rows()});
}

}  // namespace swage

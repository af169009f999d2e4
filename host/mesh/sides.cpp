#include "sides.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "swage/thrown.h"

namespace swage {
namespace {

/// Two numbers in one, ordered by the first.
std::uint64_t packed(int first, int second) {
  return std::uint64_t{static_cast<std::uint32_t>(first)} << 32 | static_cast<std::uint32_t>(second);
}
int first_of(std::uint64_t pair) { return static_cast<int>(pair >> 32); }
int second_of(std::uint64_t pair) { return static_cast<int>(pair & 0xFFFFFFFFU); }

/// Makes a ring of what is packed with the same first number, one after the other.
void join_rings(const std::vector<std::uint64_t>& pairs, int* next) {
  for (size_t i = 0; i < pairs.size();) {
    size_t end = i + 1;
    while (end < pairs.size() && first_of(pairs[end]) == first_of(pairs[i])) ++end;
    for (size_t k = i; k < end; ++k) next[second_of(pairs[k])] = second_of(pairs[k + 1 < end ? k + 1 : i]);
    i = end;
  }
}

/// Calls work(first, last) for blocks of 0 ... count - 1, each by one thread.
template <typename Work>
void each_block(int count, const Work& work) {
  constexpr int kBlock = 1024;
  Thrown thrown;
#pragma omp parallel for schedule(dynamic)
  for (int block = 0; block < (count + kBlock - 1) / kBlock; ++block) {
    thrown.keep([&] { work(block * kBlock, std::min((block + 1) * kBlock, count)); });
  }
  thrown.rethrow();
}

/// The only other side along its edge; -1 where there is none, or several are.
int only_other(const NextSides& next, int side) {
  const int other = next.data()[side];
  return other != side && next.data()[other] == side ? other : -1;
}

bool all_wind_alike(const Triangles& triangles, const NextSides& next) {
  bool alike = true;
  const auto sides = static_cast<int>(next.size());
#pragma omp parallel for schedule(static) reduction(&& : alike)
  for (int side = 0; side < sides; ++side) {
    const int other = only_other(next, side);
    alike = alike && (other < 0 || !same_way(triangles, side, other));
  }
  return alike;
}

}  // namespace

NextSides next_sides(const Triangles& triangles, const Lists& corners) {
  NextSides next(triangles.rows(), 3);
  const int* const vertices = triangles.data();
  each_block(corners.size(), [&](int first, int last) {
    std::vector<std::uint64_t> spokes;  // The other end of a side, and the side.
    for (int v = first; v < last; ++v) {
      spokes.clear();
      for (const int corner : corners[v]) {
        const int before = previous_in_triangle(corner), to = vertices[next_in_triangle(corner)];
        if (to > v) spokes.push_back(packed(to, corner));
        if (vertices[before] > v) spokes.push_back(packed(vertices[before], before));
        if (to == v) next.data()[corner] = corner;
      }
      std::sort(spokes.begin(), spokes.end());
      join_rings(spokes, next.data());
    }
  });
  return next;
}

std::vector<int> firsts_alike(const Triangles& triangles, const Lists& corners) {
  std::vector<int> firsts(static_cast<size_t>(triangles.rows()));
  std::iota(firsts.begin(), firsts.end(), 0);
  each_block(corners.size(), [&](int begin, int end) {
    struct Opposite {
      std::uint64_t vertices;
      int triangle;
      bool operator<(const Opposite& other) const {
        return std::pair(vertices, triangle) < std::pair(other.vertices, other.triangle);
      }
    };
    std::vector<Opposite> opposites;  // Of triangles whose least vertex this is.
    for (int v = begin; v < end; ++v) {
      opposites.clear();
      for (const int corner : corners[v]) {
        const auto [low, high] =
            std::minmax(triangles.data()[next_in_triangle(corner)], triangles.data()[previous_in_triangle(corner)]);
        if (low > v) opposites.push_back({packed(low, high), corner / 3});
      }
      std::sort(opposites.begin(), opposites.end());
      for (size_t i = 1; i < opposites.size(); ++i) {
        if (opposites[i].vertices != opposites[i - 1].vertices) continue;
        firsts[static_cast<size_t>(opposites[i].triangle)] = firsts[static_cast<size_t>(opposites[i - 1].triangle)];
      }
    }
  });
  return firsts;
}

int wind_alike(Triangles& triangles, const NextSides& next) {
  if (all_wind_alike(triangles, next)) return 0;
  constexpr char kUnmet = 2;
  std::vector<char> turned(static_cast<size_t>(triangles.rows()), kUnmet);  // 1 where it is to be turned, 0 where not.
  std::vector<int> walk;
  for (int first = 0; first < triangles.rows(); ++first) {
    if (turned[static_cast<size_t>(first)] != kUnmet) continue;
    turned[static_cast<size_t>(first)] = 0;
    walk.assign(1, first);
    for (size_t i = 0; i < walk.size(); ++i) {
      for (int side = 3 * walk[i]; side < 3 * walk[i] + 3; ++side) {
        const int other = only_other(next, side);
        if (other < 0 || turned[static_cast<size_t>(other / 3)] != kUnmet) continue;
        const bool alike = !same_way(triangles, side, other);
        turned[static_cast<size_t>(other / 3)] =
            static_cast<char>((turned[static_cast<size_t>(walk[i])] == 1) == alike);
        walk.push_back(other / 3);
      }
    }
  }
  for (int t = 0; t < triangles.rows(); ++t) {
    if (turned[static_cast<size_t>(t)] == 1) std::swap(triangles(t, 1), triangles(t, 2));
  }
  return static_cast<int>(std::count(turned.begin(), turned.end(), 1));
}

}  // namespace swage

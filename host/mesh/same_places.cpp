#include "same_places.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "swage/thrown.h"

namespace swage {
namespace {

using Eigen::Index;

/// A vertex in a cell of a grid.
struct Entry {
  std::uint64_t cell;  ///< Its hash: cells that share one only cost comparisons.
  int vertex;
  bool operator<(const Entry& other) const { return std::pair(cell, vertex) < std::pair(other.cell, other.vertex); }
};

/// The cells of a grid that a point is in or within the tolerance of.
class Grid {
 public:
  Grid(const Positions& positions, double tolerance)
      : corner_(positions.colwise().minCoeff()), tolerance_(tolerance), per_width_(1 / (kWidth * tolerance)) {}

  template <typename Use>
  void each_cell(const Eigen::RowVector3d& point, const Use& use) const {
    if (tolerance_ == 0) return use(hash(words_of(point)));
    const Cell low = cell_of(point.array() - tolerance_), high = cell_of(point.array() + tolerance_);
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) use(hash({x, y, z}));
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  // Tolerances: wide enough that most points are in one cell, and narrow enough that no cell has many places.
  static constexpr double kWidth = 16;

  Cell cell_of(const Eigen::RowVector3d& point) const {
    Cell cell;
    for (int k = 0; k < 3; ++k) {
      cell[static_cast<size_t>(k)] = static_cast<std::int64_t>(std::floor((point[k] - corner_[k]) * per_width_));
    }
    return cell;
  }

  static Cell words_of(const Eigen::RowVector3d& point) {
    Cell words;
    for (int k = 0; k < 3; ++k) words[static_cast<size_t>(k)] = std::bit_cast<std::int64_t>(point[k] + 0.0);  // No -0.
    return words;
  }

  static std::uint64_t hash(const Cell& cell) {
    std::uint64_t hash = 0;
    for (const std::int64_t c : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 29;
    }
    return hash;
  }

  Eigen::RowVector3d corner_;
  double tolerance_, per_width_;
};

constexpr int kBucketBits = 9;  // Of hashes: their first bits.
constexpr Index kBuckets = Index{1} << kBucketBits;
constexpr Index kChunk = 1 << 16;  // Vertices.

Index bucket_of(std::uint64_t hash) { return static_cast<Index>(hash >> (64 - kBucketBits)); }

/// Entries in buckets by their hashes: all of one cell are in one.
struct Buckets {
  std::vector<Entry> entries;
  std::vector<Index> offsets;  ///< Of each bucket.
};

Buckets buckets_of(const Positions& positions, const Grid& grid) {
  const Index chunks = (positions.rows() + kChunk - 1) / kChunk;
  // Where the entries of a chunk begin in each bucket.
  Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> next(chunks, kBuckets);
  next.setZero();
  const auto each_entry_of = [&](Index chunk, const auto& work) {
    for (Index v = chunk * kChunk; v < std::min((chunk + 1) * kChunk, positions.rows()); ++v) {
      grid.each_cell(positions.row(v), [&](std::uint64_t hash) { work(v, hash, next(chunk, bucket_of(hash))); });
    }
  };
#pragma omp parallel for schedule(dynamic)
  for (Index chunk = 0; chunk < chunks; ++chunk) {
    each_entry_of(chunk, [](Index, std::uint64_t, Index& count) { ++count; });
  }
  Buckets buckets;
  Index first = 0;
  for (Index bucket = 0; bucket < kBuckets; ++bucket) {
    buckets.offsets.push_back(first);
    for (Index chunk = 0; chunk < chunks; ++chunk) first += std::exchange(next(chunk, bucket), first);
  }
  buckets.offsets.push_back(first);
  buckets.entries.resize(static_cast<size_t>(first));
#pragma omp parallel for schedule(dynamic)
  for (Index chunk = 0; chunk < chunks; ++chunk) {
    each_entry_of(chunk, [&](Index v, std::uint64_t hash, Index& at) {
      buckets.entries[static_cast<size_t>(at++)] = {hash, static_cast<int>(v)};
    });
  }
  return buckets;
}

/// A vertex may be in several cells, of several buckets: whatever comes first, the least is left.
void lower(int& number, int to) {
  const std::atomic_ref<int> shared(number);
  int now = shared.load(std::memory_order_relaxed);
  while (to < now && !shared.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
  }
}

/// Entries of one bucket.
void find_firsts(Entry* begin, Entry* end, const Positions& positions, double tolerance, std::vector<int>& firsts) {
  std::sort(begin, end);
  std::vector<int> places;
  for (const Entry* entry = begin; entry != end; ++entry) {
    if (entry == begin || entry->cell != entry[-1].cell) places.clear();
    const int v = entry->vertex;
    const auto at = std::find_if(places.begin(), places.end(), [&](int other) {
      return (positions.row(other) - positions.row(v)).norm() <= tolerance;
    });
    if (at == places.end()) {
      places.push_back(v);
    } else {
      lower(firsts[static_cast<size_t>(v)], *at);
    }
  }
}

}  // namespace

std::vector<int> firsts_at_places(const Positions& positions, double tolerance) {
  std::vector<int> firsts(static_cast<size_t>(positions.rows()));
  std::iota(firsts.begin(), firsts.end(), 0);
  Buckets buckets = buckets_of(positions, Grid(positions, tolerance));
  Thrown thrown;
#pragma omp parallel for schedule(dynamic)
  for (Index bucket = 0; bucket < kBuckets; ++bucket) {
    Entry* const entries = buckets.entries.data();
    thrown.keep([&] {
      find_firsts(entries + buckets.offsets[static_cast<size_t>(bucket)],
                  entries + buckets.offsets[static_cast<size_t>(bucket) + 1], positions, tolerance, firsts);
    });
  }
  thrown.rethrow();
  for (int& first : firsts) first = firsts[static_cast<size_t>(first)];  // The first's own is known by then.
  return firsts;
}

}  // namespace swage

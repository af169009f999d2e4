#include "multilevel.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

namespace swage {
namespace {

using Eigen::Index;
using Eigen::VectorXf;

constexpr int kRounds = 3;        // Of pairing: up to eight elements become one.
constexpr int kCoarsest = 300;    // Elements that are solved for at once.
constexpr float kDamping = 0.7F;  // Of a Jacobi sweep.
constexpr float kEnough = 0.25F;  // A coarse residual so much smaller needs no second step.
constexpr Index kWorthThreads = 5000;

using Row6 = Eigen::Matrix<float, 1, 6>;

/// How much a pair holds its elements together in the two directions in which it does most: across a sharp edge,
/// surfaces stretch independently, and must not be merged before others.
float strength(const Row6& c) {
  const float trace = c[0] + c[3] + c[5];
  const float minors = c[0] * c[3] - c[1] * c[1] + c[0] * c[5] - c[2] * c[2] + c[3] * c[5] - c[4] * c[4];
  return trace > 0 ? minors / trace + 1e-3F * trace : 0;
}

Eigen::Matrix3d unpacked(const Row6& packed) {
  const Eigen::Matrix<double, 1, 6> c = packed.cast<double>();
  return (Eigen::Matrix3d() << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5]).finished();
}

/// For each element its neighbours, ascending, each once, with what couples them.
struct Couplings {
  std::vector<int> offsets, neighbours;
  Eigen::Matrix<float, Eigen::Dynamic, 6, Eigen::RowMajor> values;

  Index begin(Index element) const { return offsets[static_cast<size_t>(element)]; }
  Index end(Index element) const { return offsets[static_cast<size_t>(element) + 1]; }
  int neighbour(Index k) const { return neighbours[static_cast<size_t>(k)]; }
  /// The coupling of two elements that are coupled.
  Index find(Index element, int other) const {
    return std::lower_bound(neighbours.begin() + begin(element), neighbours.begin() + end(element), other) -
           neighbours.begin();
  }
};

Couplings couplings_of(const ElementGraph& graph) {
  const auto count = static_cast<size_t>(graph.own.rows());
  std::vector<int> ends(count + 1, 0);
  for (const auto& [i, j] : graph.pairs) {
    if (i == j) continue;
    ++ends[static_cast<size_t>(i) + 1];
    ++ends[static_cast<size_t>(j) + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::pair<int, int>> entries(static_cast<size_t>(ends.back()));  // Neighbour and pair.
  std::vector<int> next(ends.begin(), ends.end() - 1);
  for (size_t p = 0; p < graph.pairs.size(); ++p) {
    const auto [i, j] = graph.pairs[p];
    if (i == j) continue;
    entries[static_cast<size_t>(next[static_cast<size_t>(i)]++)] = {j, static_cast<int>(p)};
    entries[static_cast<size_t>(next[static_cast<size_t>(j)]++)] = {i, static_cast<int>(p)};
  }
  Couplings result;
  result.offsets.assign(1, 0);
  result.neighbours.reserve(entries.size());
  result.values.resize(static_cast<Index>(entries.size()), 6);
  Index filled = 0;
  for (size_t i = 0; i < count; ++i) {
    std::sort(entries.begin() + ends[i], entries.begin() + ends[i + 1]);
    for (int k = ends[i]; k < ends[i + 1]; ++k) {
      const auto [j, p] = entries[static_cast<size_t>(k)];
      if (k == ends[i] || result.neighbours.back() != j) {
        result.neighbours.push_back(j);
        result.values.row(filled++).setZero();
      }
      result.values.row(filled - 1) += graph.couplings.row(p);
    }
    result.offsets.push_back(static_cast<int>(result.neighbours.size()));
  }
  result.values.conservativeResize(filled, 6);
  return result;
}

struct Merge {
  std::vector<int> into;  // Of each element.
  int count = 0;
};

/// Each element with that of its free neighbours which it is coupled to most strongly.
Merge pairing(const Couplings& couplings) {
  const auto count = static_cast<Index>(couplings.offsets.size()) - 1;
  Merge merge{std::vector<int>(static_cast<size_t>(count), -1), 0};
  for (Index i = 0; i < count; ++i) {
    if (merge.into[static_cast<size_t>(i)] >= 0) continue;
    int best = -1;
    float most = 0;
    for (Index k = couplings.begin(i); k < couplings.end(i); ++k) {
      const float strong = strength(couplings.values.row(k));
      if (merge.into[static_cast<size_t>(couplings.neighbour(k))] < 0 && strong > most) {
        best = couplings.neighbour(k);
        most = strong;
      }
    }
    merge.into[static_cast<size_t>(i)] = merge.count;
    if (best >= 0) merge.into[static_cast<size_t>(best)] = merge.count;
    ++merge.count;
  }
  return merge;
}

ElementGraph merged(const Couplings& couplings, const ElementGraph::Rows& own, int rows, const Merge& merge) {
  ElementGraph coarse;
  coarse.rows = rows;
  coarse.own.setZero(merge.count, own.cols());
  for (Index i = 0; i < own.rows(); ++i) coarse.own.row(merge.into[static_cast<size_t>(i)]) += own.row(i);
  coarse.couplings.resize(couplings.values.rows() / 2, 6);
  Index filled = 0;
  for (Index i = 0; i < own.rows(); ++i) {
    const int a = merge.into[static_cast<size_t>(i)];
    for (Index k = couplings.begin(i); k < couplings.end(i); ++k) {
      const int j = couplings.neighbour(k), b = merge.into[static_cast<size_t>(j)];
      if (i >= j || a == b) continue;
      coarse.pairs.emplace_back(a, b);
      coarse.couplings.row(filled++) = couplings.values.row(k);
    }
  }
  coarse.couplings.conservativeResize(filled, 6);
  return coarse;
}

constexpr int kLanes = 8;
using Lanes = Eigen::Array<float, kLanes, 1>;

/// Matrices of kLanes elements in a row stand side by side, entry by entry.
class LaneRows {
 public:
  LaneRows() = default;
  LaneRows(Index rows, Index width) : width_(width), lanes_(static_cast<size_t>(rows * width), Lanes::Zero()) {}

  float& operator()(Index row, Index entry, Index lane) {
    return lanes_[static_cast<size_t>(row * width_ + entry)][lane];
  }
  void set_zero() { std::fill(lanes_.begin(), lanes_.end(), Lanes::Zero()); }
  const Lanes* row(Index row) const { return lanes_.data() + row * width_; }
  std::size_t bytes() const { return lanes_.size() * sizeof(Lanes); }

 private:
  Index width_ = 0;
  std::vector<Lanes> lanes_;
};

/// y += the symmetric matrices with the lower triangles `packed` times x.
template <int kWidth>
void add_product(const Lanes* packed, const Lanes* x, Lanes* y) {
  for (int i = 0; i < kWidth; ++i) {
    Lanes sum = packed[i] * x[i];
    for (int j = 0; j < i; ++j) {
      sum += packed[j] * x[j];
      y[j] += packed[j] * x[i];
    }
    y[i] += sum;
    packed += i + 1;
  }
}

}  // namespace

struct Multilevel::Level {
  /// Structure alone.
  Level(const ElementGraph& graph, const Couplings& couplings);

  int rows;
  Index count;
  LaneRows own, inverse;
  // Of kLanes elements in a row each has as many slots for neighbours as the one with most: what is left over couples
  // an element to itself.
  std::vector<Index> slots;     // Of each row the first, and the end.
  std::vector<int> neighbours;  // Slot by slot, kLanes each.
  LaneRows values;
  std::vector<std::array<Index, 2>> places;  // Of each pair its neighbours' places, or -1.
  std::vector<int> into;                     // Of each element, on the next level.
  std::vector<int> part_offsets, parts;      // Of each element of the next level those merged into it.
  std::vector<int> coarse_pairs;             // Of each pair, on the next level, or -1 where it is within an element.

  Index unknowns() const { return count * 3 * rows; }
  Index coarse_count() const { return static_cast<Index>(part_offsets.size()) - 1; }
  std::size_t bytes() const {
    return own.bytes() + inverse.bytes() + values.bytes() + slots.size() * sizeof(Index) +
           places.size() * sizeof(places[0]) +
           (neighbours.size() + into.size() + part_offsets.size() + parts.size() + coarse_pairs.size()) * sizeof(int);
  }

  /// `pairs` are this level's, `couplings` the next one's, whose pairs it returns.
  std::vector<std::pair<int, int>> merge_into(std::vector<int> coarse, const std::vector<std::pair<int, int>>& pairs,
                                              const Couplings& couplings);
  void fill(const ElementGraph& graph);
  /// The sums on the next level, whose pairs stand there already.
  void coarsen(const ElementGraph& graph, ElementGraph& coarse) const;

  /// A sweep from nothing.
  template <int kRows>
  void begin(const VectorXf& right, VectorXf& x) const;
  template <int kRows>
  void multiply(const VectorXf& x, VectorXf& image) const;
  template <int kRows>
  void residual(const VectorXf& right, const VectorXf& x, VectorXf& left) const;
  /// A sweep from x.
  template <int kRows>
  void sweep(const VectorXf& right, const VectorXf& x, VectorXf& swept) const;
  template <int kRows>
  void gather(const VectorXf& fine, VectorXf& coarse) const;
  template <int kRows>
  void scatter(const VectorXf& coarse, VectorXf& fine) const;

 private:
  Index lane_rows() const { return (count + kLanes - 1) / kLanes; }
  template <int kRows>
  void invert();
  template <int kRows>
  void load(const VectorXf& x, Index row, Lanes* lanes) const;
  template <int kRows>
  void store(const Lanes* lanes, Index row, VectorXf& x) const;
  /// The matrix times x, of a row of elements.
  template <int kRows>
  void row_product(const VectorXf& x, Index row, Lanes* product) const;
};

Multilevel::Level::Level(const ElementGraph& graph, const Couplings& couplings)
    : rows(graph.rows),
      count(graph.own.rows()),
      own(lane_rows(), graph.own.cols()),
      inverse(lane_rows(), graph.own.cols()),
      slots(static_cast<size_t>(lane_rows()) + 1, 0) {
  for (Index t = 0; t < count; ++t) {
    Index& most = slots[static_cast<size_t>(t / kLanes) + 1];
    most = std::max(most, couplings.end(t) - couplings.begin(t));
  }
  std::partial_sum(slots.begin(), slots.end(), slots.begin());
  neighbours.resize(static_cast<size_t>(slots.back()) * kLanes);
  values = LaneRows(slots.back(), 6);
  for (Index t = 0; t < lane_rows() * kLanes; ++t) {
    const Index first = slots[static_cast<size_t>(t / kLanes)], end = slots[static_cast<size_t>(t / kLanes) + 1];
    for (Index slot = first; slot < end; ++slot) {
      int& neighbour = neighbours[static_cast<size_t>(slot * kLanes + t % kLanes)];
      neighbour = static_cast<int>(std::min(t, count - 1));
      if (t >= count) continue;
      const Index k = couplings.begin(t) + slot - first;
      if (k < couplings.end(t)) neighbour = couplings.neighbour(k);
    }
  }
  const auto place = [&](int from, int to) {
    const Index slot = slots[static_cast<size_t>(from / kLanes)] + couplings.find(from, to) - couplings.begin(from);
    return slot * kLanes + from % kLanes;
  };
  places.reserve(graph.pairs.size());
  for (const auto& [i, j] : graph.pairs) {
    if (i == j) {
      places.push_back({-1, -1});
    } else {
      places.push_back({place(i, j), place(j, i)});
    }
  }
}

std::vector<std::pair<int, int>> Multilevel::Level::merge_into(std::vector<int> coarse,
                                                               const std::vector<std::pair<int, int>>& pairs,
                                                               const Couplings& couplings) {
  into = std::move(coarse);
  const Index coarse_elements = static_cast<Index>(couplings.offsets.size()) - 1;
  part_offsets.assign(couplings.offsets.size(), 0);
  for (const int c : into) ++part_offsets[static_cast<size_t>(c) + 1];
  std::partial_sum(part_offsets.begin(), part_offsets.end(), part_offsets.begin());
  parts.resize(into.size());
  std::vector<int> next(part_offsets.begin(), part_offsets.end() - 1);
  for (size_t t = 0; t < into.size(); ++t) {
    parts[static_cast<size_t>(next[static_cast<size_t>(into[t])]++)] = static_cast<int>(t);
  }
  std::vector<std::pair<int, int>> coarse_list;
  std::vector<int> number(couplings.neighbours.size(), -1);  // Of each coupling to a later element, its pair.
  for (int c = 0; c < coarse_elements; ++c) {
    for (Index k = couplings.begin(c); k < couplings.end(c); ++k) {
      if (couplings.neighbour(k) < c) continue;
      number[static_cast<size_t>(k)] = static_cast<int>(coarse_list.size());
      coarse_list.emplace_back(c, couplings.neighbour(k));
    }
  }
  coarse_pairs.reserve(pairs.size());
  for (const auto& [i, j] : pairs) {
    const auto [a, b] = std::minmax({into[static_cast<size_t>(i)], into[static_cast<size_t>(j)]});
    coarse_pairs.push_back(a == b ? -1 : number[static_cast<size_t>(couplings.find(a, b))]);
  }
  return coarse_list;
}

void Multilevel::Level::fill(const ElementGraph& graph) {
#pragma omp parallel for schedule(static) if (count > kWorthThreads)
  for (Index t = 0; t < count; ++t) {
    for (Index k = 0; k < graph.own.cols(); ++k) own(t / kLanes, k, t % kLanes) = graph.own(t, k);
  }
  values.set_zero();
  for (size_t p = 0; p < places.size(); ++p) {
    if (places[p][0] < 0) continue;
    for (const Index place : places[p]) {
      for (Index c = 0; c < 6; ++c) {
        values(place / kLanes, c, place % kLanes) += graph.couplings(static_cast<Index>(p), c);
      }
    }
  }
  rows == 1 ? invert<1>() : invert<3>();
}

void Multilevel::Level::coarsen(const ElementGraph& graph, ElementGraph& coarse) const {
  coarse.rows = rows;
  coarse.own.resize(coarse_count(), graph.own.cols());
#pragma omp parallel for schedule(static) if (count > kWorthThreads)
  for (Index c = 0; c < coarse_count(); ++c) {
    coarse.own.row(c).setZero();
    for (int p = part_offsets[static_cast<size_t>(c)]; p < part_offsets[static_cast<size_t>(c) + 1]; ++p) {
      coarse.own.row(c) += graph.own.row(parts[static_cast<size_t>(p)]);
    }
  }
  coarse.couplings.setZero(static_cast<Index>(coarse.pairs.size()), 6);
  for (size_t p = 0; p < coarse_pairs.size(); ++p) {
    if (coarse_pairs[p] >= 0) coarse.couplings.row(coarse_pairs[p]) += graph.couplings.row(static_cast<Index>(p));
  }
}

/// The inverses of the matrix's blocks on its diagonal, as packed as `own`.
template <int kRows>
void Multilevel::Level::invert() {
  constexpr int kWidth = 3 * kRows;
  using Block = Eigen::Matrix<double, kWidth, kWidth>;
#pragma omp parallel for schedule(static) if (count > kWorthThreads)
  for (Index t = 0; t < count; ++t) {
    const Index row = t / kLanes, lane = t % kLanes;
    Row6 sum = Row6::Zero();
    for (Index slot = slots[static_cast<size_t>(row)]; slot < slots[static_cast<size_t>(row) + 1]; ++slot) {
      for (Index c = 0; c < 6; ++c) sum[c] += values.row(slot)[c][lane];
    }
    Block block = Block::Zero();
    for (int i = 0, k = 0; i < kWidth; ++i) {
      for (int j = 0; j <= i; ++j) block(i, j) = static_cast<double>(own.row(row)[k++][lane]);
    }
    for (int r = 0; r < kRows; ++r) block.template block<3, 3>(3 * r, 3 * r) += unpacked(sum);
    const Block inverted = block.template selfadjointView<Eigen::Lower>().llt().solve(Block::Identity());
    for (int i = 0, k = 0; i < kWidth; ++i) {
      for (int j = 0; j <= i; ++j) inverse(row, k++, lane) = static_cast<float>(inverted(i, j));
    }
  }
}

template <int kRows>
void Multilevel::Level::load(const VectorXf& x, Index row, Lanes* lanes) const {
  constexpr int kWidth = 3 * kRows;
  for (Index lane = 0; lane < kLanes; ++lane) {
    const float* from = x.data() + std::min(row * kLanes + lane, count - 1) * kWidth;
    for (int i = 0; i < kWidth; ++i) lanes[i][lane] = from[i];
  }
}

template <int kRows>
void Multilevel::Level::store(const Lanes* lanes, Index row, VectorXf& x) const {
  constexpr int kWidth = 3 * kRows;
  const Index present = std::min<Index>(kLanes, count - row * kLanes);
  float* to = x.data() + row * kLanes * kWidth;
  for (Index lane = 0; lane < present; ++lane) {
    for (int i = 0; i < kWidth; ++i) *to++ = lanes[i][lane];
  }
}

template <int kRows>
void Multilevel::Level::row_product(const VectorXf& x, Index row, Lanes* product) const {
  constexpr int kWidth = 3 * kRows;
  std::array<Lanes, kWidth> mine, apart;
  load<kRows>(x, row, mine.data());
  for (int i = 0; i < kWidth; ++i) product[i].setZero();
  add_product<kWidth>(own.row(row), mine.data(), product);
  for (Index slot = slots[static_cast<size_t>(row)]; slot < slots[static_cast<size_t>(row) + 1]; ++slot) {
    for (Index lane = 0; lane < kLanes; ++lane) {
      const float* theirs = x.data() + Index{neighbours[static_cast<size_t>(slot * kLanes + lane)]} * kWidth;
      for (size_t i = 0; i < kWidth; ++i) apart[i][lane] = theirs[i];
    }
    const Lanes* c = values.row(slot);
    for (size_t r = 0; r < kWidth; r += 3) {
      const Lanes a = mine[r] - apart[r], b = mine[r + 1] - apart[r + 1], d = mine[r + 2] - apart[r + 2];
      product[r] += a * c[0] + b * c[1] + d * c[2];
      product[r + 1] += a * c[1] + b * c[3] + d * c[4];
      product[r + 2] += a * c[2] + b * c[4] + d * c[5];
    }
  }
}

template <int kRows>
void Multilevel::Level::begin(const VectorXf& right, VectorXf& x) const {
  x.resize(right.size());
#pragma omp parallel for schedule(static) if (count > kWorthThreads)
  for (Index row = 0; row < lane_rows(); ++row) {
    std::array<Lanes, size_t{3} * kRows> side, sum;
    load<kRows>(right, row, side.data());
    sum.fill(Lanes::Zero());
    add_product<3 * kRows>(inverse.row(row), side.data(), sum.data());
    for (Lanes& lanes : sum) lanes *= kDamping;
    store<kRows>(sum.data(), row, x);
  }
}

template <int kRows>
void Multilevel::Level::multiply(const VectorXf& x, VectorXf& image) const {
  image.resize(x.size());
#pragma omp parallel for schedule(static) if (count > kWorthThreads)
  for (Index row = 0; row < lane_rows(); ++row) {
    std::array<Lanes, size_t{3} * kRows> product;
    row_product<kRows>(x, row, product.data());
    store<kRows>(product.data(), row, image);
  }
}

template <int kRows>
void Multilevel::Level::residual(const VectorXf& right, const VectorXf& x, VectorXf& left) const {
  left.resize(x.size());
#pragma omp parallel for schedule(static) if (count > kWorthThreads)
  for (Index row = 0; row < lane_rows(); ++row) {
    std::array<Lanes, size_t{3} * kRows> product, side;
    row_product<kRows>(x, row, product.data());
    load<kRows>(right, row, side.data());
    for (size_t i = 0; i < product.size(); ++i) product[i] = side[i] - product[i];
    store<kRows>(product.data(), row, left);
  }
}

template <int kRows>
void Multilevel::Level::sweep(const VectorXf& right, const VectorXf& x, VectorXf& swept) const {
  swept.resize(x.size());
#pragma omp parallel for schedule(static) if (count > kWorthThreads)
  for (Index row = 0; row < lane_rows(); ++row) {
    std::array<Lanes, size_t{3} * kRows> left, side, sum;
    row_product<kRows>(x, row, left.data());
    load<kRows>(right, row, side.data());
    for (size_t i = 0; i < left.size(); ++i) left[i] = kDamping * (side[i] - left[i]);
    load<kRows>(x, row, sum.data());
    add_product<3 * kRows>(inverse.row(row), left.data(), sum.data());
    store<kRows>(sum.data(), row, swept);
  }
}

template <int kRows>
void Multilevel::Level::gather(const VectorXf& fine, VectorXf& coarse) const {
  constexpr int kWidth = 3 * kRows;
  coarse.resize(coarse_count() * kWidth);
#pragma omp parallel for schedule(static) if (count > kWorthThreads)
  for (Index c = 0; c < coarse_count(); ++c) {
    std::array<float, kWidth> sum = {};
    for (int p = part_offsets[static_cast<size_t>(c)]; p < part_offsets[static_cast<size_t>(c) + 1]; ++p) {
      const float* part = fine.data() + Index{parts[static_cast<size_t>(p)]} * kWidth;
      for (size_t i = 0; i < kWidth; ++i) sum[i] += part[i];
    }
    std::copy(sum.begin(), sum.end(), coarse.data() + c * kWidth);
  }
}

template <int kRows>
void Multilevel::Level::scatter(const VectorXf& coarse, VectorXf& fine) const {
  constexpr int kWidth = 3 * kRows;
#pragma omp parallel for schedule(static) if (count > kWorthThreads)
  for (Index t = 0; t < count; ++t) {
    const float* from = coarse.data() + Index{into[static_cast<size_t>(t)]} * kWidth;
    for (int i = 0; i < kWidth; ++i) fine[t * kWidth + i] += from[i];
  }
}

namespace {

using Levels = std::vector<std::unique_ptr<Multilevel::Level>>;

/// What a cycle writes on a level, kept from one to the next.
struct Scratch {
  VectorXf right, solution, left, first, image, second_image;
};

/// One thread's cycles.
template <int kRows>
class Cycles {
 public:
  Cycles(const Levels& levels, const BlockSystem& coarsest)
      : levels_(levels), coarsest_(coarsest), scratch_(levels.size() + 1) {}

  /// About the error that leaves the residual `right` on a level.
  void cycle(size_t depth, const VectorXf& right, VectorXf& error) {
    if (depth == levels_.size()) {
      error = coarsest_.solve(right.cast<double>()).template cast<float>();
      return;
    }
    const Multilevel::Level& level = *levels_[depth];
    Scratch& mine = scratch_[depth];
    Scratch& below = scratch_[depth + 1];
    level.begin<kRows>(right, mine.solution);
    level.residual<kRows>(right, mine.solution, mine.left);
    level.gather<kRows>(mine.left, below.right);
    solve_coarse(depth + 1, below.right, mine.left);
    level.scatter<kRows>(mine.left, mine.solution);
    level.sweep<kRows>(right, mine.solution, error);
  }

 private:
  /// One or two steps of conjugate gradients, each preconditioned by the levels below (K-cycle).
  void solve_coarse(size_t depth, VectorXf& right, VectorXf& solution) {
    if (depth == levels_.size()) return cycle(depth, right, solution);
    const Multilevel::Level& level = *levels_[depth];
    Scratch& mine = scratch_[depth];
    cycle(depth, right, mine.first);
    level.multiply<kRows>(mine.first, mine.image);
    const float energy = mine.first.dot(mine.image), gain = mine.first.dot(right);
    if (!(energy > 0)) {
      solution = mine.first;
      return;
    }
    const float before = right.norm();
    right -= gain / energy * mine.image;
    if (right.norm() > kEnough * before) {
      cycle(depth, right, solution);
      level.multiply<kRows>(solution, mine.second_image);
      const float mixed = solution.dot(mine.image), second_gain = solution.dot(right);
      const float second_energy = solution.dot(mine.second_image) - mixed * mixed / energy;
      if (second_energy > 0) {
        const float more = second_gain / second_energy;
        solution = (gain / energy - mixed / energy * more) * mine.first + more * solution;
        return;
      }
    }
    solution = gain / energy * mine.first;
  }

  const Levels& levels_;
  const BlockSystem& coarsest_;
  std::vector<Scratch> scratch_;
};

template <int kRows>
Eigen::VectorXd solution_by(Cycles<kRows> cycles, const Levels& levels, const Eigen::VectorXd& right_hand_side,
                            double tolerance, int limit, const Poll& poll) {
  VectorXf solution = VectorXf::Zero(right_hand_side.size());
  conjugate_gradients([&](const VectorXf& x, VectorXf& image) { levels.front()->multiply<kRows>(x, image); },
                      [&](const VectorXf& residual, VectorXf& error) {
                        ask(poll);
                        cycles.cycle(0, residual, error);
                      },
                      VectorXf(right_hand_side.cast<float>()), tolerance, limit, solution);
  return solution.cast<double>();
}

template <int kRows>
Gradients improve_by(Cycles<kRows> cycles, const Multilevel::TimesMatrix& times_matrix,
                     const Eigen::VectorXd& right_hand_side, double tolerance, int limit, Eigen::VectorXd& solution,
                     const Poll& poll) {
  VectorXf right, left;
  return conjugate_gradients(
      times_matrix,
      [&](const Eigen::VectorXd& residual, Eigen::VectorXd& error) {
        ask(poll);
        right = residual.cast<float>();
        cycles.cycle(0, right, left);
        error = left.cast<double>();
      },
      right_hand_side, tolerance, limit, solution);
}

void fill(BlockSystem& system, const ElementGraph& graph) {
  const int width = 3 * graph.rows;
  system.set_zero();
  for (Index t = 0; t < graph.own.rows(); ++t) {
    Eigen::MatrixXd block(width, width);
    for (int r = 0, k = 0; r < width; ++r) {
      for (int c = 0; c <= r; ++c, ++k) block(r, c) = block(c, r) = static_cast<double>(graph.own(t, k));
    }
    system.add(static_cast<int>(t), block);
  }
  for (size_t p = 0; p < graph.pairs.size(); ++p) {
    const auto [i, j] = graph.pairs[p];
    if (i == j) continue;
    const Eigen::Matrix3d coupling = unpacked(graph.couplings.row(static_cast<Index>(p)));
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(width, width);
    for (int r = 0; r < graph.rows; ++r) {
      block.block<3, 3>(3 * r, 3 * r) = coupling;
      system.add(i, j, r, -coupling);
    }
    system.add(i, block);
    system.add(j, block);
  }
  system.factor();
}

std::vector<std::pair<int, int>> couplings_apart(const ElementGraph& graph) {
  std::vector<std::pair<int, int>> pairs;
  std::copy_if(graph.pairs.begin(), graph.pairs.end(), std::back_inserter(pairs),
               [](const auto& pair) { return pair.first != pair.second; });
  return pairs;
}

}  // namespace

Multilevel::Multilevel(const ElementGraph& graph, const Poll& poll) {
  ElementGraph coarse, next;
  const ElementGraph* now = &graph;
  Couplings couplings = couplings_of(graph);
  while (now->own.rows() > kCoarsest) {
    ask(poll);
    auto level = std::make_unique<Level>(*now, couplings);
    ask(poll);
    level->fill(*now);
    std::vector<int> into(static_cast<size_t>(level->count));
    std::iota(into.begin(), into.end(), 0);
    ElementGraph merging{now->rows, {}, {}, now->own};
    for (int round = 0; round < kRounds; ++round) {
      ask(poll);
      const Merge merge = pairing(couplings);
      merging = merged(couplings, merging.own, now->rows, merge);
      ask(poll);
      for (int& element : into) element = merge.into[static_cast<size_t>(element)];
      couplings = couplings_of(merging);
    }
    const bool stalls = merging.own.rows() > level->count * 3 / 4;
    next.pairs = level->merge_into(std::move(into), now->pairs, couplings);
    pairs_.push_back(next.pairs);
    level->coarsen(*now, next);
    std::swap(coarse, next);
    now = &coarse;
    levels_.push_back(std::move(level));
    if (stalls) break;  // Nothing is coupled: each element is for itself, and so cheap to factor.
  }
  coarsest_.emplace(static_cast<int>(now->own.rows()), now->rows, couplings_apart(*now));
  fill(*coarsest_, *now);
}

void Multilevel::refill(const ElementGraph& graph) {
  ElementGraph coarse, next;
  const ElementGraph* now = &graph;
  for (size_t depth = 0; depth < levels_.size(); ++depth) {
    levels_[depth]->fill(*now);
    next.pairs = pairs_[depth];
    levels_[depth]->coarsen(*now, next);
    std::swap(coarse, next);
    now = &coarse;
  }
  fill(*coarsest_, *now);
}

Multilevel::~Multilevel() = default;
Multilevel::Multilevel(Multilevel&&) noexcept = default;
Multilevel& Multilevel::operator=(Multilevel&&) noexcept = default;

Eigen::VectorXd Multilevel::solve(const Eigen::VectorXd& right_hand_side, double tolerance, int limit,
                                  const Poll& poll) const {
  if (levels_.empty()) return coarsest_->solve(right_hand_side);
  return levels_.front()->rows == 1
             ? solution_by(Cycles<1>(levels_, *coarsest_), levels_, right_hand_side, tolerance, limit, poll)
             : solution_by(Cycles<3>(levels_, *coarsest_), levels_, right_hand_side, tolerance, limit, poll);
}

Gradients Multilevel::improve(const TimesMatrix& times_matrix, const Eigen::VectorXd& right_hand_side, double tolerance,
                              int limit, Eigen::VectorXd& solution, const Poll& poll) const {
  if (!levels_.empty() && levels_.front()->rows == 3) {
    return improve_by(Cycles<3>(levels_, *coarsest_), times_matrix, right_hand_side, tolerance, limit, solution, poll);
  }
  return improve_by(Cycles<1>(levels_, *coarsest_), times_matrix, right_hand_side, tolerance, limit, solution, poll);
}

int Multilevel::levels() const { return static_cast<int>(levels_.size()) + 1; }

std::size_t Multilevel::bytes() const {
  std::size_t sum = coarsest_->bytes();
  for (const auto& level : levels_) sum += level->bytes();
  return sum;
}

}  // namespace swage

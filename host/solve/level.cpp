#include "level.h"

#include <Eigen/Cholesky>
#include <numeric>

namespace swage {
namespace {

using Eigen::Index;
using Eigen::VectorXf;

constexpr float kDamping = 0.7F;                 // Of a Jacobi sweep.
constexpr Index kUnknownsWorthThreads = 50'000;  // Unknowns. On a busy machine threads are long in meeting.

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

Level::Level(const ElementGraph& graph, const Couplings& couplings, const Poll& poll)
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
  ask(poll);
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

std::vector<std::pair<int, int>> Level::merge_into(std::vector<int> coarse,
                                                   const std::vector<std::pair<int, int>>& pairs,
                                                   const Couplings& couplings, const Poll& poll) {
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
  ask(poll);
  coarse_pairs.reserve(pairs.size());
  for (const auto& [i, j] : pairs) {
    const auto [a, b] = std::minmax({into[static_cast<size_t>(i)], into[static_cast<size_t>(j)]});
    coarse_pairs.push_back(a == b ? -1 : number[static_cast<size_t>(couplings.find(a, b))]);
  }
  return coarse_list;
}

void Level::fill(const ElementGraph& graph, const Poll& poll) {
#pragma omp parallel for schedule(static) if (unknowns() > kUnknownsWorthThreads)
  for (Index t = 0; t < count; ++t) {
    for (Index k = 0; k < graph.own.cols(); ++k) own(t / kLanes, k, t % kLanes) = graph.own(t, k);
  }
  ask(poll);
  values.set_zero();
  for (size_t p = 0; p < places.size(); ++p) {
    if (places[p][0] < 0) continue;
    for (const Index place : places[p]) {
      for (Index c = 0; c < 6; ++c) {
        values(place / kLanes, c, place % kLanes) += graph.couplings(static_cast<Index>(p), c);
      }
    }
  }
  constexpr Index kPart = 1 << 18;  // Elements between polls: a fifth of a second.
  for (Index first = 0; first < count; first += kPart) {
    ask(poll);
    const Index end = std::min(count, first + kPart);
    rows == 1 ? invert<1>(first, end) : invert<3>(first, end);
  }
}

void Level::coarsen(const ElementGraph& graph, ElementGraph& coarse) const {
  coarse.rows = rows;
  coarse.own.resize(coarse_count(), graph.own.cols());
#pragma omp parallel for schedule(static) if (unknowns() > kUnknownsWorthThreads)
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
void Level::invert(Index first, Index end) {
  constexpr int kWidth = 3 * kRows;
  using Block = Eigen::Matrix<double, kWidth, kWidth>;
#pragma omp parallel for schedule(static) if (unknowns() > kUnknownsWorthThreads)
  for (Index t = first; t < end; ++t) {
    const Index row = t / kLanes, lane = t % kLanes;
    PackedCoupling sum = PackedCoupling::Zero();
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
void Level::load(const VectorXf& x, Index row, Lanes* lanes) const {
  constexpr int kWidth = 3 * kRows;
  for (Index lane = 0; lane < kLanes; ++lane) {
    const float* from = x.data() + std::min(row * kLanes + lane, count - 1) * kWidth;
    for (int i = 0; i < kWidth; ++i) lanes[i][lane] = from[i];
  }
}

template <int kRows>
void Level::store(const Lanes* lanes, Index row, VectorXf& x) const {
  constexpr int kWidth = 3 * kRows;
  const Index present = std::min<Index>(kLanes, count - row * kLanes);
  float* to = x.data() + row * kLanes * kWidth;
  for (Index lane = 0; lane < present; ++lane) {
    for (int i = 0; i < kWidth; ++i) *to++ = lanes[i][lane];
  }
}

template <int kRows>
void Level::row_product(const VectorXf& x, Index row, Lanes* product) const {
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

template <typename Work>
void Level::each_row(const Work& work) const {
#pragma omp parallel for schedule(static) if (unknowns() > kUnknownsWorthThreads)
  for (Index row = 0; row < lane_rows(); ++row) work(row);
}

template <int kRows>
void Level::begin(const VectorXf& right, VectorXf& x) const {
  x.resize(right.size());
  each_row([&](Index row) {
    std::array<Lanes, size_t{3} * kRows> side, sum;
    load<kRows>(right, row, side.data());
    sum.fill(Lanes::Zero());
    add_product<3 * kRows>(inverse.row(row), side.data(), sum.data());
    for (Lanes& lanes : sum) lanes *= kDamping;
    store<kRows>(sum.data(), row, x);
  });
}

template <int kRows>
void Level::multiply(const VectorXf& x, VectorXf& image) const {
  image.resize(x.size());
  each_row([&](Index row) {
    std::array<Lanes, size_t{3} * kRows> product;
    row_product<kRows>(x, row, product.data());
    store<kRows>(product.data(), row, image);
  });
}

template <int kRows>
void Level::residual(const VectorXf& right, const VectorXf& x, VectorXf& left) const {
  left.resize(x.size());
  each_row([&](Index row) {
    std::array<Lanes, size_t{3} * kRows> product, side;
    row_product<kRows>(x, row, product.data());
    load<kRows>(right, row, side.data());
    for (size_t i = 0; i < product.size(); ++i) product[i] = side[i] - product[i];
    store<kRows>(product.data(), row, left);
  });
}

template <int kRows>
void Level::sweep(const VectorXf& right, const VectorXf& x, VectorXf& swept) const {
  swept.resize(x.size());
  each_row([&](Index row) {
    std::array<Lanes, size_t{3} * kRows> left, side, sum;
    row_product<kRows>(x, row, left.data());
    load<kRows>(right, row, side.data());
    for (size_t i = 0; i < left.size(); ++i) left[i] = kDamping * (side[i] - left[i]);
    load<kRows>(x, row, sum.data());
    add_product<3 * kRows>(inverse.row(row), left.data(), sum.data());
    store<kRows>(sum.data(), row, swept);
  });
}

template <int kRows>
void Level::gather(const VectorXf& fine, VectorXf& coarse) const {
  constexpr int kWidth = 3 * kRows;
  coarse.resize(coarse_count() * kWidth);
#pragma omp parallel for schedule(static) if (unknowns() > kUnknownsWorthThreads)
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
void Level::scatter(const VectorXf& coarse, VectorXf& fine) const {
  constexpr int kWidth = 3 * kRows;
#pragma omp parallel for schedule(static) if (unknowns() > kUnknownsWorthThreads)
  for (Index t = 0; t < count; ++t) {
    const float* from = coarse.data() + Index{into[static_cast<size_t>(t)]} * kWidth;
    for (int i = 0; i < kWidth; ++i) fine[t * kWidth + i] += from[i];
  }
}

template void Level::begin<1>(const VectorXf&, VectorXf&) const;
template void Level::multiply<1>(const VectorXf&, VectorXf&) const;
template void Level::residual<1>(const VectorXf&, const VectorXf&, VectorXf&) const;
template void Level::sweep<1>(const VectorXf&, const VectorXf&, VectorXf&) const;
template void Level::gather<1>(const VectorXf&, VectorXf&) const;
template void Level::scatter<1>(const VectorXf&, VectorXf&) const;
template void Level::begin<3>(const VectorXf&, VectorXf&) const;
template void Level::multiply<3>(const VectorXf&, VectorXf&) const;
template void Level::residual<3>(const VectorXf&, const VectorXf&, VectorXf&) const;
template void Level::sweep<3>(const VectorXf&, const VectorXf&, VectorXf&) const;
template void Level::gather<3>(const VectorXf&, VectorXf&) const;
template void Level::scatter<3>(const VectorXf&, VectorXf&) const;

}  // namespace swage

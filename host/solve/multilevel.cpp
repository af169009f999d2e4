#include "multilevel.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "conjugate_gradients.h"
#include "level.h"
#include "swage/error.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::VectorXf;

constexpr int kRounds = 3;        // Of pairing: up to eight elements become one.
constexpr int kCoarsest = 300;    // Elements that are solved for at once.
constexpr double kEnough = 0.25;  // A coarse residual so much smaller needs no second step.

using Levels = std::vector<std::unique_ptr<Level>>;

/// What a cycle writes on a level.
struct Scratch {
  VectorXf right, solution, left, first, image, second_image, correction;
};

}  // namespace

/// What one thread's solves write.
struct MultilevelWork {
  std::vector<Scratch> levels;
  GradientsWork<VectorXf> single;
  GradientsWork<Eigen::VectorXd> twice;
  VectorXf right, found;
};

namespace {

template <int kRows>
class Cycles {
 public:
  Cycles(const Levels& levels, const BlockSystem& coarsest, std::vector<Scratch>& scratch, const Poll& poll)
      : levels_(levels), coarsest_(coarsest), scratch_(scratch), poll_(poll) {
    scratch_.resize(levels.size() + 1);
  }

  /// About the error that leaves the residual `right` on a level.
  void cycle(size_t depth, const VectorXf& right, VectorXf& error) {
    ask(poll_);
    if (depth == levels_.size()) {
      error = coarsest_.solve(right.cast<double>()).template cast<float>();
      return;
    }
    const Level& level = *levels_[depth];
    Scratch& mine = scratch_[depth];
    Scratch& below = scratch_[depth + 1];
    level.begin<kRows>(right, mine.solution);
    level.residual<kRows>(right, mine.solution, mine.left);
    level.gather<kRows>(mine.left, below.right);
    solve_coarse(depth + 1, below.right, below.correction);
    level.scatter<kRows>(below.correction, mine.solution);
    level.sweep<kRows>(right, mine.solution, error);
  }

  void multiply(const VectorXf& x, VectorXf& image) const { levels_.front()->multiply<kRows>(x, image); }

 private:
  /// One or two steps of conjugate gradients, each preconditioned by the levels below (K-cycle).
  void solve_coarse(size_t depth, VectorXf& right, VectorXf& solution) {
    if (depth == levels_.size()) return cycle(depth, right, solution);
    const Level& level = *levels_[depth];
    Scratch& mine = scratch_[depth];
    cycle(depth, right, mine.first);
    level.multiply<kRows>(mine.first, mine.image);
    const auto [energy, gain] = products<VectorXf, 2>(mine.first, {&mine.image, &right});
    if (!(energy > 0)) {
      solution = mine.first;
      return;
    }
    const double before = product(right, right);
    combine(-gain / energy, mine.image, 1, right);
    if (product(right, right) > kEnough * kEnough * before) {
      cycle(depth, right, solution);
      level.multiply<kRows>(solution, mine.second_image);
      const auto [mixed, second_gain, bend] =
          products<VectorXf, 3>(solution, {&mine.image, &right, &mine.second_image});
      const double second_energy = bend - mixed * mixed / energy;
      if (second_energy > 0) {
        const double more = second_gain / second_energy;
        combine((gain - mixed * more) / energy, mine.first, more, solution);
        return;
      }
    }
    solution = mine.first;
    solution *= static_cast<float>(gain / energy);
  }

  const Levels& levels_;
  const BlockSystem& coarsest_;
  std::vector<Scratch>& scratch_;
  const Poll& poll_;
};

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
  try {
    system.factor();
  } catch (const Indefinite&) {  // Its elements are no one's.
    throw Unsolvable(
        "multigrid: the coarsest level is not positive definite; look for degenerate triangles or a part without a "
        "handle");
  }
}

std::vector<std::pair<int, int>> couplings_apart(const ElementGraph& graph) {
  std::vector<std::pair<int, int>> pairs;
  std::copy_if(graph.pairs.begin(), graph.pairs.end(), std::back_inserter(pairs),
               [](const auto& pair) { return pair.first != pair.second; });
  return pairs;
}

}  // namespace

Multilevel::Multilevel(const ElementGraph& graph, const Poll& poll) : works_(std::make_unique<Pool<MultilevelWork>>()) {
  ElementGraph coarse, next;
  const ElementGraph* now = &graph;
  Couplings couplings = couplings_of(graph, poll);
  while (now->own.rows() > kCoarsest) {
    ask(poll);
    auto level = std::make_unique<Level>(*now, couplings, poll);
    ask(poll);
    level->fill(*now, poll);
    std::vector<int> into(static_cast<size_t>(level->count));
    std::iota(into.begin(), into.end(), 0);
    ElementGraph merging{now->rows, {}, {}, now->own};
    for (int round = 0; round < kRounds; ++round) {
      ask(poll);
      const Merge merge = pairing(couplings);
      merging = merged(couplings, merging.own, now->rows, merge);
      ask(poll);
      for (int& element : into) element = merge.into[static_cast<size_t>(element)];
      couplings = couplings_of(merging, poll);
    }
    const bool stalls = merging.own.rows() > level->count * 3 / 4;
    next.pairs = level->merge_into(std::move(into), now->pairs, couplings, poll);
    ask(poll);
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

void Multilevel::refill(const ElementGraph& graph, const Poll& poll) {
  ElementGraph coarse, next;
  const ElementGraph* now = &graph;
  for (size_t depth = 0; depth < levels_.size(); ++depth) {
    levels_[depth]->fill(*now, poll);
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

template <typename Work>
Gradients Multilevel::by_cycles(const Poll& poll, const Work& work) const {
  const auto lent = works_->lend([] { return std::make_unique<MultilevelWork>(); });
  if (!levels_.empty() && levels_.front()->rows == 3) {
    Cycles<3> cycles(levels_, *coarsest_, lent->levels, poll);
    return work(cycles, *lent);
  }
  Cycles<1> cycles(levels_, *coarsest_, lent->levels, poll);
  return work(cycles, *lent);
}

Gradients Multilevel::solve(const Eigen::VectorXd& right_hand_side, double tolerance, int limit,
                            Eigen::VectorXd& solution, const Poll& poll) const {
  if (levels_.empty()) {
    solution = coarsest_->solve(right_hand_side);
    return {0, true};
  }
  return by_cycles(poll, [&](auto& cycles, MultilevelWork& work) {
    work.right = right_hand_side.cast<float>();
    work.found.setZero(work.right.size());
    ask(poll);
    const auto precondition = [&](const VectorXf& residual, VectorXf& error) { cycles.cycle(0, residual, error); };
    const auto times_matrix = [&](const VectorXf& x, VectorXf& image) { cycles.multiply(x, image); };
    const Gradients done =
        conjugate_gradients(times_matrix, precondition, work.right, tolerance, limit, work.found, work.single);
    solution = work.found.cast<double>();
    return done;
  });
}

Gradients Multilevel::improve(const TimesMatrix& times_matrix, const Eigen::VectorXd& right_hand_side, double tolerance,
                              int limit, Eigen::VectorXd& solution, const Poll& poll) const {
  return by_cycles(poll, [&](auto& cycles, MultilevelWork& work) {
    const auto precondition = [&](const Eigen::VectorXd& residual, Eigen::VectorXd& error) {
      work.right = residual.cast<float>();
      cycles.cycle(0, work.right, work.found);
      error = work.found.cast<double>();
    };
    return conjugate_gradients(times_matrix, precondition, right_hand_side, tolerance, limit, solution, work.twice);
  });
}

int Multilevel::levels() const { return static_cast<int>(levels_.size()) + 1; }

std::size_t Multilevel::bytes() const {
  std::size_t sum = coarsest_->bytes();
  for (const auto& level : levels_) sum += level->bytes();
  return sum;
}

}  // namespace swage

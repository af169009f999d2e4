// The supernodal factor (GPL, in CHOLMOD) and METIS's nested dissection.
#include <sys/mman.h>

#include <Eigen/CholmodSupport>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <string>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "factor.h"
#include "pool.h"
#include "swage/error.h"

extern "C" {
// NOLINTNEXTLINE(readability-identifier-naming)
void dpotrf_(const char* triangle, const int* size, double* matrix, const int* rows, int* info);
int openblas_get_num_threads();
void openblas_set_num_threads(int);
}

namespace swage {
namespace {

/// While it lives CHOLMOD and OpenBLAS keep to the calling thread. Supernodes of meshes are small: CHOLMOD's four
/// threads a loop double the time and worse, OpenBLAS's gain nothing. And the bytes are the same for any number of
/// threads.
class OneThread {
 public:
  OneThread() {
    const std::lock_guard lock(changing);
    if (alive++ == 0) {
      threads_before = openblas_get_num_threads();
      openblas_set_num_threads(1);
    }
  }
  ~OneThread() {
    const std::lock_guard lock(changing);
    if (--alive == 0) openblas_set_num_threads(threads_before);
#ifdef _OPENMP
    omp_set_max_active_levels(levels_before_);
#endif
  }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  // OpenBLAS's setting is the process's: the first in sets it, the last out restores it.
  static inline std::mutex changing;
  static inline int alive = 0, threads_before = 1;
#ifdef _OPENMP
  const int levels_before_ = [] {
    const int levels = omp_get_max_active_levels();
    omp_set_max_active_levels(0);
    return levels;
  }();
#endif
};

/// OpenBLAS takes room with its first call, keeps it, and waits for ever where there is none: so it is looked for
/// before, and taken before the factor takes what is left.
void take_room_for_blas() {
  constexpr size_t kRoom = (size_t{128} << 20) + (1 << 16);
  void* const room = mmap(nullptr, kRoom, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw Unsolvable("factor: the memory does not suffice: take a coarser mesh");
  munmap(room, kRoom);
  const OneThread one_thread;
  const int one = 1;
  double matrix = 1;
  int info = 0;
  dpotrf_("L", &one, &matrix, &one, &info);
}

/// While it lives std::rand, which METIS seeds and draws from, has another state than the program's.
class OwnRandom {
 public:
  OwnRandom() : before_(initstate(1, state_, sizeof state_)) {}
  ~OwnRandom() { setstate(before_); }
  OwnRandom(const OwnRandom&) = delete;
  OwnRandom& operator=(const OwnRandom&) = delete;

 private:
  char state_[128];
  char* before_;
};

void check(const cholmod_common& common) {
  if (common.status == CHOLMOD_OUT_OF_MEMORY) {
    throw Unsolvable("factor: the memory does not suffice: take a coarser mesh");
  }
  if (common.status == CHOLMOD_TOO_LARGE) {
    throw Unsolvable("factor: its entries are more than can be counted: take a coarser mesh");
  }
  if (common.status < CHOLMOD_OK) {
    throw Unsolvable("factor: CHOLMOD refuses the matrix, status " + std::to_string(common.status));
  }
}

/// What a solve works in, kept from one to the next.
struct Room {
  Room() {
    cholmod_start(&common);
    common.print = 0;
  }
  ~Room() {
    for (cholmod_dense** array : {&solution, &permuted, &gathered}) cholmod_free_dense(array, &common);
    cholmod_finish(&common);
  }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  cholmod_common common;
  cholmod_dense *solution = nullptr, *permuted = nullptr, *gathered = nullptr;
};

class Supernodal : public Factor, Eigen::CholmodBase<SparseMatrix, Eigen::Upper, Supernodal> {
 public:
  Supernodal() {
    m_cholmod.supernodal = CHOLMOD_SUPERNODAL;
    m_cholmod.final_asis = 1;
    m_cholmod.print = 0;
    m_cholmod.nmethods = 1;  // The order is the matrix's.
    m_cholmod.method[0].ordering = CHOLMOD_NATURAL;
  }
  void analyze(const SparseMatrix& matrix) override {
    take_room_for_blas();
    analyzePattern(matrix);
    check(m_cholmod);
  }

  int factorize(const SparseMatrix& matrix) override {
    const OneThread one_thread;
    CholmodBase::factorize(matrix);
    check(m_cholmod);
    const int first = first_bad_pivot();
    return first < 0 ? -1 : static_cast<const int*>(m_cholmodFactor->Perm)[first];
  }

  // Eigen's own would allocate a solution and two workspaces, and copy.
  void solve(Eigen::Ref<Eigen::MatrixXd> columns) const override {
    const OneThread one_thread;
    const auto room = rooms_.lend([] { return std::make_unique<Room>(); });
    cholmod_dense sides = Eigen::viewAsCholmod(columns);
    cholmod_solve2(CHOLMOD_A, m_cholmodFactor, &sides, nullptr, &room->solution, nullptr, &room->permuted,
                   &room->gathered, &room->common);
    check(room->common);
    columns = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(room->solution->x), columns.rows(),
                                                columns.cols());
  }

  std::optional<Supernodes> supernodes() const override {
    const cholmod_factor& factor = *m_cholmodFactor;
    auto ints = [](const void* first, size_t count) {
      return std::vector<int>(static_cast<const int*>(first), static_cast<const int*>(first) + count);
    };
    return Supernodes{ints(factor.Perm, factor.n),        ints(factor.super, factor.nsuper + 1),
                      ints(factor.pi, factor.nsuper + 1), ints(factor.s, factor.ssize),
                      ints(factor.px, factor.nsuper + 1), static_cast<const double*>(factor.x)};
  }

  Eigen::Index entries() const override { return static_cast<Eigen::Index>(m_cholmodFactor->xsize); }

 private:
  /// LAPACK's factorisation may take an undefined pivot for a good one.
  int first_bad_pivot() const {
    const auto minor = static_cast<int>(m_cholmodFactor->minor);
    const auto* begins = static_cast<const int*>(m_cholmodFactor->super);
    const auto* rows = static_cast<const int*>(m_cholmodFactor->pi);
    const auto* values = static_cast<const int*>(m_cholmodFactor->px);
    for (size_t s = 0; s < m_cholmodFactor->nsuper; ++s) {
      const double* pivot = static_cast<const double*>(m_cholmodFactor->x) + values[s];
      for (int column = begins[s]; column < begins[s + 1]; ++column, pivot += rows[s + 1] - rows[s] + 1) {
        if (column == minor || !(*pivot > 0 && std::isfinite(*pivot))) return column;
      }
    }
    return -1;
  }

  mutable Pool<Room> rooms_;
};

}  // namespace

bool has_cholmod() { return true; }

std::unique_ptr<Factor> supernodal_factor() { return std::make_unique<Supernodal>(); }

std::vector<int> nested_dissection(const SparseMatrix& graph) {
  static std::mutex one_at_a_time;  // Two at once would draw by chance.
  const std::lock_guard lock(one_at_a_time);
  const OwnRandom own_random;
  std::vector<int> order(static_cast<size_t>(graph.rows()));
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  cholmod_sparse view = Eigen::viewAsCholmod(graph.selfadjointView<Eigen::Upper>());
  cholmod_metis(&view, nullptr, 0, 1, order.data(), &common);
  cholmod_finish(&common);
  check(common);
  return order;
}

}  // namespace swage

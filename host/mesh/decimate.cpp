#include "decimate.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "collapses.h"
#include "half_edges.h"

namespace swage {
namespace {

/// Vertices or triangles, each taken over by another or not.
class Heirs {
 public:
  explicit Heirs(Eigen::Index count) : heirs_(Eigen::VectorXi::LinSpaced(count, 0, static_cast<int>(count) - 1)) {}
  void hand(int from, int to) { heirs_[from] = to; }
  bool is_own(int i) const { return heirs_[i] == i; }
  int of(int i) {
    while (heirs_[i] != i) {
      heirs_[i] = heirs_[heirs_[i]];
      i = heirs_[i];
    }
    return i;
  }

 private:
  Eigen::VectorXi heirs_;
};

/// The cheapest collapse of each vertex, cheapest first. An entry that its vertex has outlived is passed over.
class Queue {
 public:
  explicit Queue(int vertex_count)
      : versions_(Eigen::VectorXi::Zero(vertex_count)), sides_(Eigen::VectorXi::Constant(vertex_count, -1)) {}

  void put(int vertex, const Choice& choice) {
    ++versions_[vertex];
    sides_[vertex] = choice.side;
    if (choice.side < 0) return;
    heap_.push_back({choice.cost, vertex, versions_[vertex]});
    std::push_heap(heap_.begin(), heap_.end(), after);
  }
  /// A side, or -1 where none is left.
  int take() {
    while (!heap_.empty()) {
      const Entry entry = heap_.front();
      std::pop_heap(heap_.begin(), heap_.end(), after);
      heap_.pop_back();
      if (is_valid(entry)) return sides_[entry.vertex];
    }
    return -1;
  }
  /// Keeps the heap's size proportional to the vertices that are left.
  void tidy(int vertex_count) {
    if (heap_.size() < 3 * static_cast<size_t>(vertex_count) + 1024) return;
    std::erase_if(heap_, [&](const Entry& entry) { return !is_valid(entry); });
    std::make_heap(heap_.begin(), heap_.end(), after);
  }

 private:
  struct Entry {
    double cost;
    int vertex, version;
  };
  static bool after(const Entry& a, const Entry& b) {
    return a.cost > b.cost || (a.cost == b.cost && a.vertex > b.vertex);
  }
  bool is_valid(const Entry& entry) const { return versions_[entry.vertex] == entry.version; }

  std::vector<Entry> heap_;
  Eigen::VectorXi versions_, sides_;
};

class Decimation {
 public:
  Decimation(const Mesh& mesh, const std::vector<int>& kept, Pace& pace)
      : mesh_(mesh),
        pace_(pace),
        surface_(mesh.triangles, static_cast<int>(mesh.positions.rows()), pace),
        collapses_(mesh.positions, surface_),
        queue_(static_cast<int>(mesh.positions.rows())),
        vertices_(mesh.positions.rows()),
        triangles_(mesh.triangles.rows()),
        is_kept_(Eigen::VectorX<bool>::Constant(mesh.positions.rows(), false)),
        vertex_count_(static_cast<int>(mesh.positions.rows())),
        triangle_count_(static_cast<int>(mesh.triangles.rows())) {
    for (int v : kept) is_kept_[v] = true;
  }

  /// False where stopped.
  bool run(int triangle_count) {
    if (!pace_.step(0) || !collapses_.prepare(pace_)) return false;
    target_ = triangle_count;
    // What a pass found impossible may have become possible by what it did later.
    for (int before = triangle_count_ + 1; triangle_count_ - 2 >= target_ && triangle_count_ < before;) {
      before = triangle_count_;
      if (!fill() || !pass()) return false;
    }
    return true;
  }

  Proxy proxy() {
    Proxy proxy;
    Eigen::VectorXi numbers = Eigen::VectorXi::Constant(mesh_.positions.rows(), -1);
    for (int v = 0; v < numbers.size(); ++v) {
      if (!vertices_.is_own(v)) continue;
      numbers[v] = static_cast<int>(proxy.vertices.size());
      proxy.vertices.push_back(v);
    }
    proxy.vertex_of.resize(static_cast<size_t>(mesh_.positions.rows()));
    for (int v = 0; v < numbers.size(); ++v) proxy.vertex_of[static_cast<size_t>(v)] = numbers[vertices_.of(v)];
    proxy.mesh.positions = mesh_.positions(proxy.vertices, Eigen::all);
    number_triangles(numbers, proxy);
    return proxy;
  }

 private:
  bool fill() {
    for (int v = 0; v < is_kept_.size(); ++v) {
      if (!pace_.step(part())) return false;
      if (vertices_.is_own(v)) look_at(v);
    }
    return true;
  }

  bool pass() {
    while (triangle_count_ - 2 >= target_) {
      if (!pace_.step(part())) return false;
      const int side = queue_.take();
      if (side < 0) break;
      if (surface_.may_collapse(side)) {
        collapse(side);
      } else {
        look_at(surface_.from(side));
      }
      queue_.tidy(vertex_count_);
    }
    return true;
  }

  void look_at(int vertex) { queue_.put(vertex, is_kept_[vertex] ? Choice{} : collapses_.cheapest(vertex)); }

  void collapse(int side) {
    const int from = surface_.from(side), to = surface_.to(side);
    const std::array removed{side, surface_.twin(side)};
    ring_.clear();
    int spoke = side;
    do {
      ring_.push_back(surface_.to(spoke));
      spoke = surface_.turned(spoke);
    } while (spoke != side);
    std::array<std::array<int, 2>, 2> beside;
    for (size_t i : {0u, 1u}) {
      beside[i] = {surface_.twin(HalfEdges::next(removed[i])) / 3, surface_.twin(HalfEdges::previous(removed[i])) / 3};
    }

    collapses_.collapse(side);
    for (size_t i : {0u, 1u}) triangles_.hand(removed[i] / 3, collapses_.likest(removed[i] / 3, beside[i]));
    vertices_.hand(from, to);
    queue_.put(from, {});
    vertex_count_ -= 1;
    triangle_count_ -= 2;
    for (int v : ring_) look_at(v);
  }

  double part() const {
    const auto all = static_cast<double>(mesh_.triangles.rows());
    return (all - triangle_count_) / std::max(1.0, all - target_);
  }

  void number_triangles(const Eigen::VectorXi& vertex_numbers, Proxy& proxy) {
    const Triangles& triangles = surface_.triangles();
    Eigen::VectorXi numbers(triangles.rows());
    proxy.mesh.triangles.resize(triangle_count_, 3);
    int count = 0;
    for (int t = 0; t < triangles.rows(); ++t) {
      if (surface_.is_gone(t)) continue;
      for (int k = 0; k < 3; ++k) proxy.mesh.triangles(count, k) = vertex_numbers[triangles(t, k)];
      numbers[t] = count++;
    }
    proxy.triangle_of.resize(static_cast<size_t>(triangles.rows()));
    for (int t = 0; t < triangles.rows(); ++t) proxy.triangle_of[static_cast<size_t>(t)] = numbers[triangles_.of(t)];
  }

  const Mesh& mesh_;
  Pace& pace_;
  HalfEdges surface_;
  Collapses collapses_;
  Queue queue_;
  Heirs vertices_, triangles_;
  Eigen::VectorX<bool> is_kept_;
  std::vector<int> ring_;
  int vertex_count_, triangle_count_, target_ = 0;
};

Proxy itself(const Mesh& mesh) {
  Proxy proxy{mesh, {}, {}, {}};
  proxy.vertices.resize(static_cast<size_t>(mesh.positions.rows()));
  std::iota(proxy.vertices.begin(), proxy.vertices.end(), 0);
  proxy.vertex_of = proxy.vertices;
  proxy.triangle_of.resize(static_cast<size_t>(mesh.triangles.rows()));
  std::iota(proxy.triangle_of.begin(), proxy.triangle_of.end(), 0);
  return proxy;
}

}  // namespace

Proxy decimate(const Mesh& mesh, int triangle_count, const std::vector<int>& kept,
               const std::function<bool(double)>& goes_on) {
  if (triangle_count >= mesh.triangles.rows()) return itself(mesh);
  Pace pace(goes_on);
  Decimation decimation(mesh, kept, pace);
  if (!decimation.run(triangle_count)) return {};
  return decimation.proxy();
}

}  // namespace swage

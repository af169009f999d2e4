// The transform step on a device.
#include <map>
#include <utility>
#include <vector>

#include "kernel.h"
#include "opencl_steps.h"
#include "round_triangles.h"

namespace swage {
namespace {

using Eigen::Index;
using Rest = TransformStep::Rest;

/// The first two triangles beside each edge, or the one twice; and the few edges with more, with all theirs.
struct Beside {
  Eigen::Matrix<int, Eigen::Dynamic, 2> first_two;
  Eigen::VectorXi crowded_edges, offsets, triangles;
};

Beside triangles_beside(const Rest& rest) {
  Beside beside;
  auto& first = beside.first_two;
  first.setConstant(rest.edges.rows(), 2, -1);
  std::map<int, std::vector<int>> more;
  for (int t = 0; t < rest.triangles.rows(); ++t) {
    for (const int e : rest.triangle_edges.row(t)) {
      if (first(e, 0) < 0) {
        first.row(e).setConstant(t);
      } else if (first(e, 1) == first(e, 0)) {
        first(e, 1) = t;
      } else {
        more[e].push_back(t);
      }
    }
  }
  std::vector<int> edges, offsets{0}, triangles;
  for (const auto& [e, others] : more) {
    edges.push_back(e);
    triangles.insert(triangles.end(), {first(e, 0), first(e, 1)});
    triangles.insert(triangles.end(), others.begin(), others.end());
    offsets.push_back(static_cast<int>(triangles.size()));
  }
  auto vector = [](const std::vector<int>& list) {
    return Eigen::Map<const Eigen::VectorXi>(list.data(), static_cast<Index>(list.size()));
  };
  beside.crowded_edges = vector(edges);
  beside.offsets = vector(offsets);
  beside.triangles = vector(triangles);
  return beside;
}

Eigen::VectorXd initial_weights(const Rest& rest) {
  if (rest.length_weights.size() != 0) return rest.length_weights;
  const double squared = rest.mean_edge_length * rest.mean_edge_length;
  return (rest.edge_vectors.rowwise().squaredNorm() / squared).cwiseMax(1);  // Eq. 6
}

Eigen::VectorXd kept_lengths(const Rest& rest) {
  return rest.target_lengths.size() != 0 ? rest.target_lengths : Eigen::VectorXd::Zero(rest.edges.rows());
}

/// As compare_pairs reads it.
Eigen::Matrix<double, Eigen::Dynamic, 7> pair_rest(const Rest& rest) {
  Eigen::Matrix<double, Eigen::Dynamic, 7> table(rest.pairs.rows(), 7);
  for (Index p = 0; p < table.rows(); ++p) {
    table.row(p) << rest.edge_vectors.row(rest.pair_edges[p]).normalized(), rest.pair_opposites.row(p),
        rest.pair_similarities[p];
  }
  return table;
}

/// One term an element in each of its rows, and the rows' sums: by blocks on the device, the rest here.
class Terms {
 public:
  Terms(const Queue& queue, Index elements, int rows)
      : elements_(static_cast<int>(elements)),
        rows_(rows),
        blocks_((elements_ + kBlock - 1) / kBlock),
        values_(queue, elements * rows),
        sums_(queue, blocks_ * rows),
        add_up_(queue, "transform", "add_up") {}

  /// To be written by element, a row after the other.
  const Reals& values() const { return values_; }

  void add_up() { add_up_.launch(blocks_ * rows_, elements_, blocks_, values_, sums_); }

  /// Each row's sum of what was added up last, blocks in their order.
  Eigen::VectorXd sums() const {
    Eigen::MatrixXd blocks(blocks_, rows_);
    sums_.download(blocks);
    return blocks.colwise().sum().transpose();
  }

 private:
  static constexpr int kBlock = 64;  // Terms a sum in single precision bears without a loss that shows.
  int elements_, rows_, blocks_;
  Reals values_, sums_;
  Kernel add_up_;
};

class OpenClTransform final : public TransformStep {
 public:
  OpenClTransform(const SharedContext& context, const Rest& rest)
      : OpenClTransform(Queue(context), rest, triangles_beside(rest), round_triangles(rest)) {}

  void reset() override { placed_ = false; }

  void fit_edges(const Transforms& transforms, EdgeQuadratics& quadratics) override {
    transforms_.upload(transforms);
    invert_.launch(triangles_, transforms_, inverses_, damped_.values());
    damped_.add_up();
    const double mean = constants_.mean_edge_length;
    const double normal = constants_.normal_weight / mean, scale = constants_.scale_weight / mean;
    fit_edges_.launch(edges_, triangles_, normal, scale, beside_, transforms_, inverses_, normals_, edge_vectors_,
                      weights(), kept_, blocks_, sides_, targets_);
    fit_crowded_edges_.launch(crowded_, edges_, triangles_, normal, scale, crowded_edges_, crowded_offsets_,
                              crowded_triangles_, transforms_, inverses_, normals_, edge_vectors_, weights(), kept_,
                              blocks_, sides_, targets_);
    quadratics.blocks.resize(edges_, 6);
    quadratics.right_hand_sides.resize(edges_, 3);
    quadratics.target_lengths.resize(edges_);
    blocks_.download(quadratics.blocks);
    sides_.download(quadratics.right_hand_sides);
    targets_.download(quadratics.target_lengths);
    quadratics.singular = static_cast<int>(damped_.sums()[0]);
  }

  Energy fit_transforms(const Positions& positions, Transforms& right_hand_sides) override {
    upload(positions);
    const double mean = constants_.mean_edge_length;
    measure_edges_.launch(edges_, mean, ends_, positions_, residues_, edge_vectors_, vectors_, next_weights_,
                          edge_terms_.values());
    fit_triangles_.launch(triangles_, edges_, constants_.regularizer_weight, mean, triangle_edges_, transforms_,
                          inverses_, normals_, vectors_, edge_vectors_, weights(), right_hand_sides_,
                          triangle_terms_.values());
    compare_pairs_.launch(pair_count_, triangles_, pairs_, pair_rest_, transforms_, pair_terms_.values());
    compare_corners_.launch(round_, triangles_, round_triangles_, corners_, corner_rest_, positions_, residues_,
                            transforms_, corner_terms_.values());
    for (Terms* terms : {&edge_terms_, &triangle_terms_, &pair_terms_, &corner_terms_}) terms->add_up();
    std::swap(current_weights_, next_weights_);
    placed_ = true;
    right_hand_sides.resize(triangles_, 9);
    right_hand_sides_.download(right_hand_sides);
    return energy();
  }

 private:
  OpenClTransform(const Queue& queue, const Rest& rest, const Beside& beside, const RoundTriangles& round)
      : queue_(queue),
        constants_{rest.mean_edge_length, rest.normal_weight, rest.connect_weight, rest.scale_weight,
                   rest.regularizer_weight},
        triangles_(static_cast<int>(rest.triangles.rows())),
        edges_(static_cast<int>(rest.edges.rows())),
        crowded_(static_cast<int>(beside.crowded_edges.size())),
        pair_count_(static_cast<int>(rest.pairs.rows())),
        round_(static_cast<int>(round.triangles.size())),
        triangle_edges_(queue, rest.triangle_edges),
        ends_(queue, rest.edges),
        beside_(queue, beside.first_two),
        crowded_edges_(queue, beside.crowded_edges),
        crowded_offsets_(queue, beside.offsets),
        crowded_triangles_(queue, beside.triangles),
        pairs_(queue, rest.pairs),
        round_triangles_(queue, round.triangles),
        corners_(queue, round.corners),
        edge_vectors_(queue, rest.edge_vectors),
        normals_(queue, rest.normals),
        kept_(queue, kept_lengths(rest)),
        pair_rest_(queue, pair_rest(rest)),
        corner_rest_(queue, round.rest),
        initial_weights_(queue, initial_weights(rest)),
        current_weights_(queue, edges_),
        next_weights_(queue, edges_),
        transforms_(queue, triangles_ * 9),
        inverses_(queue, triangles_ * 9),
        blocks_(queue, edges_ * 6),
        sides_(queue, edges_ * 3),
        targets_(queue, edges_),
        positions_(queue, rest.vertices.size()),
        residues_(queue, Positions::Zero(rest.vertices.rows(), 3)),
        vectors_(queue, edges_ * 3),
        right_hand_sides_(queue, triangles_ * 9),
        damped_(queue, triangles_, 1),
        edge_terms_(queue, edges_, 1),
        triangle_terms_(queue, triangles_, 4),
        pair_terms_(queue, pair_count_, 2),
        corner_terms_(queue, round_, 2) {}

  /// The weights that the positions now asked for are placed with.
  const Reals& weights() const { return placed_ ? current_weights_ : initial_weights_; }

  void upload(const Positions& positions) {
    positions_.upload(positions, Layout::rows);
    if (queue_.context->precision() == Precision::twice) return;
    residues_.upload(positions - positions.cast<float>().cast<double>(), Layout::rows);
  }

  Energy energy() const {
    const Eigen::VectorXd triangles = triangle_terms_.sums(), pairs = pair_terms_.sums(),
                          corners = corner_terms_.sums();
    Energy sum;
    sum.transform = triangles[0];
    sum.normal = constants_.normal_weight * triangles[1];
    sum.scale = constants_.scale_weight / constants_.mean_edge_length * edge_terms_.sums()[0];
    sum.sphericity = corners[0];
    sum.connect = constants_.connect_weight * pairs[0];
    sum.similarity = pairs[1];
    sum.transform_sphericity = corners[1];
    sum.regularizer = constants_.regularizer_weight * triangles[3];
    sum.transform_normal = triangles[2];
    return sum;
  }

  struct Constants {
    double mean_edge_length, normal_weight, connect_weight, scale_weight, regularizer_weight;
  };

  Queue queue_;
  Constants constants_;
  int triangles_, edges_, crowded_, pair_count_, round_;

  // The rest shape.
  Ints triangle_edges_, ends_, beside_, crowded_edges_, crowded_offsets_, crowded_triangles_;
  Ints pairs_, round_triangles_, corners_;
  Reals edge_vectors_, normals_, kept_, pair_rest_, corner_rest_;

  Reals initial_weights_, current_weights_, next_weights_;
  bool placed_ = false;  // Whether current_weights_ stand in for the initial.
  Reals transforms_, inverses_, blocks_, sides_, targets_;
  Reals positions_, residues_, vectors_, right_hand_sides_;
  Terms damped_, edge_terms_, triangle_terms_, pair_terms_, corner_terms_;

  Kernel invert_{queue_, "transform", "invert"};
  Kernel fit_edges_{queue_, "transform", "fit_edges"};
  Kernel fit_crowded_edges_{queue_, "transform", "fit_crowded_edges"};
  Kernel measure_edges_{queue_, "transform", "measure_edges"};
  Kernel fit_triangles_{queue_, "transform", "fit_triangles"};
  Kernel compare_pairs_{queue_, "transform", "compare_pairs"};
  Kernel compare_corners_{queue_, "transform", "compare_corners"};
};

}  // namespace

std::unique_ptr<TransformStep> opencl_transform(const SharedContext& context, const TransformStep::Rest& rest) {
  return std::make_unique<OpenClTransform>(context, rest);
}

}  // namespace swage

// The transform step on a device.
#include <optional>
#include <utility>

#include "edge_table.h"
#include "kernel.h"
#include "lane_items.h"
#include "opencl_steps.h"
#include "round_triangles.h"
#include "sums.h"

namespace swage {
namespace {

using Eigen::Index;
using Rest = TransformStep::Rest;

/// Of each triangle's edges.
Positions initial_weights(const Rest& rest) {
  Eigen::VectorXd of_edges = rest.length_weights;
  if (of_edges.size() == 0) {
    const double squared = rest.mean_edge_length * rest.mean_edge_length;
    of_edges = (rest.edge_vectors.rowwise().squaredNorm() / squared).cwiseMax(1);  // Eq. 6
  }
  Positions weights(rest.triangles.rows(), 3);
  for (Index t = 0; t < weights.rows(); ++t) weights.row(t) = of_edges(rest.triangle_edges.row(t)).transpose();
  return weights;
}

/// Where a triangle has each edge's weight, in tiles.
Eigen::VectorXi weight_places(const EdgeTable& table) {
  return table.first_corners.unaryExpr(
      [](int corner) { return static_cast<int>(LaneItems::tile_place(corner / 3, corner % 3, 3)); });
}

/// As fit_edges reads it.
Eigen::Matrix<int, Eigen::Dynamic, 3> beside(const EdgeTable& table) {
  Eigen::Matrix<int, Eigen::Dynamic, 3> all(table.beside.rows(), 3);
  all << table.beside, weight_places(table);
  return all;
}

/// Rows of twelve, whose first nine are the inverses' to come.
Eigen::Matrix<double, Eigen::Dynamic, 12, Eigen::RowMajor> triangle_rows(const Positions& normals) {
  Eigen::Matrix<double, Eigen::Dynamic, 12, Eigen::RowMajor> rows(normals.rows(), 12);
  rows << Transforms::Zero(normals.rows(), 9), normals;
  return rows;
}

class OpenClTransform final : public TransformStep {
 public:
  OpenClTransform(const SharedContext& context, const Rest& rest)
      : OpenClTransform(Queue(context), rest, edge_table(rest), round_triangles(rest)) {}

  void reset() override { placed_ = false; }

  void fit_edges(const Transforms& transforms, EdgeQuadratics& quadratics) override {
    check_rows("TransformStep::fit_edges", "transforms", transforms.rows(), triangles_.count);
    quadratics.blocks.resize(edges_.count, 6);
    quadratics.right_hand_sides.resize(edges_.count, 3);
    quadratics.target_lengths.resize(edges_.count);
    const Visit visit(queue_, {&transforms_, &blocks_, &sides_, &targets_});
    transforms_.show(transforms);
    blocks_.lend(quadratics.blocks);
    sides_.lend(quadratics.right_hand_sides);
    targets_.lend(quadratics.target_lengths);
    invert_.launch(triangles_.items(), triangles_.count, maps_normals_, transforms_, triangle_rows_,
                   inverse_sums_.of_items());
    fit_edges_.launch(edges_.items(), edges_.count, weighs_targets_, constants_.mean_edge_length,
                      per_length(constants_.normal_weight), per_length(constants_.scale_weight), beside_, edge_rest_,
                      weights(), transforms_, triangle_rows_, target_weights_, blocks_, sides_, targets_,
                      edge_sums_.of_items());
    if (crowds_) launch_crowds();
    map_corners_.launch(round_.items(), round_.count, round_triangles_, corner_rest_, transforms_,
                        mapped_sums_.of_items());
    for (Sums* sums : {&inverse_sums_, &edge_sums_, &mapped_sums_}) sums->add_up();
    blocks_.take_back(quadratics.blocks);
    sides_.take_back(quadratics.right_hand_sides);
    targets_.take_back(quadratics.target_lengths);
    quadratics.singular = static_cast<int>(inverse_sums_.total()[0]);
    tell_energy_of_transforms();
  }

  Energy fit_transforms(const Positions& positions, Transforms& right_hand_sides) override {
    check_rows("TransformStep::fit_transforms", "positions", positions.rows(), vertices_);
    right_hand_sides.resize(triangles_.count, 9);
    const Visit visit(queue_, {&positions_, &right_hand_sides_});
    show(positions);
    right_hand_sides_.lend(right_hand_sides);
    fit_triangles_.launch(triangles_.items(), triangles_.count, weighs_targets_, constants_.regularizer_weight,
                          constants_.normal_regularizer_weight, constants_.mean_edge_length, triangle_corners_,
                          edges_of_triangles_, positions_, residues_, triangle_rows_, triangle_edges_, target_weights_,
                          weights(), next_weights_, right_hand_sides_, triangle_sums_.of_items());
    place_corners_.launch(round_.items(), round_.count, corners_, corner_rest_, positions_, residues_,
                          corner_sums_.of_items());
    for (Sums* sums : {&triangle_sums_, &corner_sums_}) sums->add_up();
    right_hand_sides_.take_back(right_hand_sides);
    std::swap(current_weights_, next_weights_);
    placed_ = true;
    return with_energy_of_positions();
  }

 private:
  OpenClTransform(const Queue& queue, const Rest& rest, const EdgeTable& table, const RoundTriangles& round)
      : queue_(queue),
        constants_{rest.mean_edge_length,
                   rest.normal_weight,
                   rest.connect_weight,
                   rest.scale_weight,
                   rest.regularizer_weight,
                   rest.normal_regularizer_weight,
                   rest.transform_sphericity_factor},
        maps_normals_(rest.maps_normals ? 1 : 0),
        weighs_targets_(rest.weighs_targets ? 1 : 0),
        vertices_(rest.vertices.rows()),
        triangles_{static_cast<int>(rest.triangles.rows()), queue.context->lanes("transform")},
        edges_{static_cast<int>(rest.edges.rows()), queue.context->lanes("transform")},
        round_{static_cast<int>(round.triangles.size()), queue.context->lanes("transform")},
        beside_(queue, edges_.tiles(beside(table))),
        triangle_corners_(queue, triangles_.tiles(rest.triangles)),
        edges_of_triangles_(queue, triangles_.tiles(rest.triangle_edges)),
        round_triangles_(queue, round_.tiles(round.triangles)),
        corners_(queue, round_.tiles(round.corners)),
        edge_rest_(queue, edges_.tiles(table.rest)),
        triangle_edges_(queue, triangles_.tiles(table.of_triangles)),
        corner_rest_(queue, round_.tiles(round.rest)),
        initial_weights_(queue, triangles_.tiles(initial_weights(rest))),
        current_weights_(queue, initial_weights_.size()),
        next_weights_(queue, initial_weights_.size()),
        target_weights_(queue, edges_.padded()),
        triangle_rows_(queue, 12 * triangles_.padded()),
        residues_(queue, needs_residues() ? rest.vertices.size() : 0),
        transforms_(queue, Index{9} * triangles_.count),
        blocks_(queue, Index{6} * edges_.count),
        sides_(queue, Index{3} * edges_.count),
        targets_(queue, edges_.count),
        positions_(queue, rest.vertices.size()),
        right_hand_sides_(queue, Index{9} * triangles_.count),
        inverse_sums_(queue, triangles_.items()),
        edge_sums_(queue, edges_.items()),
        mapped_sums_(queue, round_.items()),
        triangle_sums_(queue, triangles_.items()),
        corner_sums_(queue, round_.items()) {
    triangle_rows_.upload(triangle_rows(rest.normals), Layout::rows);
    if (!table.crowded.empty() || table.pairs.rows() != 0) crowds_.emplace(queue, table);
  }

  /// Where more than two triangles meet.
  struct Crowds {
    Crowds(const Queue& queue, const EdgeTable& table)
        : edges(queue, table.crowded),
          offsets(queue, table.offsets),
          triangles(queue, table.triangles),
          pairs(queue, table.pairs, Layout::rows),
          weight_places(queue, swage::weight_places(table)),
          pair_rest(queue, table.pair_rest, Layout::rows),
          edge_terms(queue, edges.size()),
          pair_terms(queue, pairs.size()),
          fit_crowded_edges(queue, queue.context->program_alone("transform"), "fit_crowded_edges"),
          compare_pairs(queue, queue.context->program_alone("transform"), "compare_pairs") {}

    Ints edges, offsets, triangles, pairs, weight_places;
    Reals pair_rest, edge_terms, pair_terms;
    Kernel fit_crowded_edges, compare_pairs;
  };

  void launch_crowds() {
    Crowds& c = *crowds_;
    c.fit_crowded_edges.launch(c.edges.size(), weighs_targets_, constants_.mean_edge_length,
                               per_length(constants_.normal_weight), per_length(constants_.scale_weight), c.edges,
                               c.offsets, c.triangles, edge_rest_, c.weight_places, weights(), transforms_,
                               triangle_rows_, target_weights_, blocks_, sides_, targets_, c.edge_terms);
    c.compare_pairs.launch(c.pairs.size() / 2, c.pairs, c.pair_rest, transforms_, c.pair_terms);
  }

  double per_length(double weight) const { return weight / constants_.mean_edge_length; }

  /// The weights that the positions now asked for are placed with.
  const Reals& weights() const { return placed_ ? current_weights_ : initial_weights_; }

  bool needs_residues() const {
    return queue_.context->precision() == Precision::single && !queue_.context->in_host_memory();
  }

  void show(const Positions& positions) {
    positions_.show(positions);
    if (!needs_residues()) return;
    residues_.upload(positions - positions.cast<float>().cast<double>(), Layout::rows);
  }

  /// The energy's terms that the transforms alone decide.
  void tell_energy_of_transforms() {
    Eigen::Vector3d edges = edge_sums_.total();
    if (crowds_) {
      Eigen::VectorXd terms(crowds_->edge_terms.size());
      Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> pairs(crowds_->pairs.size() / 2, 2);
      crowds_->edge_terms.download(terms);
      crowds_->pair_terms.download(pairs, Layout::rows);
      edges += Eigen::Vector3d(terms.sum(), pairs.col(0).sum(), pairs.col(1).sum());
    }
    energy_ = {};
    energy_.regularizer = constants_.regularizer_weight * inverse_sums_.total()[1] +
                          constants_.normal_regularizer_weight * inverse_sums_.total()[2];
    energy_.transform_normal = edges[0];
    energy_.connect = constants_.connect_weight * edges[1];
    energy_.similarity = edges[2];
    energy_.transform_sphericity = constants_.transform_sphericity_factor * mapped_sums_.total()[0];
  }

  Energy with_energy_of_positions() const {
    const Eigen::Vector3d triangles = triangle_sums_.total();
    Energy energy = energy_;
    energy.transform = triangles[0];
    energy.normal = constants_.normal_weight * triangles[1];
    energy.scale = per_length(constants_.scale_weight) * triangles[2];
    energy.sphericity = corner_sums_.total()[0];
    return energy;
  }

  struct Constants {
    double mean_edge_length, normal_weight, connect_weight, scale_weight, regularizer_weight, normal_regularizer_weight,
        transform_sphericity_factor;
  };

  Queue queue_;
  Constants constants_;
  int maps_normals_, weighs_targets_;
  Index vertices_;
  LaneItems triangles_, edges_, round_;
  Energy energy_;

  // The rest shape.
  Ints beside_, triangle_corners_, edges_of_triangles_, round_triangles_, corners_;
  Reals edge_rest_, triangle_edges_, corner_rest_;
  std::optional<Crowds> crowds_;

  Reals initial_weights_, current_weights_, next_weights_, target_weights_;
  bool placed_ = false;             // Whether current_weights_ stand in for the initial.
  Reals triangle_rows_, residues_;  // Of triangles, inverse and normal in a row.
  HostRows transforms_, blocks_, sides_, targets_, positions_, right_hand_sides_;
  Sums inverse_sums_, edge_sums_, mapped_sums_, triangle_sums_, corner_sums_;

  Kernel invert_{queue_, "transform", "invert"};
  Kernel fit_edges_{queue_, "transform", "fit_edges"};
  Kernel map_corners_{queue_, "transform", "map_corners"};
  Kernel fit_triangles_{queue_, "transform", "fit_triangles"};
  Kernel place_corners_{queue_, "transform", "place_corners"};
};

}  // namespace

std::unique_ptr<TransformStep> opencl_transform(const SharedContext& context, const TransformStep::Rest& rest) {
  return std::make_unique<OpenClTransform>(context, rest);
}

}  // namespace swage

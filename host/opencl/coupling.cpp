// The transform step's matrix as a product, on a device.
#include <map>
#include <vector>

#include "kernel.h"
#include "opencl_steps.h"
#include "round_triangles.h"

namespace swage {
namespace {

using Eigen::Index;
using Rest = TransformStep::Rest;
using Row6 = Eigen::Matrix<double, 1, 6>;

Row6 upper(const Eigen::Matrix3d& symmetric) {
  Row6 entries;
  entries << symmetric.row(0), symmetric.row(1).tail<2>(), symmetric(2, 2);
  return entries;
}

/// What the two triangles of a pair share: the directions in which they are to do the same.
Row6 share(const Rest& rest, Index pair) {
  const Eigen::RowVector3d direction = rest.edge_vectors.row(rest.pair_edges[pair]).normalized();
  const Eigen::RowVector3d opposite = rest.pair_opposites.row(pair);
  return upper(rest.connect_weight * direction.transpose() * direction +
               rest.pair_similarities[pair] * opposite.transpose() * opposite);
}

/// A triangle's neighbour with what they share.
struct Neighbour {
  int triangle;
  Index pair;
};

/// Each triangle's first three neighbours, and the few triangles with more, with the rest of theirs.
struct Table {
  Eigen::Matrix<int, Eigen::Dynamic, 3> neighbours;
  Eigen::Matrix<double, Eigen::Dynamic, 36> rest;  // As couple reads it.
  Eigen::VectorXi crowded, offsets, crowd;
  Eigen::Matrix<double, Eigen::Dynamic, 8> crowd_shares;
};

void fill_own(const Rest& rest, Table& table) {
  for (Index t = 0; t < rest.triangles.rows(); ++t) {
    Eigen::Matrix3d vectors = Eigen::Matrix3d::Zero(), directions = vectors;
    for (const int e : rest.triangle_edges.row(t)) {
      const Eigen::RowVector3d vector = rest.edge_vectors.row(e), direction = vector.normalized();
      vectors += vector.transpose() * vector / rest.mean_edge_length;
      directions += direction.transpose() * direction;
    }
    vectors += rest.normal_regularizer_weight * rest.normals.row(t).transpose() * rest.normals.row(t);
    table.rest.row(t) << upper(vectors), upper(directions), rest.normals.row(t), Eigen::Matrix<double, 1, 21>::Zero();
  }
}

/// Gives the neighbours that found no place among the first three of their triangle.
std::map<int, std::vector<Neighbour>> fill_neighbours(const Rest& rest, Table& table) {
  std::map<int, std::vector<Neighbour>> more;
  std::vector<int> places(static_cast<size_t>(rest.triangles.rows()), 0);
  for (Index t = 0; t < rest.triangles.rows(); ++t) table.neighbours.row(t).setConstant(static_cast<int>(t));
  for (Index p = 0; p < rest.pairs.rows(); ++p) {
    const Row6 shared = share(rest, p);
    for (int k = 0; k < 2; ++k) {
      const int t = rest.pairs(p, k), other = rest.pairs(p, 1 - k);
      int& place = places[static_cast<size_t>(t)];
      if (place == 3) {
        more[t].push_back({other, p});
        continue;
      }
      table.neighbours(t, place) = other;
      table.rest.row(t).segment<6>(15 + 6 * place) = shared;
      ++place;
    }
  }
  return more;
}

void fill_crowds(const Rest& rest, const std::map<int, std::vector<Neighbour>>& more, Table& table) {
  Index count = 0, i = 0, k = 0;
  for (const auto& [t, neighbours] : more) count += static_cast<Index>(neighbours.size());
  table.crowded.resize(static_cast<Index>(more.size()));
  table.offsets.setZero(table.crowded.size() + 1);
  table.crowd.resize(count);
  table.crowd_shares.setZero(count, 8);
  for (const auto& [t, neighbours] : more) {
    for (const Neighbour& neighbour : neighbours) {
      table.crowd[k] = neighbour.triangle;
      table.crowd_shares.row(k++).head<6>() = share(rest, neighbour.pair);
    }
    table.crowded[i++] = t;
    table.offsets[i] = static_cast<int>(k);
  }
}

Table table_of(const Rest& rest) {
  Table table;
  table.neighbours.resize(rest.triangles.rows(), 3);
  table.rest.resize(rest.triangles.rows(), 36);
  fill_own(rest, table);
  fill_crowds(rest, fill_neighbours(rest, table), table);
  return table;
}

/// As couple_corners reads it.
Eigen::MatrixXd corner_rest(const Rest& rest, const RoundTriangles& round) {
  Eigen::MatrixXd corners = round.rest.leftCols<RoundTriangles::kOfDirections>();
  corners.rightCols<1>() *= rest.transform_sphericity_factor;
  return corners;
}

class OpenClCoupling final : public CouplingStep {
 public:
  OpenClCoupling(const SharedContext& context, const Rest& rest)
      : OpenClCoupling(Queue(context), rest, table_of(rest), round_triangles(rest)) {}

  void apply(const Transforms& transforms, Transforms& product) override {
    check_rows("CouplingStep::apply", "transforms", transforms.rows(), triangles_);
    product.resize(triangles_, 9);
    const Visit visit(queue_, {&transforms_, &products_});
    transforms_.show(transforms);
    products_.lend(product);
    couple_.launch(triangles_, normal_weight_, regularizer_weight_, neighbours_, rest_, transforms_, products_);
    couple_crowded_.launch(crowded_, crowded_triangles_, offsets_, crowd_, crowd_shares_, transforms_, products_);
    couple_corners_.launch(round_, round_triangles_, corner_rest_, transforms_, products_);
    products_.take_back(product);
  }

 private:
  OpenClCoupling(const Queue& queue, const Rest& rest, const Table& table, const RoundTriangles& round)
      : queue_(queue),
        normal_weight_(rest.transform_normal_weight),
        regularizer_weight_(rest.regularizer_weight),
        triangles_(static_cast<int>(rest.triangles.rows())),
        crowded_(static_cast<int>(table.crowded.size())),
        round_(static_cast<int>(round.triangles.size())),
        neighbours_(queue, table.neighbours, Layout::rows),
        crowded_triangles_(queue, table.crowded),
        offsets_(queue, table.offsets),
        crowd_(queue, table.crowd),
        round_triangles_(queue, round.triangles),
        rest_(queue, table.rest, Layout::rows),
        crowd_shares_(queue, table.crowd_shares, Layout::rows),
        corner_rest_(queue, corner_rest(rest, round)),
        transforms_(queue, Index{triangles_} * 9),
        products_(queue, Index{triangles_} * 9) {}

  Queue queue_;
  double normal_weight_, regularizer_weight_;
  int triangles_, crowded_, round_;
  Ints neighbours_, crowded_triangles_, offsets_, crowd_, round_triangles_;
  Reals rest_, crowd_shares_, corner_rest_;
  HostRows transforms_, products_;
  Kernel couple_{queue_, "coupling", "couple"};
  Kernel couple_crowded_{queue_, "coupling", "couple_crowded"};
  Kernel couple_corners_{queue_, "coupling", "couple_corners"};
};

}  // namespace

std::unique_ptr<CouplingStep> opencl_coupling(const SharedContext& context, const TransformStep::Rest& rest) {
  return std::make_unique<OpenClCoupling>(context, rest);
}

}  // namespace swage

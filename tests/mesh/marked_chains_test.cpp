// The straight chains that the authors marked on their models, and those found.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <string>

#include "chains.h"
#include "places.h"
#include "swage/features.h"
#include "swage/handles.h"

namespace swage {
namespace {

using test::Chains;
using test::edges_in;

struct Marked {
  const char* model;
  double recall, precision;  ///< Of edges, at least.
};

/// Two of some twenty straight edges of the cutlery's are marked.
class MarkedChains : public testing::TestWithParam<Marked> {};

std::set<int> interior(const Chains& chains) {
  std::set<int> vertices;
  for (const auto& chain : chains) vertices.insert(chain.begin() + 1, chain.end() - 1);
  return vertices;
}

template <typename Set>
std::pair<double, double> recall_and_precision(const Set& found, const Set& marked) {
  const auto common = static_cast<double>(
      std::count_if(found.begin(), found.end(), [&](const auto& thing) { return marked.contains(thing); }));
  return {common / static_cast<double>(marked.size()), common / static_cast<double>(found.size())};
}

TEST_P(MarkedChains, AreFoundOnTheAuthorsModels) {
  if (!test::has_shared()) GTEST_SKIP() << "the authors' models are not here";
  const std::string name = GetParam().model;
  const Mesh mesh = read_mesh(test::shared("data/meshes/A_closed_manifold") / (name + ".obj")).mesh;
  const auto count = static_cast<int>(mesh.positions.rows());
  const Chains marked = read_straight_chains(test::shared("data/meshes/gestures") / (name + ".straight"), count);
  EXPECT_EQ(read_straight_chains(test::shared("oracle/reshape") / name / (name + ".straight"), count), marked);
  const Chains found = straight_chains(mesh.positions, mesh.triangles);
  const auto [recall, precision] = recall_and_precision(edges_in(found), edges_in(marked));
  const auto [vertex_recall, vertex_precision] = recall_and_precision(interior(found), interior(marked));
  std::cout << name << ": chains marked " << marked.size() << ", found " << found.size() << "; edges: recall " << recall
            << ", precision " << precision << "; interior vertices: recall " << vertex_recall << ", precision "
            << vertex_precision << "\n";
  RecordProperty("recall", std::to_string(recall));
  RecordProperty("precision", std::to_string(precision));
  EXPECT_GE(recall, GetParam().recall);
  EXPECT_GE(precision, GetParam().precision);
  EXPECT_GE(vertex_recall, GetParam().recall - 0.03);
  EXPECT_GE(vertex_precision, GetParam().precision - 0.03);
}

INSTANTIATE_TEST_SUITE_P(Authors, MarkedChains,
                         testing::Values(Marked{"cutlery_s26-1", 0.75, 0.12}, Marked{"e_car_extruded", 0.9, 0.83},
                                         Marked{"espresso", 1, 0.82}, Marked{"m0839_sofa", 0.99, 0.8}),
                         [](const auto& named) {
                           std::string name = named.param.model;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace swage

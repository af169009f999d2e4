// The authors' algorithm on their own shapes and styles, with its rotations in double precision.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "measures.h"
#include "places.h"
#include "swage/mesh_io.h"
#include "swage/stylize.h"

namespace swage {
namespace {

const std::filesystem::path kFolder = "oracle/stylize";

struct PublishedResult {
  const char* name;  // Of its files.
  const char* shape;
  const char* style;  // A file, or "" for developable.
  StylizeEnergy energy;
  double lambda;
};

void PrintTo(const PublishedResult& expected, std::ostream* out) { *out << expected.name; }

using enum StylizeEnergy;
const PublishedResult kResults[] = {
    {"primDBL__spot__cube__lam1", "spot", "cube", arap, 1},
    {"primDBL__spot__cube__lam10", "spot", "cube", arap, 10},
    {"primDBL__fandisk__octahedron__lam1", "fandisk", "octahedron", arap, 1},
    {"primFARAPDBL__spot__cube__lam1", "spot", "cube", farap, 1},
    {"primACAPDBL__spot__cube__lam1", "spot", "cube", acap, 1},
    {"gaussDBL__fandisk__rcube__lam1", "fandisk", "rcube", arap, 1},
    {"gaussDBL__spot__oloid__lam1", "spot", "oloid", arap, 1},
    {"devDBL__spot__thrScaled6.15e-05__lam1000", "spot", "", farap, 1000},
};

Mesh read(const std::filesystem::path& inside) {
  const MeshFile file = read_mesh(test::shared((kFolder / inside).string()));
  return file.mesh;
}

Style style_of(const PublishedResult& expected) {
  const std::string name = expected.style;
  if (name.empty()) return Developable{0, 6.15e-5};
  const Mesh style = read("styles/" + name + ".obj");
  if (std::string(expected.name).starts_with("gauss")) return sphere_map(style, true);
  return closest_normals(style);
}

/// Passes that the authors' program made before it stopped, or 350.
int published_passes(const PublishedResult& expected) {
  std::ifstream file(test::shared((kFolder / expected.name).string() + ".csv"));
  std::string line, last;
  while (std::getline(file, line)) last = line;
  return std::stoi(last.substr(last.find('=') + 1));
}

class StylizeReference : public testing::TestWithParam<PublishedResult> {
 protected:
  void SetUp() override {
    if (!test::has_shared()) GTEST_SKIP() << "the reference results are not here";
    shape_ = read("inputs/" + std::string(GetParam().shape) + ".obj");
    options_.energy = GetParam().energy;
    options_.scale = AcapScale::paper;
  }

  StylizeResult solved(int pass_limit) {
    options_.pass_limit = pass_limit;
    return stylize(shape_.positions, shape_.triangles, style_of(GetParam()), GetParam().lambda, options_);
  }

  /// Largest distance of a vertex, in diagonals.
  double off(const StylizeResult& result, const std::string& suffix) const {
    const Mesh published = read(std::string(GetParam().name) + "__it" + suffix + ".obj");
    return (result.positions - published.positions).rowwise().norm().maxCoeff() / box_diagonal(shape_.positions);
  }

  Mesh shape_;
  StylizeOptions options_;
};

TEST_P(StylizeReference, IsThePublishedAfterAFewPasses) {
  EXPECT_LT(off(solved(1), "1"), 1e-10);
  EXPECT_LT(off(solved(10), "10"), 1e-7);
}

/// Those that come with an end: of developable ones creases are not found twice alike.
class StylizeReferenceEnd : public StylizeReference {};

TEST_P(StylizeReferenceEnd, IsThePublished) {
  const StylizeResult result = solved(350);
  EXPECT_LT(off(result, "conv"), 1e-4);
  EXPECT_NEAR(result.report.passes, published_passes(GetParam()), 1);
}

/// Unit or zero: of vertices, or of triangles where the energy is theirs.
Positions normals_of(const Mesh& shape, const Positions& positions, StylizeEnergy energy) {
  Positions normals = area_vectors(positions, shape.triangles);
  if (energy == farap) return normals.rowwise().normalized();
  Positions sums = Positions::Zero(positions.rows(), 3);
  for (Eigen::Index t = 0; t < normals.rows(); ++t) {
    for (const int v : shape.triangles.row(t)) sums.row(v) += normals.row(t);
  }
  return sums.rowwise().normalized();
}

/// Of each row the nearest direction's target.
Positions targets_of(const Positions& normals, const Positions& directions, const Positions& targets) {
  Positions result = normals;
  for (auto row : result.rowwise()) {
    Eigen::Index nearest = 0;
    (directions * row.transpose()).maxCoeff(&nearest);
    row = targets.row(nearest);
  }
  return result;
}

/// Of closest normals the targets of the positions, of sphere maps those of the rest shape.
double mean_angle(const Mesh& shape, const Positions& positions, const Style& style, StylizeEnergy energy) {
  const Positions normals = normals_of(shape, positions, energy);
  Positions targets;
  if (const auto* closest = std::get_if<ClosestNormals>(&style)) {
    targets = targets_of(normals, closest->normals, closest->normals);
  } else {
    const auto& map = std::get<SphereMap>(style);
    targets = targets_of(normals_of(shape, shape.positions, energy), map.directions, map.normals);
  }
  return normals.cwiseProduct(targets).rowwise().sum().array().min(1.0).acos().mean();
}

TEST_P(StylizeReferenceEnd, NearsItsTargetsByThePublishedFactor) {
  const Style style = style_of(GetParam());
  const auto angle = [&](const Positions& positions) {
    return mean_angle(shape_, positions, style, GetParam().energy);
  };
  const double published =
      angle(read(std::string(GetParam().name) + "__itconv.obj").positions) / angle(shape_.positions);
  const double here = angle(solved(350).positions) / angle(shape_.positions);
  EXPECT_LT(published, 0.9);
  EXPECT_NEAR(here, published, 0.01 * published);
}

std::string test_name(const testing::TestParamInfo<PublishedResult>& instance) {
  std::string name = instance.param.name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Authors, StylizeReference, testing::ValuesIn(kResults), test_name);
INSTANTIATE_TEST_SUITE_P(Authors, StylizeReferenceEnd, testing::ValuesIn(kResults, kResults + 7), test_name);

TEST(SphereMap, FlowsAsThePublished) {
  if (!test::has_shared()) GTEST_SKIP() << "the reference results are not here";
  for (const std::string name : {"rcube", "oloid"}) {
    const Positions published = read("styles/mcf__" + name + ".obj").positions;
    const Positions directions = sphere_map(read("styles/" + name + ".obj")).directions;
    EXPECT_LT((directions - published.rowwise().normalized()).rowwise().norm().maxCoeff(), 1e-4) << name;
  }
}

}  // namespace
}  // namespace swage

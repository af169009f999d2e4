#include <gmock/gmock.h>

#include <sstream>

#include "places.h"
#include "swage/error.h"
#include "swage/scaffold.h"

namespace swage {
namespace {

const Positions kPoints{{0, 0, 0}, {1, 0, 0}, {0, 1. / 3, 0}, {0, 0, 1e-7}, {1, 1, -1}};
const Tetrahedra kTetrahedra{{0, 1, 2, 3}, {4, 2, 1, 0}};

/// The words of a text, after those up to `until`.
std::istringstream after(const std::string& text, const std::string& until) {
  const size_t at = text.find(until);
  EXPECT_NE(at, std::string::npos) << until;
  return std::istringstream(text.substr(at + until.size()));
}

std::vector<double> numbers(std::istringstream stream, size_t count) {
  std::vector<double> values(count);
  for (double& value : values) {
    std::string word;
    stream >> word;
    value = std::stod(word);
  }
  return values;
}

std::string written(const std::string& name) {
  const test::TempFolder folder;
  write_tetrahedra(folder / name, kPoints, kTetrahedra);
  return test::read_text(folder / name);
}

TEST(WriteTetrahedra, Medit) {
  const std::string text = written("a.mesh");
  EXPECT_TRUE(text.starts_with("MeshVersionFormatted 2\nDimension 3\n"));
  EXPECT_TRUE(text.ends_with("\nEnd\n"));
  const std::vector<double> points = numbers(after(text, "\nVertices\n5\n"), 20);
  for (int v = 0; v < 5; ++v) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(points[static_cast<size_t>(4 * v + k)], kPoints(v, k));
  }
  EXPECT_EQ(numbers(after(text, "\nTetrahedra\n2\n"), 10), (std::vector<double>{1, 2, 3, 4, 0, 5, 3, 2, 1, 0}));
}

TEST(WriteTetrahedra, Vtk) {
  const std::string text = written("a.VTK");
  EXPECT_TRUE(text.starts_with("# vtk DataFile Version 3.0\n"));
  const std::vector<double> points = numbers(after(text, "\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n"), 15);
  EXPECT_EQ(points, std::vector<double>(kPoints.data(), kPoints.data() + 15));
  EXPECT_EQ(numbers(after(text, "\nCELLS 2 10\n"), 10), (std::vector<double>{4, 0, 1, 2, 3, 4, 4, 2, 1, 0}));
  EXPECT_EQ(numbers(after(text, "\nCELL_TYPES 2\n"), 2), (std::vector<double>{10, 10}));
}

TEST(WriteTetrahedra, RefusesOtherNamesIndicesAndPlaces) {
  const test::TempFolder folder;
  EXPECT_THROW(write_tetrahedra(folder / "a.obj", kPoints, kTetrahedra), InvalidInput);
  EXPECT_THROW(write_tetrahedra(folder / "a.mesh", kPoints.topRows(4), kTetrahedra), InvalidInput);
  EXPECT_THROW(write_tetrahedra(folder / "none/a.mesh", kPoints, kTetrahedra), UnwritableFile);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace swage

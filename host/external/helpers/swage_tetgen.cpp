// Constrained Delaunay tetrahedralisation by TetGen (AGPL-3.0-or-later), under whose licence this program is.
//
// In: points (3 doubles each), triangles (3 ints), quadrilaterals (4 ints), whether for quality (1 int).
// Out: points, the given ones first; tetrahedra (4 ints); the numbers of triangles that cross or overlap others, in
// which case there is nothing else.
#include <algorithm>
#include <array>
#include <set>

#define TETLIBRARY
// TetGen frees its mesh twice on the way out of an error: its own way out gives way to the one below.
#define terminatetetgen tetgen_own_terminatetetgen
#include <tetgen.h>
#undef terminatetetgen

#include "serve.h"
#include "wire.h"

__attribute__((visibility("default"))) void terminatetetgen(tetgenmesh*, int code) { throw code; }

namespace swage {
namespace {

void add_facet(tetgenio::facet& facet, const std::int32_t* corners, int count) {
  tetgenio::init(&facet);
  facet.numberofpolygons = 1;
  facet.polygonlist = new tetgenio::polygon[1];
  facet.polygonlist->numberofvertices = count;
  facet.polygonlist->vertexlist = new int[static_cast<size_t>(count)];
  std::copy_n(corners, count, facet.polygonlist->vertexlist);
}

/// What is filled, as the message has it.
struct Complex {
  std::vector<double> points;
  std::vector<std::int32_t> triangles, quadrilaterals;
};

void fill(tetgenio& surface, const Complex& complex) {
  surface.numberofpoints = static_cast<int>(complex.points.size() / 3);
  surface.pointlist = new double[complex.points.size()];
  std::copy(complex.points.begin(), complex.points.end(), surface.pointlist);
  const size_t count = complex.triangles.size() / 3 + complex.quadrilaterals.size() / 4;
  surface.facetlist = new tetgenio::facet[count];
  tetgenio::facet* facet = surface.facetlist;
  for (size_t i = 0; i < complex.triangles.size(); i += 3) add_facet(*facet++, &complex.triangles[i], 3);
  for (size_t i = 0; i < complex.quadrilaterals.size(); i += 4) add_facet(*facet++, &complex.quadrilaterals[i], 4);
  surface.numberoffacets = static_cast<int>(count);
}

constexpr int kCrossing = 3;

std::runtime_error failure(int code) {
  if (code == 1) throw std::bad_alloc();
  if (code == kCrossing) return std::runtime_error("triangles cross or overlap others");
  if (code == 4 || code == 5) return std::runtime_error("triangles are too close to each other to be told apart");
  return std::runtime_error("TetGen fails with code " + std::to_string(code));
}

/// Returns TetGen's code, 0 where all went well.
int run(std::string switches, const Complex& complex, tetgenio& result) {
  tetgenio surface;
  fill(surface, complex);
  try {
    tetrahedralize(switches.data(), &surface, &result);
  } catch (int code) {
    return code;
  }
  return 0;
}

std::array<int, 3> sorted(const int* corners) {
  std::array<int, 3> result{corners[0], corners[1], corners[2]};
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::int32_t> crossing_triangles(const Complex& complex) {
  tetgenio found;
  if (const int code = run("pdQJMT1e-12", complex, found); code != 0) throw failure(code);
  std::set<std::array<int, 3>> crossing;
  for (int i = 0; i < found.numberoftrifaces; ++i) crossing.insert(sorted(found.trifacelist + 3 * i));
  std::vector<std::int32_t> numbers;
  for (size_t i = 0; i < complex.triangles.size(); i += 3) {
    if (crossing.contains(sorted(&complex.triangles[i]))) numbers.push_back(static_cast<std::int32_t>(i / 3));
  }
  if (numbers.empty()) throw failure(kCrossing);
  return numbers;
}

/// p: the surface is to be among the faces; Y: no Steiner points on it; J: unused points stay, so that none is
/// renumbered; M: nothing that nearly coincides is merged, which would lose triangles; T: nor taken for coinciding;
/// q1.4: circumradii up to 1.4 times the shortest edge where points inside can do it.
const char* switches(bool quality) { return quality ? "pq1.4YQJMT1e-12" : "pYQJMT1e-12"; }

std::string tetrahedra_of(std::string_view message) {
  wire::Reader reader(message);
  Complex complex;
  complex.points = reader.read<double>(3);
  complex.triangles = reader.read<std::int32_t>(3);
  complex.quadrilaterals = reader.read<std::int32_t>(4);
  const auto quality = reader.read<std::int32_t>();
  reader.finish();

  tetgenio volume;
  const int code = run(switches(quality.at(0) != 0), complex, volume);
  std::vector<std::int32_t> crossing;
  if (code == kCrossing) crossing = crossing_triangles(complex);
  if (code != 0 && code != kCrossing) throw failure(code);
  return wire::Writer()
      .add(volume.pointlist, 3 * static_cast<size_t>(volume.numberofpoints))
      .add(volume.tetrahedronlist, 4 * static_cast<size_t>(volume.numberoftetrahedra))
      .add(crossing)
      .take();
}

}  // namespace
}  // namespace swage

int main() { return swage::serve(swage::tetrahedra_of); }

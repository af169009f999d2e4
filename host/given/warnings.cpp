#include "warnings.h"

#include <sstream>
#include <string>

#include "measures.h"

namespace swage {

void warn_of_shape(const SurfaceFacts& facts, Report& report) {
  const auto warn = [&](int count, const char* one, const char* many, const char* what) {
    if (count == 0) return;
    report.warnings.push_back(std::to_string(count) + " " + (count == 1 ? one : many) + ": " + what);
  };
  const SurfaceCounts& counts = facts.counts;
  warn(counts.merged, "vertex is at another's place", "vertices are at others' places",
       "what is at one place stays so");
  warn(counts.loose, "vertex has no triangle", "vertices have no triangle", "carried by the nearest surface");
  warn(counts.repeated, "triangle repeats another", "triangles repeat others", "left out of the solve");
  warn(counts.collapsed, "triangle has two corners at one place", "triangles have two corners at one place",
       "left out of the solve");
  warn(counts.turned, "triangle winds against its neighbours", "triangles wind against their neighbours",
       "turned for the solve");
  warn(facts.flat_triangles, "triangle has no area", "triangles have no area", "they go with their neighbours");
  const Lists& triangles = facts.edges.triangles;
  int open = 0, crowded = 0;
  for (int e = 0; e < triangles.size(); ++e) {
    open += triangles[e].size() == 1 ? 1 : 0;
    crowded += triangles[e].size() > 2 ? 1 : 0;
  }
  warn(open, "edge has one triangle", "edges have one triangle", "the surface ends there");
  warn(crowded, "edge has more than two triangles", "edges have more than two triangles",
       "each two of them are neighbours");
  warn(facts.components == 1 ? 0 : facts.components, "", "components that no triangle joins",
       "held together where they touch or cross, else joined");
}

void warn_of_misses(const Mesh& mesh, const Gesture& gesture, const Positions& positions, const char* why,
                    Report& report) {
  constexpr double kFar = 0.01;
  const double diagonal = box_diagonal(mesh.positions);
  int count = 0, worst = -1;
  double most = kFar * diagonal;
  for (const auto& [vertex, target] : gesture.targets) {
    const double miss = (positions.row(vertex).transpose() - target).norm();
    if (miss > kFar * diagonal) ++count;
    if (miss > most) {
      most = miss;
      worst = vertex;
    }
  }
  if (count == 0) return;
  std::ostringstream words;
  words.precision(3);
  words << count << (count == 1 ? " handle" : " handles") << " missed by more than 1 % of the box's diagonal, vertex "
        << worst << " by " << 100 * most / diagonal << " %: " << why;
  report.warnings.push_back(words.str());
}

}  // namespace swage

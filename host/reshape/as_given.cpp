#include "as_given.h"

namespace swage {
namespace {

ReshapedScaffold back(const Given& given, const ReshapedScaffold& solved, const Positions& positions) {
  const Eigen::Index own = solved.positions.rows() - static_cast<Eigen::Index>(given.vertices().size());
  ReshapedScaffold result{Positions(positions.rows() + own, 3), given.back(solved.tetrahedra)};
  result.positions << positions, solved.positions.bottomRows(own);
  return result;
}

}  // namespace

ReshapeOptions into(const Given& given, ReshapeOptions options) {
  if (options.unit_box_curvatures) {
    options.unit_box_curvatures = Curvatures((*options.unit_box_curvatures)(given.triangles(), Eigen::all));
  }
  for (std::vector<int>& chain : options.straight_chains) chain = given.into(chain);
  return options;
}

ReshapeResult into(const Given& given, const ReshapeResult& start) {
  ReshapeResult result;
  result.unfinished = start.unfinished(given.vertices(), Eigen::all);
  result.transforms = start.transforms(given.triangles(), Eigen::all);
  return result;
}

ReshapeResult back(const Given& given, const ReshapeResult& solved) {
  ReshapeResult result = solved;
  result.positions = given.back(solved.positions, solved.transforms);
  result.unfinished = given.back(solved.unfinished, solved.transforms);
  if (solved.scaffold) result.scaffold = back(given, *solved.scaffold, result.positions);
  result.transforms = given.back(solved.transforms);
  return result;
}

}  // namespace swage

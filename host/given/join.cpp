#include "join.h"

#include <algorithm>
#include <utility>

#include "links.h"
#include "scaffold_ties.h"

namespace swage {

Joined join_components(const Mesh& unit_mesh, const Edges& edges, When scaffold, const Poll& poll) {
  Joined joined;
  const std::vector<int> component = components(unit_mesh.triangles, static_cast<int>(unit_mesh.positions.rows()));
  const int count = 1 + *std::max_element(component.begin(), component.end());
  if (count == 1) return joined;
  Links links = contacts(unit_mesh, edges, poll);
  joined.told = std::to_string(count) + " components, " + std::to_string(links.contacts) + " contacts; ";
  std::string why_not;
  if (std::optional<ScaffoldTies> found =
          scaffold_ties(scaffold, unit_mesh, component, links.contacts, poll, why_not)) {
    joined.told += "scaffold of " + std::to_string(found->scaffold.tetrahedra.rows()) + " tetrahedra";
    joined.scaffold = std::move(found->scaffold);
    links.ties.insert(links.ties.end(), found->ties.begin(), found->ties.end());
  } else {
    add_links(unit_mesh, poll, links);
    joined.told += std::to_string(links.ties.size() - static_cast<size_t>(links.contacts)) +
                   " links between nearest points, no scaffold: " + why_not;
  }
  joined.ties = std::move(links.ties);
  return joined;
}

}  // namespace swage

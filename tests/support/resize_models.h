// Models to resize, of our own making: as many faces and components as those of the paper's table 1, in boxes of the
// same proportions, y upwards. Parts are closed and touch or run into each other, as in CAD.
//
// Kraevoy, Sheffer, Shamir, Cohen-Or: Non-Homogeneous Resizing of Complex Models. SIGGRAPH Asia 2008.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "solids.h"

namespace swage::test {

// `detail`: steps along curves, as many times as at 1. A unit is about a cell of the paper's grid.

/// An open two-seater along x, on wheels about z.
Assembled car(double detail = 1);
/// A longcase clock, its dial and pendulum in the xy plane.
Assembled clock_of_parts(double detail = 1);
/// A pedestal fan, its cage about z.
Assembled fan(double detail = 1);
/// A tank about x on feet, with domed caps, straps and round hatches above.
Assembled tank(double detail = 1);
/// A paper lantern about y, with a rim below and above.
Assembled lantern(double detail = 1);
Assembled candelabrum(double detail = 1);
Assembled phone(double detail = 1);
Assembled church(double detail = 1);
Assembled camera(double detail = 1);
/// An adjustable one, its jaws at the end of x.
Assembled wrench(double detail = 1);
/// Three basins among a crowd.
Assembled fountain(double detail = 1);

/// A line of table 1.
struct TableLine {
  std::string name;
  Assembled (*make)(double detail);
  double detail;          ///< At which it has about that many faces.
  int faces, components;  ///< As the paper says.
  std::array<int, 3> cells;
  Eigen::RowVector3d factors;
  double first_seconds, run_seconds;  ///< The paper's, on a Pentium 4.
};
const std::vector<TableLine>& table_1();

/// A plate 60 × 3 × 40 with a bolt hole of radius 3 near each corner, 40 × 20 apart; `ribs`: two along x and two
/// across.
Assembled bolted_plate(bool ribs = false, double detail = 1);
/// Boxes aligned to the axes, touching, one upon the other.
Assembled boxes();

}  // namespace swage::test

// How a solve is followed, stopped and told about afterwards.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#pragma GCC visibility push(default)
namespace swage {

struct Progress {
  const char* stage = "";  ///< What is being done, such as "factor" or "pass".
  int pass = 0;            ///< Passes completed.
  int pass_limit = 0;
  double fraction = 0;  ///< Of the whole call, in [0, 1], never falling.
  double energy = 0;    ///< After the last pass; 0 before the first.
};

/// Called between stages and passes, and every few tenths of a second within long ones (at a million triangles about
/// every second on two cores), from the calling thread. Not while a matrix is factored: 4 seconds at 84,000 triangles;
/// by default much larger meshes are solved without a factor.
/// Returning false cancels: the call ends with the last complete iterate.
using ProgressFn = std::function<bool(const Progress&)>;

/// Why a solve ended. The positions returned are the last complete pass's, but for `energy_rose` the one's before.
enum class Termination {
  moved_little,    ///< No vertex moved farther than StopRule::movement in the last pass.
  energy_rose,     ///< The energy rose or stood still: the pass before is returned.
  energy_settled,  ///< The energy fell by less than StopRule::energy_drop.
  pass_limit,      ///< StopRule::pass_limit passes were made.
  cancelled,       ///< The progress function returned false.
};

/// "moved", "energy rose", "energy settled", "pass limit", "cancelled".
const char* to_string(Termination termination);

struct StopRule {
  int pass_limit = 100;    ///< At least 1.
  int first_test = 3;      ///< The pass, counted from 1, after which tests begin.
  double movement = 0;     ///< Largest vertex movement in a pass that counts as standing still, solver units.
  bool by_energy = true;   ///< Whether an energy that rises or settles ends the passes.
  double energy_drop = 0;  ///< Smallest fall of the energy in a pass that counts as progress.
};

struct Report {
  Termination stop = Termination::pass_limit;
  int passes = 0;                                ///< Vertex steps made.
  int best_pass = 0;                             ///< The pass returned, from 0.
  double energy = 0;                             ///< Of the pass returned.
  std::map<std::string, double> energy_by_term;  ///< Its parts, weighted.
  std::vector<double> energies;                  ///< After each pass.
  std::vector<double> movements;  ///< How far each pass moved a vertex at most from where it started, solver units.
  std::map<std::string, double> seconds;     ///< Wall time by stage; the whole solve and the preparation before.
  std::map<std::string, std::size_t> bytes;  ///< Memory by part, after the last pass; the largest parts.
  std::map<std::string, std::string> paths;  ///< Of several ways to do something the one taken, and why.
  std::vector<std::string> warnings;         ///< What whoever uses the result should know, a sentence each.
};

}  // namespace swage
#pragma GCC visibility pop

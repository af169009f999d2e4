// Straight chains of the command line: read from a file, or found on the mesh.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "swage/mesh.h"
#include "swage/reshape.h"

namespace swage::cli {

/// How chains are found; as straight_chains() does by itself where nothing is given.
struct StraightFinding {
  std::optional<double> angle;     ///< Interior dihedral angle, degrees.
  std::optional<double> shortest;  ///< In box diagonals.
};

/// --straight-angle and --straight-shortest, which go with the option `straight`, in its group.
void add_finding_options(CLI::App& app, StraightFinding& finding, CLI::Option& straight);

std::vector<std::vector<int>> find_chains(const Mesh& mesh, const StraightFinding& finding);

/// As the options take it of `straight`: auto, none or a file. Throws UnreadableFile.
void set_chains(const std::string& straight, const StraightFinding& finding, const Mesh& mesh, ReshapeOptions& options);

/// Throws WrongUsage where chains are not to be found and it is told how.
void check_finding(const std::string& straight, const StraightFinding& finding);

struct ChainsOutput {
  std::string path;  ///< For the chains found; empty for nowhere.
  StraightFinding finding;
};

/// Throws WrongUsage where nothing can be written there beside `json`.
void check(const ChainsOutput& output, const std::string& json);

/// Throws UnwritableFile.
void write(const ChainsOutput& output, const Mesh& mesh);

}  // namespace swage::cli

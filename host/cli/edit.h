// What subcommands share that read a mesh, edit it and write it back.
#pragma once

#include <spdlog/spdlog.h>

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "backend_choice.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "report_json.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage::cli {

struct EditFiles {
  std::string mesh;
  std::string output;  ///< Result mesh; empty for none, "-" for stdout.
  std::string json;    ///< Report; likewise.
};

/// MESH, -o and --json.
void add_edit_files(CLI::App& app, EditFiles& files, const std::string& mesh_help);

/// Throws WrongUsage where nothing can be written there, or no mesh of that format. Empty ones are not looked at.
void check_outputs(const EditFiles& files);

/// Throws WrongUsage where none of what could be written is named.
void check_writes(const std::vector<std::string>& paths);

/// The name of a file of one of several results, from 0: a.obj is a_1.obj, a_2.obj, ... Of one result it is as given.
std::string numbered(const std::string& path, size_t result, size_t count);

/// Warns of what was skipped. Throws as read_mesh() does, and InvalidInput for damaged faces.
MeshFile read_input(const std::string& path);

/// What `work` gives; `thing`, such as a file, is named where it is refused.
template <typename Work>
auto naming(const std::string& thing, const Work& work) {
  try {
    return work();
  } catch (const InvalidInput& e) {
    throw InvalidInput(thing + ": " + e.what());
  } catch (const Unsolvable& e) {
    throw Unsolvable(thing + ": " + e.what());
  }
}

/// Nothing where there is no output. Throws UnwritableFile.
void write_result(const EditFiles& files, const MeshFile& file, const Positions& positions);

/// Of one of several equal parts of a whole call, which `progress` outlives.
ProgressFn part_of(const ProgressFn& progress, size_t part, size_t count);

/// Calls run(const ProgressFn&), which draws a bar on the terminal and ends where the user interrupts.
template <class Run>
auto with_progress(const CommonOptions& common, const Run& run) {
  ProgressBar bar(!common.quiet && !common.verbose);
  return run(ProgressFn([&](const Progress& now) {
    bar.show(now);
    spdlog::debug("{} {}: energy {}", now.stage, now.pass, now.energy);
    return !interrupted();
  }));
}

/// Prepares what is kept of a mesh and calls solve(plan). Throws Interrupted.
template <class Plan, class Solve>
auto timed(Plan plan, const ProgressFn& progress, RunSeconds& seconds, const Solve& solve) {
  const Stopwatch precompute;
  plan.prepare(progress);
  seconds.precompute = precompute.seconds();
  stop_if_interrupted();
  const Stopwatch watch;
  auto result = solve(plan);
  seconds.solve = watch.seconds();
  stop_if_interrupted();
  return result;
}

/// Calls solve(), on the cpu again where the device that `auto` chose turns out too small.
template <class Solve>
auto solve_or_fall_back(const BackendChoice& choice, std::shared_ptr<Backend>& backend, const Solve& solve) {
  try {
    return solve();
  } catch (const Unavailable& reason) {
    if (!choice.is_auto() || backend->name() == "cpu") throw;
    spdlog::warn("the cpu does the local steps: {}", reason.what());
  }
  backend = cpu_backend();
  return solve();
}

}  // namespace swage::cli

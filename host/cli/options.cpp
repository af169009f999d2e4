#include "options.h"

#include <spdlog/spdlog.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <atomic>
#include <iostream>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "failure.h"
#include "process.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

std::string version_text() {
  const std::string text = "swage " SWAGE_VERSION "\noptional parts: " SWAGE_IN "\nlicence: " SWAGE_LICENCE;
  const std::string helpers = SWAGE_HELPER_PROGRAMS;
  return helpers.empty() ? text : text + "\nrun as programs of their own, apart from this licence: " + helpers;
}

}  // namespace

CLI::Validator between(double low, double high) {
  const std::string range = fmt::format("{} to {}", low, high);
  return {[=](std::string& text) {
            double value = 0;
            const bool good = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
            return good ? std::string() : "'" + text + "' is not a number from " + range;
          },
          range};
}

void add_common_options(CLI::App& app, CommonOptions& common) {
  const std::string group = "Common options";
  app.add_option(
         "--backend", common.backend,
         "Where the local steps run: auto, cpu or opencl (SWAGE_BACKEND, else auto: OpenCL where there is a GPU, "
         "for all but reshape any device, and the work is large)")
      ->group(group)
      ->type_name("NAME");
  app.add_option("--device", common.device,
                 "OpenCL device, by index or part of its name in `swage devices` (SWAGE_DEVICE, else the first)")
      ->group(group)
      ->type_name("TEXT");
  app.add_option("--precision", common.precision,
                 "What an OpenCL device computes in: single or double (double where the device has it)")
      ->group(group)
      ->check(CLI::IsMember({"single", "double"}))
      ->type_name("NAME");
  app.add_option("--threads", common.threads, "Threads (as many as there are processors)")
      ->group(group)
      ->check(between(1, 1024))
      ->type_name("N");
  CLI::Option* quiet = app.add_flag("--quiet", common.quiet, "Log errors only, and draw no progress bar")->group(group);
  app.add_flag("-v", common.verbose, "Log more")->group(group)->excludes(quiet);
  app.set_help_flag("-h,--help", "Print this help")->group(group);
  app.set_version_flag("--version", version_text, "Print the version, the optional parts and the licence")
      ->group(group);
}

void apply(const CommonOptions& common) {
  spdlog::set_level(common.quiet ? spdlog::level::err : common.verbose ? spdlog::level::debug : spdlog::level::info);
#ifdef _OPENMP
  const int wanted = common.threads > 0 ? common.threads : omp_get_max_threads();
  const int threads = startable_threads(wanted);
  if (threads < wanted) {
    spdlog::warn("only {} of {} threads can be started: memory, or the number of processes, is limited", threads,
                 wanted);
  }
  omp_set_num_threads(threads);
// Started while there is memory: where libgomp cannot start one later, it ends the program.
#pragma omp parallel
  std::atomic_signal_fence(std::memory_order_seq_cst);
#endif
}

int threads_in_use() {
#ifdef _OPENMP
  return omp_get_max_threads();
#else
  return 1;
#endif
}

void write_stdout(const std::string& text) {
  if (!(std::cout << text << std::flush)) {
    throw UnwritableFile("stdout: nothing more can be written to it: is there room, and does somebody read it?");
  }
}

void check_can_be_written(const std::filesystem::path& path, const char* option) {
  namespace fs = std::filesystem;
  if (path.empty()) throw WrongUsage(std::string(option) + ": name a file, or - for stdout");
  if (path == kStdout) return;
  std::error_code ignored;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    throw WrongUsage(
        fmt::format("{} {}: there is no folder {}: make it first", option, path.string(), folder.string()));
  }
  if (fs::is_directory(path, ignored)) {
    throw WrongUsage(fmt::format("{} {}: that is a folder: name a file in it", option, path.string()));
  }
}

void check_different(const std::vector<Output>& outputs) {
  // Where a folder cannot be looked at, as it is written.
  const auto place_of = [](const std::filesystem::path& path) {
    std::error_code ignored;
    const std::filesystem::path place = std::filesystem::weakly_canonical(path, ignored);
    return place.empty() ? path : place;
  };
  for (size_t i = 0; i < outputs.size(); ++i) {
    for (size_t j = i + 1; j < outputs.size(); ++j) {
      if (outputs[i].path.empty() || place_of(outputs[i].path) != place_of(outputs[j].path)) continue;
      throw WrongUsage(fmt::format("{} and {} both name {}: give them different files", outputs[i].option,
                                   outputs[j].option, outputs[i].path));
    }
  }
}

}  // namespace swage::cli

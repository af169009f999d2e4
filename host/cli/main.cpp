#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <iostream>
#include <utility>
#include <vector>

#include "failure.h"
#include "interrupt.h"
#include "options.h"
#include "process.h"

namespace swage::cli {
namespace {

void start_log() {
  auto log = std::make_shared<spdlog::logger>("swage", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  log->set_pattern("swage: %l: %v");
  spdlog::set_default_logger(std::move(log));
}

int run_command(int argc, char** argv) {
  CLI::App program{"Edits the shape of triangle meshes the way a person would expect.", "swage"};
  CommonOptions common;
  std::vector<Command> commands = {reshape_command(program, common), stylize_command(program, common),
                                   resize_command(program, common)};
  for (Command& command : template_commands(program, common)) commands.push_back(std::move(command));
  for (const auto& make : {info_command, compare_command, demo_command, devices_command}) {
    commands.push_back(make(program, common));
  }
  add_common_options(program, common);
  for (const Command& command : commands) add_common_options(*command.app, common);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help_or_version) {
    return program.exit(asked_for_help_or_version);
  }
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    command.run();
    return exit_done;
  }
  std::cerr << program.help();
  return exit_wrong_usage;
}

}  // namespace
}  // namespace swage::cli

int main(int argc, char** argv) {
  swage::cli::prepare_process();
  swage::cli::start_log();
  swage::cli::watch_interrupts();
  try {
    return swage::cli::run_command(argc, argv);
  } catch (...) {
    return swage::cli::explain_failure();
  }
}

// The options that every subcommand has, and what they share.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace swage::cli {

/// Where a path is "-", results go to stdout.
inline constexpr const char* kStdout = "-";

struct CommonOptions {
  std::string backend;    ///< Empty where the option is not given.
  std::string device;     ///< Likewise.
  std::string precision;  ///< Likewise.
  int threads = 0;        ///< 0 leaves it to OpenMP.
  bool quiet = false;
  bool verbose = false;
};

/// A subcommand: main() runs it where the command line names it.
struct Command {
  CLI::App* app;
  std::function<void()> run;
};

Command reshape_command(CLI::App& program, const CommonOptions& common);
Command stylize_command(CLI::App& program, const CommonOptions& common);
Command resize_command(CLI::App& program, const CommonOptions& common);
std::vector<Command> template_commands(CLI::App& program, const CommonOptions& common);
Command info_command(CLI::App& program, const CommonOptions& common);
Command compare_command(CLI::App& program, const CommonOptions& common);
Command demo_command(CLI::App& program, const CommonOptions& common);
Command devices_command(CLI::App& program, const CommonOptions& common);

void add_common_options(CLI::App& app, CommonOptions& common);

/// A number between two others, both included. "nan" is none.
CLI::Validator between(double low, double high);

/// Sets the number of threads and what is logged.
void apply(const CommonOptions& common);

int threads_in_use();

/// Throws UnwritableFile.
void write_stdout(const std::string& text);

/// Throws WrongUsage where nothing can be written to `path`: a missing folder, or a folder itself.
void check_can_be_written(const std::filesystem::path& path, const char* option);

/// An option that names a file to write, which is empty where it is not given.
struct Output {
  const char* option;
  std::string path;
};

/// Throws WrongUsage where two name one file.
void check_different(const std::vector<Output>& outputs);

}  // namespace swage::cli

// Runs the program as a user would.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "places.h"
#include "swage/mesh.h"

namespace swage::test {

struct Outcome {
  int code = -1;  ///< Exit code; 1000 + signal where a signal ended it.
  std::string out, err;
};

/// A run that has begun. Its stderr goes to `err`.
struct Running {
  pid_t process = -1;
  int wait() const;  ///< For the exit code, as in Outcome.
};

using Arguments = std::vector<std::string>;
Arguments operator+(Arguments a, const Arguments& b);

/// `environment` holds NAME=VALUE.
Running start(const Arguments& arguments, const std::filesystem::path& out, const std::filesystem::path& err,
              const std::vector<std::string>& environment = {});

Outcome run(const Arguments& arguments, const std::vector<std::string>& environment = {});

/// A pseudo-terminal, whose other end is a file that a program can write to.
class Terminal {
 public:
  /// Whether this machine has pseudo-terminals: a bare root folder may not.
  static bool exists();
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  std::filesystem::path path() const;
  /// Reads until `text` has come; false where the program ended, or a minute passed, before.
  bool wait_for(const std::string& text);
  /// All that came and comes until the program ends.
  std::string rest();

 private:
  bool read_some();

  int end_;
  std::string text_;
};

/// An OBJ of a box, 1 x 1 x 2, of quadrilaterals, with all that must survive: comments, normals, texture, groups.
std::string box_obj(int cells = 3);

std::vector<std::string> lines(const std::string& text);

/// Names of the files in a folder, sorted.
std::vector<std::string> names_in(const std::filesystem::path& folder);

}  // namespace swage::test

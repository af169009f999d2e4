// The user's say over what is vulnerable: --protect and --release.
#pragma once

#include <CLI/App.hpp>
#include <array>
#include <string>
#include <vector>

#include "swage/handles.h"
#include "swage/resize.h"

namespace swage::cli {

struct ProtectionText {
  bool is_release;
  std::string text;  ///< SELECT[:axes][=value], without the value where it is a release.

  std::string words() const { return (is_release ? "--release " : "--protect ") + text; }
};

/// --protect and --release, in the order given.
void add_protection_options(CLI::App& app, std::vector<ProtectionText>& protections);

/// One of them, understood as far as that goes without the mesh.
class ProtectionRecipe {
 public:
  /// Throws WrongUsage where the selection, an axis or the value is not understood.
  explicit ProtectionRecipe(const ProtectionText& text);

  /// Triangles with three selected corners and, of boxes and half spaces, the region. Throws InvalidInput and
  /// UnreadableFile where there is neither, and WrongUsage where the mesh has what two ways of reading the text select.
  Protection on(const MeshFile& file) const;

 private:
  /// SELECT itself may hold colons and equals signs.
  struct Reading {
    std::string select, axes;
    double value;
    Selection selection;
  };
  void add_readings(const std::string& text, double value);
  Protection protection(const Reading& reading, const MeshFile& file) const;

  std::string words_;
  std::vector<Reading> readings_;  ///< Those that are understood, the shortest SELECT first.
  std::string misunderstood_;      ///< Why the first of the others is not.
};

}  // namespace swage::cli

// `swage template` as tests ask for it.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "program.h"

namespace swage::test {

/// With the box of box_obj(), 1 × 1 × 2 from the origin, as the mesh.
class Templating : public testing::Test {
 protected:
  Templating();

  /// Quietly.
  Outcome ask(Arguments arguments) const;
  /// What it prints, where it succeeds.
  std::string out_of(const Arguments& arguments) const;
  /// What --json - prints.
  nlohmann::json report(Arguments arguments) const;
  /// Refused with this code and one line that says this; nothing is written.
  void expect(int code, const std::string& says, const Arguments& arguments) const;

  std::string file(const std::string& name) const { return folder_ / name; }

  TempFolder folder_;
  std::string model_ = folder_ / "model.obj";
};

/// A fit of few samples: quick, and near enough for a box.
inline const Arguments kQuick{"--samples", "400", "--volume-samples", "200", "--no-turns"};

void expect_keys(const nlohmann::json& told, const std::vector<std::string>& keys);

}  // namespace swage::test

// A small problem for each method.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "swage/backend.h"
#include "written.h"

namespace swage::test {

struct Case {
  using BackendPtr = std::shared_ptr<Backend>;

  std::string name;
  Mesh mesh;  ///< Of a D of about 1.
  /// Vertices in the order and where the mesh was given, then what else comes of it, in units of about D.
  std::function<Positions(const Written& written, const BackendPtr& backend)> solve;

  // Tolerances, in D.
  double golden = 1e-9;   ///< Of what is kept in golden/, 0 where nothing is.
  double follows = 1e-6;  ///< Of another writing.
  double far = 1e-6;      ///< Of one that is moved far off.
  double single = 2e-5;   ///< Of another writing, on a device in single precision.

  Positions solved(const BackendPtr& backend = cpu_backend()) const { return solve(Written(mesh), backend); }
};

const std::vector<Case>& cases();
std::string name_of(const testing::TestParamInfo<Case>& instance);

/// Largest distance of two rows, in diagonals of the mesh.
double apart(const Case& of, const Positions& one, const Positions& other);

void PrintTo(const Case& of, std::ostream* out);

}  // namespace swage::test

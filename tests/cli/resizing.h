// `swage resize` as tests ask for it.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "program.h"

namespace swage::test {

/// A bar of 4 × 1 × 1 from the origin, group bar and component 0, and a ball of diameter 0.6 on it, about (1, 1.3,
/// 0.5), group ball and component 1, with a coarse grid.
class Resizing : public testing::Test {
 protected:
  Resizing();

  /// Of `mesh`, or else of the bar and ball.
  Outcome resize(const Arguments& more, const std::string& mesh = "") const;
  /// The report.
  nlohmann::json report(Arguments more, const std::string& mesh = "") const;
  /// The OBJ that comes of it.
  std::string result(Arguments more, const std::string& mesh = "") const;
  Mesh mesh_of(const Arguments& more, const std::string& mesh = "") const;

  std::string file(const std::string& name) const { return folder_ / name; }

  TempFolder folder_;
  std::string model_ = folder_ / "model.obj";
};

Eigen::AlignedBox3d box_of(const Positions& positions);
/// Of the bar's and ball's mesh.
Eigen::AlignedBox3d ball_in(const Mesh& mesh);

/// The numbers of triangles in a PLY as write_face_values() writes it, by their names.
std::map<std::string, Eigen::VectorXd> face_values(const std::filesystem::path& path);

}  // namespace swage::test

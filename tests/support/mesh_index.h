// What others found in the real meshes.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "swage/mesh.h"

namespace swage::test {

struct ListedMesh {
  std::string name;  ///< Inside the folder of the meshes.
  std::filesystem::path path;
  std::map<std::string, std::string> columns;

  int number(const std::string& column) const { return std::stoi(columns.at(column)); }
  double real(const std::string& column) const { return std::stod(columns.at(column)); }
  /// With faces in fans, as they were triangulated where others looked.
  Mesh in_fans() const;
  char letter() const { return columns.at("class").at(0); }  ///< Its class.
};

/// Of classes A to E, those whose files exist; none where there is no shared folder.
std::vector<ListedMesh> listed_meshes();

}  // namespace swage::test

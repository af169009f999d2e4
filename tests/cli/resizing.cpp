#include "resizing.h"

#include <cstring>
#include <sstream>
#include <stdexcept>

#include "shapes.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

constexpr int kBarCells = 4, kBarVertices = 6 * kBarCells * kBarCells + 2;

std::string obj_of(const Mesh& mesh, int first_vertex) {
  std::ostringstream text;
  text.precision(17);
  for (const auto& p : mesh.positions.rowwise()) text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (const auto& t : mesh.triangles.rowwise()) {
    text << "f " << t[0] + first_vertex << ' ' << t[1] + first_vertex << ' ' << t[2] + first_vertex << '\n';
  }
  return text.str();
}

}  // namespace

Resizing::Resizing() {
  const Mesh bar = box({4, 1, 1}, kBarCells), ball = transformed(sphere(0.3, 2), 1, {1, 1.3, 0.5});
  if (bar.positions.rows() != kBarVertices) throw std::logic_error("the bar has other vertices");
  write_text(model_, "g bar\n" + obj_of(bar, 1) + "g ball\n" + obj_of(ball, kBarVertices + 1));
}

Outcome Resizing::resize(const Arguments& more, const std::string& mesh) const {
  Arguments arguments{"resize", mesh.empty() ? model_ : mesh, "--quiet", "--grid", "20"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run(arguments);
}

nlohmann::json Resizing::report(Arguments more, const std::string& mesh) const {
  more.insert(more.end(), {"--json", "-"});
  const Outcome outcome = resize(more, mesh);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return outcome.code == 0 ? nlohmann::json::parse(outcome.out) : nlohmann::json();
}

std::string Resizing::result(Arguments more, const std::string& mesh) const {
  more.insert(more.end(), {"-o", "-"});
  const Outcome outcome = resize(more, mesh);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return outcome.out;
}

Mesh Resizing::mesh_of(const Arguments& more, const std::string& mesh) const {
  const std::string extension = std::filesystem::path(mesh.empty() ? model_ : mesh).extension();
  write_text(file("read_back" + extension), result(more, mesh));
  return read_mesh(file("read_back" + extension)).mesh;
}

Eigen::AlignedBox3d box_of(const Positions& positions) {
  return {positions.colwise().minCoeff().transpose(), positions.colwise().maxCoeff().transpose()};
}

Eigen::AlignedBox3d ball_in(const Mesh& mesh) {
  return box_of(mesh.positions.bottomRows(mesh.positions.rows() - kBarVertices));
}

std::map<std::string, Eigen::VectorXd> face_values(const std::filesystem::path& path) {
  const std::string bytes = read_text(path);
  std::istringstream header(bytes);
  std::vector<std::string> names;
  size_t faces = 0;
  bool in_faces = false;
  for (std::string line; std::getline(header, line) && line != "end_header";) {
    std::istringstream words(line);
    std::string word, type, name;
    words >> word >> type >> name;
    if (word == "element") in_faces = type == "face";
    if (word == "element" && in_faces) faces = std::stoul(name);
    if (word == "property" && in_faces && type == "double") names.push_back(name);
  }
  const size_t face = 13 + 8 * names.size();  // Bytes: a count, three corners, doubles.
  std::map<std::string, Eigen::VectorXd> values;
  for (size_t n = 0; n < names.size(); ++n) {
    Eigen::VectorXd& column = values[names[n]];
    column.resize(static_cast<Eigen::Index>(faces));
    for (size_t f = 0; f < faces; ++f) {
      const size_t at = bytes.size() - (faces - f) * face + 13 + 8 * n;
      std::memcpy(&column[static_cast<Eigen::Index>(f)], &bytes[at], sizeof(double));
    }
  }
  return values;
}

}  // namespace swage::test

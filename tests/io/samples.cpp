#include "samples.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <sstream>

#include "places.h"
#include "swage/error.h"

namespace swage::test {
namespace {

const std::vector<std::vector<int>> kFaces = {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};

template <typename T>
std::string raw(T value, bool big) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string point(const Positions& p, int v, const std::string& between = " ") {
  return decimal(p(v, 0)) + between + decimal(p(v, 1)) + between + decimal(p(v, 2));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string rich_obj(const Positions& p) {
  std::string text = "# a comment with v 1 2 3\nmtllib things.mtl\no The Thing\n\nvt 0.5 0.25\nvt 1 1\n";
  text += "v " + point(p, 0) + " 0.1 0.2 0.3\n";
  text += "v\t" + point(p, 1, "\t") + "   # tail\n";
  text += "  v  " + point(p, 2, "  ") + " 1.0\n";
  text += "v " + decimal(p(3, 0)) + " \\\n" + decimal(p(3, 1)) + " " + decimal(p(3, 2)) + " nan nan nan\n";
  text += "v " + point(p, 4) + "\n";
  text += "g base lower\nusemtl stone\ns 1\nf 1/1 4/2 3/1 2/2\ng sides\nf -5 -4 -1\nf 2/1/ 3/2/ \\\n 5/1/\n";
  text += "l 1 2\np 3\ng\nf 3/1 4 5/2 # joined\ncurv 0 1 2\nf 4// 1// 5//";
  return text;
}

std::string off(const Positions& p, const std::string& head, const std::string& vertex_tail,
                const std::string& face_tail) {
  std::string text = head;
  for (int v = 0; v < 5; ++v) text += point(p, v) + vertex_tail + "\n";
  for (const auto& face : kFaces) {
    text += std::to_string(face.size()) + " ";
    for (const int v : face) text.append(" ").append(std::to_string(v));
    text += face_tail + "\n";
  }
  return text;
}

std::string ascii_ply(const Positions& p) {
  std::string text =
      "ply\nformat ascii 1.0\ncomment by hand\nobj_info none\nelement vertex 5\nproperty uchar red\n"
      "property float x\nproperty list uchar int near\nproperty float y\nproperty float z\nproperty float s\n"
      "element tag 2\nproperty list uchar float values\nproperty int id\n"
      "element face 5\nproperty uchar flag\nproperty list uchar int vertex_indices\nproperty float area\nend_header\n";
  for (int v = 0; v < 5; ++v) {
    text.append("25").append(std::to_string(v)).append(" ").append(decimal(p(v, 0))).append(" 2 7 8 ");
    text.append(decimal(p(v, 1))).append(" ").append(decimal(p(v, 2))).append("  0.50\n");
  }
  text += "3 1 2 3 -4\n0 5\n";
  for (const auto& face : kFaces) {
    text.append("1 ").append(std::to_string(face.size()));
    for (const int v : face) text.append(" ").append(std::to_string(v));
    text += " 2.50\n";
  }
  return text;
}

template <typename Coordinate>
std::string binary_ply(const Positions& p, bool big) {
  const std::string type = sizeof(Coordinate) == 4 ? "float" : "double";
  std::string bytes =
      std::string("ply\r\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\r\nelement vertex 5\r\nproperty " +
      type + " z\r\nproperty list ushort char near\r\n" + "property " + type + " x\r\nproperty short tag\r\nproperty " +
      type + " y\r\nelement face 5\r\nproperty list uint ushort vertex_index\r\nproperty double area\r\n" +
      "element nothing 3\r\nelement edge 1\r\nproperty int a\r\nproperty int b\r\nend_header\r\n";
  for (int v = 0; v < 5; ++v) {
    bytes += raw(static_cast<Coordinate>(p(v, 2)), big) + raw(std::uint16_t{2}, big) + "\n\r";
    bytes += raw(static_cast<Coordinate>(p(v, 0)), big) + raw(std::int16_t{-7}, big);
    bytes += raw(static_cast<Coordinate>(p(v, 1)), big);
  }
  for (const auto& face : kFaces) {
    bytes += raw(static_cast<std::uint32_t>(face.size()), big);
    for (const int v : face) bytes += raw(static_cast<std::uint16_t>(v), big);
    bytes += raw(0.25, big);
  }
  return bytes + raw(0, big) + raw(1, big) + "trailing";
}

// Corners in an order that numbers the vertices as the pyramid has them.
const std::vector<std::vector<int>> kStlFaces = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}};

std::string ascii_stl(const Positions& p) {
  std::string text = "solid facet of loops\n";
  for (const auto& face : kStlFaces) {
    text += "  facet normal nan nan nan\n    OUTER loop\n";
    for (const int v : face) text += "      vertex  " + point(p, v) + "\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid facet of loops";
}

std::string binary_stl(const Positions& p) {
  std::string bytes = "solid but binary";
  bytes.resize(80, ' ');
  bytes += raw(static_cast<std::uint32_t>(kStlFaces.size()), false);
  for (const auto& face : kStlFaces) {
    const Eigen::Vector3d a = p.row(face[0]), b = p.row(face[1]), c = p.row(face[2]);
    const Eigen::Vector3d n = (b - a).cross(c - a).normalized();
    for (const double x : n) bytes += little_float(x);
    for (const int v : face) {
      for (int k = 0; k < 3; ++k) bytes += little_float(p(v, k));
    }
    bytes += "ab";
  }
  return bytes;
}

using Bytes = std::function<std::string(const Positions&)>;

Bytes with(Bytes bytes, const std::string& from, const std::string& to) {
  return [=](const Positions& p) { return replaced(bytes(p), from, to); };
}

Bytes off_like(const std::string& head, const std::string& vertex_tail = "", const std::string& face_tail = "") {
  return [=](const Positions& p) { return off(p, head, vertex_tail, face_tail); };
}

}  // namespace

Positions pyramid() {
  Positions p(5, 3);
  p << 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 1.5;
  return p;
}

Positions moved_pyramid() {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  Positions p = pyramid() * turn.transpose() * 1.1;
  p.rowwise() += Eigen::RowVector3d(0.1, -30.25, 1e-7);
  return p;
}

std::string decimal(double x) {
  char text[40];
  int digits = 1;
  do std::snprintf(text, sizeof text, "%.*g", digits, x);
  while (std::strtod(text, nullptr) != x && ++digits <= 17);
  return text;
}

std::string little_float(double x) { return raw(static_cast<float>(x), false); }

std::vector<Sample> samples() {
  return {{"rich.obj", rich_obj},
          {"crlf.obj", with(rich_obj, "\n", "\r\n")},
          {"cr.obj", with(rich_obj, "\n", "\r")},
          {"bom.obj", [](const Positions& p) { return "\xef\xbb\xbf" + rich_obj(p); }},
          {"plain.off", off_like("OFF\n5 5 0\n")},
          {"crlf.off", with(off_like("OFF\n5 5 0\n"), "\n", "\r\n")},
          {"comments.off", off_like("# first\nOFF # word\n# counts\n\n5 5 8 # tail\n", " # v", "  0.1 0.2 0.3 # f")},
          {"same_line.off", off_like("OFF 5 5 0\n")},
          {"glued.off", off_like("OFF5 5\n")},
          {"no_word.off", off_like("5 5 0\n\n")},
          {"colours.off", off_like("COFF\n5 5 0\n", " 255 128 0 255", " 3 1 2 3")},
          {"texture.off", off_like("STOFF\n5 5 0\n", " 0.5 0.25")},
          {"ascii.ply", ascii_ply},
          {"crlf.ply", with(ascii_ply, "\n", "\r\n")},
          {"cr.ply", with(ascii_ply, "\n", "\r")},
          {"little_float.ply", [](const Positions& p) { return binary_ply<float>(p, false); }, true},
          {"big_float.ply", [](const Positions& p) { return binary_ply<float>(p, true); }, true},
          {"little_double.ply", [](const Positions& p) { return binary_ply<double>(p, false); }},
          {"big_double.ply", [](const Positions& p) { return binary_ply<double>(p, true); }},
          {"ascii.stl", ascii_stl},
          {"crlf.STL", with(ascii_stl, "\n", "\r\n")},
          {"binary.stl", binary_stl, true}};
}

MeshFile read_bytes(const std::string& name, const std::string& bytes) {
  static const TempFolder folder;
  write_text(folder / name, bytes);
  return read_mesh(folder / name);
}

std::string written(const MeshFile& file, const Positions& positions) {
  std::ostringstream out;
  write_mesh(out, format_of(file.path), file, positions);
  return out.str();
}

std::string refusal(const std::string& name, const std::string& bytes) {
  try {
    read_bytes(name, bytes);
  } catch (const UnreadableFile& error) {
    return error.what();
  }
  ADD_FAILURE() << name << " was read:\n" << bytes.substr(0, 300);
  return "";
}

}  // namespace swage::test

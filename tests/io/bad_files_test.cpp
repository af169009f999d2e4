// What is refused, and where in the file the message points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <random>

#include "places.h"
#include "samples.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Bad {
  const char* name;
  std::string bytes;
  const char* place;  ///< "line 3" and such.
  const char* words;
};

void expect_refused(const std::vector<Bad>& files) {
  for (const Bad& bad : files) {
    EXPECT_THAT(refusal(bad.name, bad.bytes), AllOf(HasSubstr(bad.name), HasSubstr(bad.place), HasSubstr(bad.words)))
        << bad.bytes.substr(0, 200);
  }
}

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(BadObj, VerticesAndIndices) {
  expect_refused({{"a.obj", kObj + "f 1 2 0\n", "line 4", "vertex 0"},
                  {"a.obj", kObj + "f 1 2 3\n\nf 1 2 4\n", "line 6", "vertex 4"},
                  {"a.obj", kObj + "f 1 2 -4\nv 0 0 0\n", "line 4", "-4"},
                  {"a.obj", kObj + "f 1 2 2147483649\n", "line 4", "2^31"},
                  {"a.obj", kObj + "f 1 2 99999999999999999999999\n", "line 4", "2^31"},
                  {"a.obj", kObj + "f 1 2 -99999999999999999999999\n", "line 4", "counted back"},
                  {"a.obj", kObj + "f 1 2 x\n", "line 4", "'x'"},
                  {"a.obj", kObj + "f 1 2 3.5\n", "line 4", "'3.5'"},
                  {"a.obj", kObj + "f 1/2/3/4 2 3\n", "line 4", "'1/2/3/4'"},
                  {"a.obj", kObj + "v 1 2\nf 1 2 3\n", "line 4", "the line ends"},
                  {"a.obj", kObj + "v\nf 1 2 3\n", "line 4", "coordinate"},
                  {"a.obj", kObj + "v 1 2 # 3\nf 1 2 3\n", "line 4", "coordinate"},
                  {"a.obj", kObj + "v 1 2 3x\nf 1 2 3\n", "line 4", "'3x'"},
                  {"a.obj", kObj + "v 1 2 0x10\nf 1 2 3\n", "line 4", "'0x10'"},
                  {"a.obj", kObj + "v 1 2 +-3\nf 1 2 3\n", "line 4", "'+-3'"},
                  {"a.obj", kObj + "v 1 2 3,5\nf 1 2 3\n", "line 4", "'3,5'"},
                  {"a.obj", kObj + "v 1 nan 2\nf 1 2 3\n", "line 4", "not a finite number"},
                  {"a.obj", kObj + "v 1 -inf 2\nf 1 2 3\n", "line 4", "not a finite number"},
                  {"a.obj", kObj + "v 1 1e999 2\nf 1 2 3\n", "line 4", "not a finite number"},
                  {"a.obj", kObj + "v 1 -1.1e12 2\nf 1 2 3\n", "line 4", "1e12"},
                  {"a.obj", kObj + "vn 1 2\nf 1 2 3\n", "line 4", "normal"},
                  {"a.obj", kObj, "", "no triangles"},
                  {"a.obj", kObj + "f 1 2\nl 1 2 3\n", "", "no triangles"},
                  {"a.obj", kObj + "f 1 2 1\n", "", "no triangles"}});
}

TEST(BadObj, CountsLinesOfEveryKind) {
  expect_refused({{"a.obj", "v 0 0 0\r\n\r\nv 1 0\r\n", "line 3", ""},
                  {"a.obj", "v 0 0 0\r\rv 1 0\r", "line 3", ""},
                  {"a.obj", "v 0 \\\n0 0\n\nv 1 0\n", "line 4", ""}});
}

TEST(BadText, IsToldApart) {
  const std::string text = kObj + "f 1 2 3\n";
  std::string little = "\xff\xfe", big, zeros = text;
  for (const char c : text) (little += c) += '\0';
  for (const char c : text) (big += '\0') += c;
  zeros[5] = '\0';
  expect_refused({{"a.obj", little, "", "UTF-16"},
                  {"a.obj", big, "", "UTF-16"},
                  {"a.off", little, "", "UTF-16"},
                  {"a.obj", zeros, "byte 6", "not a text file"},
                  {"a.obj", "", "", "empty"},
                  {"a.off", "", "", "empty"},
                  {"a.ply", "", "", "empty"},
                  {"a.stl", "", "", "empty"}});
}

TEST(BadOff, HeadersCountsAndIndices) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n";
  expect_refused({{"a.off", "OFF\n3 1 0\n" + body + "3 0 1 3\n", "line 6", "vertex 3"},
                  {"a.off", "OFF\n3 1 0\n" + body + "3 0 1 -1\n", "line 6", "vertex -1"},
                  {"a.off", "OFF\n3 1 0\n" + body + "3 0 1 4294967297\n", "line 6", "vertex 4294967297"},
                  {"a.off", "OFF\n3 1 0\n" + body + "3 0 1\n", "line 6", "vertex of a face"},
                  {"a.off", "OFF\n3 1 0\n" + body + "-3 0 1 2\n", "line 6", "negative"},
                  {"a.off", "OFF\n3 1 0\n" + body + "1000000000 0 1 2\n", "line 6", "promised"},
                  {"a.off", "OFF\n3 2 0\n" + body + "3 0 1 2\n", "line 7", "truncated"},
                  {"a.off", "OFF\n3 1 0\n0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "line 3", "coordinate"},
                  {"a.off", "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", "line 3", "finite"},
                  {"a.off", "NOFF\n3 1 0\n0 0 0 1 0\n1 0 0\n0 1 0\n3 0 1 2\n", "line 3", "normal"},
                  {"a.off", "OFF\n353535235358 6 0\n" + body, "line 2", "promised"},
                  {"a.off", "OFF\n3 99999999999999999999 0\n" + body, "line 2", "promised"},
                  {"a.off", "OFF\n-3 1 0\n" + body, "line 2", "negative"},
                  {"a.off", "OFF\n3\n" + body, "line 2", "number of faces"},
                  {"a.off", "OFF\n3.5 1 0\n" + body, "line 2", "'3.5'"},
                  {"a.off", "OFF", "line 1", "number of vertices"},
                  {"a.off", "OFF BINARY\n\x01\x02", "line 1", "binary OFF"},
                  {"a.off", "4OFF\n3 1 0\n" + body, "line 1", "dimensions"},
                  {"a.off", "nOFF 3\n3 1 0\n" + body, "line 1", "dimensions"},
                  {"a.off", "4nOFF 3\n3 1 0\n" + body, "line 1", "dimensions"},
                  {"a.off", "XOFF\n3 1 0\n" + body, "line 1", "not an OFF file"},
                  {"a.off", "solid\n", "line 1", "'solid'"},
                  {"a.off", "OFF\n3 1 0\n" + body + "2 0 1\n", "", "no triangles"}});
}

std::string ply(const std::string& header, const std::string& body) { return "ply\n" + header + "end_header\n" + body; }

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kHead = "format ascii 1.0\nelement vertex 3\n" + kXyz;
const std::string kFace = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kBody = "0 0 0\n1 0 0\n0 1 0\n";

TEST(BadPly, Headers) {
  const std::string count = "format ascii 1.0\nelement vertex ";
  expect_refused(
      {{"a.ply", "plx\n", "line 1", "'plx'"},
       {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "line 4", "end_header"},
       {"a.ply", ply("element vertex 3\n", ""), "line 1", "format"},
       {"a.ply", ply("format binary_middle_endian 1.0\n", ""), "line 2", "'binary_middle_endian'"},
       {"a.ply", ply(kHead, kBody), "", "no face element"},
       {"a.ply", ply("format ascii 1.0\n" + kFace, ""), "", "no vertex element"},
       {"a.ply", ply(kHead + "element tristrips 1\nproperty list int int vertex_indices\n", ""), "", "triangle strips"},
       {"a.ply", ply(count + "3\nproperty float x\nproperty float y\n" + kFace, kBody), "line 3", "property z"},
       {"a.ply", ply(count + "3\nproperty int x\nproperty float y\nproperty float z\n" + kFace, kBody), "line 3",
        "float"},
       {"a.ply", ply(count + "x\n" + kXyz + kFace, kBody), "line 3", "'x'"},
       {"a.ply", ply(count + "-1\n" + kXyz + kFace, kBody), "", "negative"},
       {"a.ply", ply("property float x\n", ""), "line 2", "before any element"},
       {"a.ply", ply(kHead + "property float y\n" + kFace, ""), "line 7", "twice"},
       {"a.ply", ply(kHead + "element vertex 3\n" + kFace, ""), "line 7", "twice"},
       {"a.ply", ply(kHead + "property quad q\n", ""), "line 7", "'quad'"},
       {"a.ply", ply(kHead + "nonsense\n", ""), "line 7", "'nonsense'"},
       {"a.ply", ply(kHead + "element face 1\nproperty list float int vertex_indices\n", ""), "line 8", "integer"},
       {"a.ply", ply(kHead + "element face 1\nproperty list uchar float vertex_indices\n", kBody), "line 7",
        "integers"},
       {"a.ply", ply(kHead + "element face 1\nproperty int vertex_indices\n", kBody), "line 7", "vertex_indices"}});
}

TEST(BadPly, Bodies) {
  const std::string binary = "format binary_little_endian 1.0\nelement vertex 3\n" + kXyz;
  const std::string zeros(36, '\0');
  std::string infinite = zeros;
  infinite.replace(4, 4, std::string("\0\0\x80\x7f", 4));
  expect_refused(
      {{"a.ply", ply(kHead + kFace, kBody + "3 0 1 3\n"), "line 13", "vertex 3"},
       {"a.ply", ply(kHead + kFace, kBody + "3 0 1\n"), "line 13", "integer"},
       {"a.ply", ply(kHead + kFace, kBody + "-3 0 1 2\n"), "line 13", "negative"},
       {"a.ply", ply(kHead + kFace, "0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "line 10", "number"},
       {"a.ply", ply(kHead + kFace, "0 0 inf\n1 0 0\n0 1 0\n3 0 1 2\n"), "line 10", "finite"},
       {"a.ply", ply(kHead + kFace, kBody), "line 13", "truncated"},
       {"a.ply", ply(kHead + "element face 999999999999999999\nproperty list uchar int vertex_indices\n", kBody), "",
        "promised"},
       {"a.ply", ply("format ascii 1.0\nelement vertex 9000000000000000000\n" + kXyz + kFace, kBody), "", "promised"},
       {"a.ply", ply(binary + kFace, zeros.substr(0, 30)), "byte", "promised"},
       {"a.ply", ply(binary + kFace, zeros + "\x03" + zeros.substr(0, 10)), "byte", "promised"},
       {"a.ply", ply(binary + kFace, zeros + "\x03" + std::string("\0\0\0\0\1\0\0\0\3\0\0\0", 12)), "byte", "vertex 3"},
       {"a.ply", ply(binary + kFace, infinite + "\x03" + zeros), "byte 174", "finite"},
       {"a.ply", ply(binary + "element face 1\nproperty list int int vertex_indices\n", zeros + "\xff\xff\xff\xff"),
        "byte", "negative"},
       {"a.ply", ply(binary + "element face 1\nproperty list uint int vertex_indices\n", zeros + "\xff\xff\xff\xff"),
        "byte", "promised"}});
}

TEST(BadStl, AsciiAndBinary) {
  const std::string head = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  const std::string tail = "vertex 0 1 0\nendloop\nendfacet\n";
  std::string promising(84, ' ');
  promising.replace(80, 4, "\xff\xff\xff\xff");
  std::string none(84, '\0');
  expect_refused({{"a.stl", head + tail, "line 9", "endsolid"},
                  {"a.stl", head + "endloop\n", "line 6", "vertex is expected"},
                  {"a.stl", head + "vertex 0 1 0\n" + tail, "line 7", "endloop is expected"},
                  {"a.stl", head + "vertex 0 1 blah\n" + tail, "line 6", "'blah'"},
                  {"a.stl", head + "vertex 0 1 nan\n" + tail, "line 6", "finite"},
                  {"a.stl", head + "vertex 0 1", "line 6", "truncated"},
                  {"a.stl", head, "line 6", "truncated"},
                  {"a.stl", head + tail + "nonsense\n", "line 9", "'nonsense'"},
                  {"a.stl", "solid a\nendsolid a\n", "", "no triangles"},
                  {"a.stl", promising, "byte 81", "214748364834"},
                  {"a.stl", none, "", "no triangles"},
                  {"a.stl", "garbage", "", "neither ascii"}});
}

TEST(BadPath, IsNamed) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "folder.obj");
  const auto message = [&](const char* name) -> std::string {
    try {
      read_mesh(folder / name);
    } catch (const UnreadableFile& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message("missing.obj"), AllOf(HasSubstr("missing.obj"), HasSubstr("no such file")));
  EXPECT_THAT(message("missing/a.obj"), HasSubstr("no such file"));
  EXPECT_THAT(message("folder.obj"), HasSubstr("is a folder"));
  std::filesystem::create_symlink("/dev/zero", folder / "endless.obj");
  EXPECT_THAT(message("endless.obj"), HasSubstr("not an ordinary file"));
  std::filesystem::create_symlink("loop.obj", folder / "loop.obj");
  EXPECT_NE(message("loop.obj"), "");
}

// Reading may succeed or be refused; nothing else may happen.
void expect_read_or_refused(const std::string& name, const std::string& bytes) {
  try {
    const MeshFile file = read_bytes(name, bytes);
    check(file.mesh.positions, file.mesh.triangles);
    EXPECT_EQ(written(file, file.mesh.positions), bytes);
  } catch (const UnreadableFile&) {
  }
}

std::vector<std::pair<std::string, std::string>> files_with_normals() {
  std::vector<std::pair<std::string, std::string>> files;
  for (const Sample& sample : samples()) files.emplace_back(sample.name, sample.bytes(moved_pyramid()));
  files.emplace_back("n.obj", kObj + "vn 0 0 1\nvn 0 1 0\nf 1//1 2/5/2 3//-1\n");
  files.emplace_back("n.off", "STCNOFF\n3 1 0\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 0.5 0.5\n");
  return files;
}

TEST(Truncated, AtEveryPercentIsReadOrRefused) {
  for (const auto& [name, bytes] : files_with_normals()) {
    SCOPED_TRACE(name);
    for (size_t percent = 0; percent < 100; ++percent) {
      expect_read_or_refused(name, bytes.substr(0, bytes.size() * percent / 100));
    }
  }
}

TEST(Truncated, FormatsThatPromiseCountsAreRefused) {
  for (const Sample& sample : samples()) {
    const std::string bytes = sample.bytes(moved_pyramid());
    if (format_of(sample.name) == MeshFormat::obj) continue;
    // Up to the element that nothing needs.
    for (size_t percent = 1; percent <= 80; ++percent) {
      EXPECT_NE(refusal(sample.name, bytes.substr(0, bytes.size() * percent / 100)), "");
    }
  }
}

TEST(Flipped, BytesAreReadOrRefused) {
  std::mt19937 random(20240607);
  for (const auto& [name, bytes] : files_with_normals()) {
    SCOPED_TRACE(name);
    for (int round = 0; round < 150; ++round) {
      std::string flipped = bytes;
      for (int flips = 1 + round % 4; flips > 0; --flips) {
        flipped[random() % flipped.size()] = static_cast<char>(random() & 0xff);
      }
      expect_read_or_refused(name, flipped);
    }
  }
}

}  // namespace
}  // namespace swage::test

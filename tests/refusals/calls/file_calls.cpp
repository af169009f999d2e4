#include <sstream>

#include "calls.h"
#include "swage/mesh_io.h"
#include "swage/scaffold.h"

namespace swage::test {
namespace {

/// Of the cube, as if read.
MeshFile cube_file(const std::vector<std::vector<int>>& polygons = {}) {
  MeshFile file;
  file.mesh = cube;
  file.polygons = polygons;
  return file;
}

/// Of a file that has one more.
MeshFile without_a_face() {
  write_mesh("read.obj", cube);
  MeshFile file = read_mesh("read.obj");
  file.polygons.pop_back();
  return file;
}

/// A stream that takes nothing.
void write_to_broken_stream() {
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  write_mesh(out, MeshFormat::obj, cube_file(), cube.positions);
}

Gesture lost() { return {"lost", {{99, {0, 0, 0}}}}; }

}  // namespace

std::vector<Call> file_calls() {
  return {
      CALL(format_of("cube.fbx")),
      CALL(write_mesh("cube.fbx", cube)),
      CALL(write_mesh("missing/cube.obj", cube)),
      CALL(write_mesh("cube.obj", cube_file(), rows(7))),
      CALL(write_mesh("cube.obj", cube_file(), rows(9))),
      CALL(write_mesh("cube.obj", without_a_face(), cube.positions)),
      CALL(write_mesh("cube.obj", cube_file({{0, 1}}), cube.positions)),
      CALL(write_mesh("cube.obj", cube_file({{0, 1, 8}}), cube.positions)),
      CALL(write_to_broken_stream()),
      CALL(write_face_values("cube.ply", cube, {{"two words", Eigen::VectorXd::Zero(12)}})),
      CALL(write_face_values("cube.ply", cube, {{"heat", Eigen::VectorXd::Zero(8)}})),
      CALL(write_file("/", "text")),
      CALL(write_file("/dev/full", "text")),
      CALL(write_gestures("up.deform", {up}, point.positions)),
      CALL(write_gestures("up.deform", {lost()}, cube.positions)),
      CALL(write_straight_chains("chains.txt", {{0, 1, 1}})),
      CALL(write_tetrahedra("cube.obj", cube.positions, Tetrahedra(0, 4))),
      CALL(write_tetrahedra("cube.vtk", cube.positions, Tetrahedra::Constant(1, 4, 8))),
      CALL(Selection("x<high")),
      CALL(Selection("x>5").vertices(cube_file())),
      CALL(Selection("box:5,5,5,6,6,6").region(cube_file())),
  };
}

}  // namespace swage::test

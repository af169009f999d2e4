#include <algorithm>

#include "calls.h"
#include "swage/polycube.h"
#include "swage/style_io.h"
#include "swage/style_measures.h"
#include "swage/stylize.h"

namespace swage::test {
namespace {

Stylize stylize_of(const Mesh& mesh, const StylizeOptions& options = {}) {
  return {mesh.positions, mesh.triangles, options};
}

StylizeOptions intrinsic_farap() {
  StylizeOptions options = with(&StylizeOptions::energy, StylizeEnergy::farap);
  options.weights = StylizeWeights::intrinsic_delaunay;
  return options;
}

StylizeResult polycube_of(const PolycubeOptions& options, const ClosestNormals& style = {rows(1)}) {
  return polycube(cube.positions, cube.triangles, style, options);
}

TextureCoordinates texture(int triangles, int last, double v = 0) {
  TextureCoordinates made;
  made.points.setConstant(3, 2, v);
  made.triangles = rows<Triangles>(triangles, 0, last);
  return made;
}

NormalPicture picture(int width, int height) {
  NormalPicture made{width, height, {}};
  made.normals.assign(static_cast<size_t>(3 * width * height), 1);
  return made;
}

NormalPicture upper_half() {
  NormalPicture made = picture(8, 4);
  std::fill(made.normals.begin() + 48, made.normals.end(), 0.0F);
  return made;
}

Mesh inside_out() {
  Mesh mesh = cube;
  mesh.triangles.col(0).swap(mesh.triangles.col(1));
  return mesh;
}

Mesh half_sphere() {
  Mesh mesh = sphere(1, 3);
  mesh.triangles.conservativeResize(mesh.triangles.rows() / 2, 3);
  return mesh;
}

}  // namespace

std::vector<Call> style_calls() {
  return {
      CALL(stylize_of(line)),
      CALL(stylize_of(cube, intrinsic_farap())),
      CALL(stylize_of(cube, with(&StylizeOptions::acceleration_window, 51))),
      CALL(stylize_of(cube, with(&StylizeOptions::pass_limit, 0))),
      CALL(stylize_of(cube, with(&StylizeOptions::movement, -1))),
      CALL(stylize_of(cube).solve(ClosestNormals{rows(1)}, nan)),
      CALL(stylize_of(cube).solve(ClosestNormals{rows(0)})),
      CALL(stylize_of(cube).solve(ClosestNormals{rows(2, 1, nan)})),
      CALL(stylize_of(cube).solve(ClosestNormals{rows(2, 1, 0)})),
      CALL(stylize_of(cube).solve(GivenNormals{rows(7)})),
      CALL(stylize_of(cube).solve(GivenNormals{rows(8), true})),
      CALL(stylize_of(cube).solve(GivenNormals{rows(8, 1, nan)})),
      CALL(stylize_of(cube).solve(SphereMap{})),
      CALL(stylize_of(cube).solve(SphereMap{rows(3), {}, rows(3)})),
      CALL(stylize_of(cube).solve(SphereMap{rows(3), rows<Triangles>(2, 0, 3), rows(3)})),
      CALL(stylize_of(cube).solve(Developable{-1})),
      CALL(stylize_of(cube).solve(Developable{0.25, nan})),
      CALL(polycube_of({}, {rows(0)})),
      CALL(polycube_of(with(&PolycubeOptions::lambda, 0))),
      CALL(polycube_of(with(&PolycubeOptions::pass_limit, 0))),
      CALL(polycube_of(with(&PolycubeOptions::energy_drop, -1))),
      CALL(polycube_of(with(&PolycubeOptions::least_angle, 1))),
      CALL(closest_normals(line)),
      CALL(sphere_map(triangle)),
      CALL(sphere_map(joined(cube, transformed(cube, 1, {2, 0, 0})))),
      CALL(sphere_map(torus())),
      CALL(sphere_map(inside_out())),
      CALL(prism(2)),
      CALL(bipyramid(2)),
      CALL(rounded_cube(2)),
      CALL(rounded_cube(0.3, 1)),
      CALL(normal_capture(NormalPicture{2, 1, {0, 0, 1}}, CaptureLayout::equirectangular)),
      CALL(normal_capture(picture(8, 8), CaptureLayout::hemispheres)),
      CALL(normal_capture(picture(4, 2), CaptureLayout::equirectangular)),
      CALL(normal_capture(upper_half(), CaptureLayout::equirectangular)),
      CALL(normal_capture(cube, rows(7))),
      CALL(normal_capture(line, rows(3))),
      CALL(normal_capture(half_sphere(), rows(half_sphere().positions.rows()))),
      CALL(unbaked(cube, texture(11, 0), picture(4, 4))),
      CALL(unbaked(cube, texture(12, 3), picture(4, 4))),
      CALL(unbaked(cube, texture(12, 0, nan), picture(4, 4))),
      CALL(style_measures(cube.positions, cube.triangles, GivenNormals{rows(7)})),
      CALL(style_measures(cube.positions, cube.triangles, GivenNormals{rows(8), true})),
  };
}

}  // namespace swage::test

// Styles from files and pictures: painted spheres, normals of a mesh's vertices or triangles, normal maps.
#pragma once

#include <filesystem>
#include <vector>

#include "swage/mesh_io.h"
#include "swage/style.h"

#pragma GCC visibility push(default)
namespace swage {

/// A picture whose colours are directions: red, green and blue are x, y and z, dark -1 and full 1.
struct NormalPicture {
  int width = 0, height = 0;
  std::vector<float> normals;  ///< Row after row from the top, from the left, three a pixel; zero where there is none.
};

/// Reads a PNG of 8 or 16 bits, of colours or a palette, with or without alpha. A pixel has no normal where it is
/// transparent by half or its colour is no direction, of a length outside [1/2, 3/2]: grey, black, white. Of a channel
/// the two values in the middle are both 0, so that 128, 128, 255 is straight.
/// Throws UnreadableFile where the file is missing, damaged, no PNG, grey, or of more than 2^26 pixels; Unavailable
/// where this build has no pictures (SWAGE_RENDER).
NormalPicture read_normal_picture(const std::filesystem::path& path);

/// How a picture, twice as wide as high, shows a sphere; y is up.
enum class CaptureLayout {
  equirectangular,  ///< Rows are latitudes, y at the top; columns longitudes, z in the middle, x a quarter of the width
                    ///< to the right of it.
  hemispheres,      ///< Two discs side by side, each as wide as it may be: the sphere as seen from z, with x to the
                    ///< right, and as seen from -z, with x to the left.
};

/// "equirectangular", "hemispheres".
const char* to_string(CaptureLayout layout);

/// A painted sphere: where a shape's normal meets it, the normal painted there is the style's. Gaps of up to 5 % of the
/// sphere are filled from around them. Throws InvalidInput where the picture has not the proportions or pixels it says,
/// or less than that is painted.
SphereMap normal_capture(const NormalPicture& picture, CaptureLayout layout);

/// The same of a mesh, seen from the middle of its surface, with a normal a vertex (#V × 3, of any length; zero or not
/// finite where none is painted). Throws InvalidInput where check() does, the triangles do not cover the sphere once,
/// wound counter-clockwise seen from outside, or less than 95 % of it is painted. Seams may be open.
SphereMap normal_capture(const Mesh& sphere, const Positions& normals);

/// Of a .png, or of a mesh in a .ply with properties nx, ny, nz of its vertices; then there is no `layout`. Throws
/// InvalidInput as normal_capture() does, naming the file, and UnreadableFile.
SphereMap read_normal_capture(const std::filesystem::path& path, CaptureLayout layout = CaptureLayout::equirectangular);

/// The properties nx, ny, nz of a .ply's vertices or, where they have none, its faces, as normals for `mesh`, which has
/// as many. Throws UnreadableFile, and InvalidInput where it has more or fewer.
GivenNormals read_given_normals(const std::filesystem::path& path, const MeshFile& mesh);

enum class NormalSpace {
  tangent,  ///< x along growing u, y along growing v, z along the triangle's own normal.
  object,   ///< The mesh's own axes.
};

/// "tangent", "object".
const char* to_string(NormalSpace space);

struct NormalMapOptions {
  NormalSpace space = NormalSpace::tangent;
  bool green_down = false;  ///< Of tangent space: whether y is along falling v (DirectX), not growing (OpenGL).
};

/// Relief from a normal map: of each triangle the mean of the map's normals over it, at up to 256 points. Tangents are
/// means of those of the triangles around that share both vertex and texture point and are not mirrored against each
/// other, as MikkTSpace has it; the normal that they stand on is the triangle's own, not a smoothed one, so that a map
/// that is straight everywhere asks for nothing. Triangles without area in the picture keep their own normal, those
/// where the map has none get none.
/// Throws InvalidInput where check() does, the texture is not of the mesh, or the map has not the pixels it says.
GivenNormals unbaked(const Mesh& mesh, const TextureCoordinates& texture, const NormalPicture& map,
                     const NormalMapOptions& options = {});

}  // namespace swage
#pragma GCC visibility pop

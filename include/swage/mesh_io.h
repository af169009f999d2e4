// Mesh files: read, write, and write back into the file a mesh came from.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "swage/mesh.h"

#pragma GCC visibility push(default)
namespace swage {

enum class MeshFormat { obj, ply, stl, off };

/// By the extension, in any case. Throws InvalidInput for any other than .obj .ply .stl .off.
MeshFormat format_of(const std::filesystem::path& path);

struct MeshSource;  ///< The bytes of a file and where in them each coordinate stands.

/// A mesh together with the file it came from.
struct MeshFile {
  Mesh mesh;                                       ///< As solved: polygons triangulated, STL corners welded.
  std::vector<std::vector<int>> polygons;          ///< Faces as the file has them, vertex indices from 0.
  std::vector<int> triangle_polygons;              ///< Of each triangle the polygon that it is a part of.
  std::map<std::string, std::vector<int>> groups;  ///< OBJ groups: their vertices, ascending.
  std::string skipped_face;  ///< Place of the first face with fewer than three vertices, as "line 5"; empty for none.
  std::vector<std::string> warnings;  ///< What was skipped or mended, with its line.
  std::filesystem::path path;
  std::shared_ptr<const MeshSource> source;  ///< What write_mesh() writes back into.
};

/// Reads OBJ, PLY (ascii, binary of both orders), STL (ascii, binary) or OFF (with its colour and normal variants).
/// Vertices keep the order of the file. STL corners with equal coordinates become one vertex, numbered by first use.
/// Polygons are triangulated by an ear-cutting fan that keeps their winding; faces of two vertices are skipped with
/// a warning.
///
/// Throws UnreadableFile, with the line or byte and a remedy, where the file is missing, empty, truncated or not of
/// its format, an index is out of range, a coordinate is NaN, infinite or beyond 1e12, or no triangle remains.
MeshFile read_mesh(const std::filesystem::path& path);

/// Where triangles lie in a picture: libigl's TC and FTC.
struct TextureCoordinates {
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> points;  ///< #C × 2: u to the right, v upwards; the picture
                                                                     ///< is [0, 1]², and again beyond.
  Triangles triangles;  ///< #T × 3: points of their corners.
};

/// The texture coordinates of an OBJ. Throws UnreadableFile where it is another format or has none, and, naming the
/// line, where a corner of a face lacks them or names some that are not there, or one is not finite.
TextureCoordinates read_texture_coordinates(const MeshFile& file);

/// Writes `file` with other positions (#V × 3, file.mesh's order). Into the format it came from, only coordinates
/// and normals change: every other byte is kept, and so are the coordinates of vertices that did not move. Into
/// another format, positions and polygons are written.
/// Normals turn with the surface: by the rotation from the rest to the new normal of the faces that use them.
///
/// Writes beside `path`, then renames. Throws UnwritableFile where that fails.
void write_mesh(const std::filesystem::path& path, const MeshFile& file, const PositionsRef& positions);
void write_mesh(std::ostream& out, MeshFormat format, const MeshFile& file, const PositionsRef& positions);

/// Writes a mesh that came from no file.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh);

/// A number of each triangle.
struct FaceValues {
  std::string name;  ///< Letters, digits and underscores.
  Eigen::VectorXd values;
};

/// Writes a PLY of the mesh whose triangles have these numbers as properties. Throws InvalidInput as check() does and
/// where a name is none or there are more or fewer numbers than triangles, and UnwritableFile.
void write_face_values(const std::filesystem::path& path, const Mesh& mesh, const std::vector<FaceValues>& faces);

/// Writes text beside `path`, then renames: `path` holds the old content or the new one, never half.
/// Throws UnwritableFile.
void write_file(const std::filesystem::path& path, const std::string& content);

}  // namespace swage
#pragma GCC visibility pop

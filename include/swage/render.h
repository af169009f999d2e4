// Pictures of meshes, side by side and at one scale, made without a display.
#pragma once

#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "swage/handles.h"
#include "swage/mesh.h"
#include "swage/report.h"

#pragma GCC visibility push(default)
namespace swage {

/// What was asked of a vertex, as a dot that nothing hides: red where it is held, orange where it is moved.
struct HandleMark {
  Eigen::Vector3d from, to;  ///< Mesh units; the same where it is held.
  bool reached = false;      ///< The dot is at `to`; else at `from`, with an arrow to `to`.
};

/// Of a gesture's handles, at the mesh that it is of or, where `reached`, at its edit.
std::vector<HandleMark> handle_marks(const Gesture& gesture, const PositionsRef& rest, bool reached);

/// Where the eye is, infinitely far away.
struct View {
  Eigen::Vector3d from;  ///< Towards the eye, of any length.
  Eigen::Vector3d up;    ///< Upwards in the picture. Where it is along `from`, an axis across takes its place.
};

struct Panel {
  Mesh mesh;
  std::string title;                ///< UTF-8, above it.
  std::vector<HandleMark> handles;  ///< As handle_marks() gives them, or any.
  Eigen::VectorXd face_values;      ///< #T, as colours of HeatMap, NaN in grey; empty for a plain surface.
  std::string caption;              ///< Smaller, below the title.
};

/// What the colours of Panel::face_values mean: pale at `low`, dark at `high`, evenly so to the eye between, and also
/// to one that is colour-blind. Values beyond have the colours of the ends.
struct HeatMap {
  double low = 0, high = 1;  ///< Finite, the first below the second.
  std::string label;         ///< Beside the colour bar.
};

struct RenderOptions {
  int width = 1600, height = 900;  ///< Pixels, [64, 16384]. The height of a contact sheet's rows, each.
  std::optional<View> view;        ///< Where absent, automatic_view() of the first panel.
  Eigen::Vector3d up{0, 1, 0};     ///< For the automatic view.
  bool feature_lines = true;       ///< Creases, boundaries and outlines.
  double feature_angle = std::numbers::pi * 145 / 180;  ///< Interior dihedral angle, radians, [0, pi]: sharper edges
                                                        ///< are creases, across others shading is smooth.
  int supersampling = 3;                                ///< Rays a pixel along each side, [1, 8].
  int ambient_rays = 8;             ///< A pixel, [0, 64], for shadows where the surface is hollow; 0: none.
  std::optional<HeatMap> heat_map;  ///< Where absent, from the least to the largest of the face values.
  std::string title;                ///< Of the whole picture.
  int columns = 0;                  ///< Of panels, [0, 1000]; 0: as many as make the meshes largest.
};

/// Row after row from the top, from the left, three bytes a pixel: sRGB.
struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

/// Whether this build makes pictures (SWAGE_RENDER, SWAGE_EMBREE). Else what follows throws Unavailable.
bool can_render();

/// The panels in a grid, all from the same view, at the same scale and with the same place of space in their middles:
/// what did not move is at the same place of each panel. White behind. Deterministic, whatever the number of threads.
///
/// Throws InvalidInput where there is no panel, a mesh is refused by check(), all vertices of triangles are at one
/// place over all panels, face values are not one a triangle, an option is out of its range, a handle or view is not
/// finite or `view.from` is zero. Triangles without area are not seen. Where `progress` cancels, the image is empty.
Image render(const std::vector<Panel>& panels, const RenderOptions& options = {}, const ProgressFn& progress = {});

/// Panels that share a view and a scale of their own, such as edits of one mesh by several methods.
struct SheetRow {
  std::string title;  ///< Above the row, from the left.
  std::vector<Panel> panels;
  std::optional<View> view;  ///< Where absent RenderOptions::view, else automatic_view() of its first panel.
};

/// Rows below one another, `options.height` pixels each, in columns of `options.width` divided by the longest row; with
/// titles of columns (none, or one for each) and of the sheet above and one colour bar below. Throws as render() does.
Image contact_sheet(const std::vector<SheetRow>& rows, const std::vector<std::string>& columns = {},
                    const RenderOptions& options = {}, const ProgressFn& progress = {});

/// Of a handful of views from half above, around `up`, the one that shows most of the surface, its normals most
/// various, and handles unhidden with arrows in the picture's plane. Throws InvalidInput as render() does.
View automatic_view(const Mesh& mesh, const std::vector<HandleMark>& handles = {},
                    const Eigen::Vector3d& up = {0, 1, 0});

/// The bytes of a PNG file. Throws InvalidInput where the image has no pixels or not as many as it says.
std::string png(const Image& image);

/// Writes beside `path`, then renames. Throws as png() does, and UnwritableFile.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace swage
#pragma GCC visibility pop

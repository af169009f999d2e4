// Pictures: where they go, and from where they are seen.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "options.h"
#include "swage/render.h"

namespace swage::cli {

struct PictureOptions {
  std::string path;  ///< Empty for no picture.
  std::string view;  ///< X,Y,Z; empty for the automatic one.
  std::string up = "y";
  std::string size = "1600x900";
  const char* size_option = "--size";  ///< What the option for it is called.
};

/// --picture.
CLI::Option* add_picture_option(CLI::App& app, PictureOptions& options, const std::string& help);

/// --view and what sets the size.
std::vector<CLI::Option*> add_eye_options(CLI::App& app, PictureOptions& options, const char* size_option = "--size");

/// --view, --up and what sets the size.
std::vector<CLI::Option*> add_view_options(CLI::App& app, PictureOptions& options, const char* size_option = "--size");

/// Throws WrongUsage where an option is not understood or nothing can be written to the path, which the `option` names,
/// and Unavailable where this build makes no pictures.
void check(const PictureOptions& options, const char* option = "--picture");

/// Throws WrongUsage.
RenderOptions render_options_of(const PictureOptions& options);
/// The same where `up` is up.
RenderOptions render_options_of(const PictureOptions& options, const Eigen::Vector3d& up);

/// The next of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten: an end for a colour bar.
double rounded_up(double value);

/// With a progress bar. Throws Interrupted.
Image drawn(const std::vector<Panel>& panels, const RenderOptions& options, const CommonOptions& common);

/// A contact sheet, likewise.
Image drawn(const std::vector<SheetRow>& rows, const std::vector<std::string>& columns, const RenderOptions& options,
            const CommonOptions& common);

}  // namespace swage::cli

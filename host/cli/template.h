// `swage template` and what stands below it.
#pragma once

#include "options.h"

namespace swage::cli {

Command template_list_command(CLI::App& group, const CommonOptions& common);
Command template_show_command(CLI::App& group, const CommonOptions& common);
Command template_mesh_command(CLI::App& group, const CommonOptions& common);
Command template_fit_command(CLI::App& group, const CommonOptions& common);
Command template_edit_command(CLI::App& group, const CommonOptions& common);
Command template_retarget_command(CLI::App& group, const CommonOptions& common);
Command template_interpolate_command(CLI::App& group, const CommonOptions& common);

}  // namespace swage::cli

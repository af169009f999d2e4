#include "template.h"

#include "failure.h"

namespace swage::cli {

std::vector<Command> template_commands(CLI::App& program, const CommonOptions& common) {
  CLI::App* group = program.add_subcommand(
      "template", "Fits shapes with named parameters to meshes; the meshes follow the parameters");
  std::vector<Command> commands;
  for (const auto& make : {template_list_command, template_show_command, template_mesh_command, template_fit_command,
                           template_edit_command, template_retarget_command, template_interpolate_command}) {
    commands.push_back(make(*group, common));
  }
  const auto refuse = [] {
    throw WrongUsage("template: say what is to be done: list, show, mesh, fit, edit, retarget or interpolate");
  };
  commands.push_back({group, refuse});  // The last: one of those above was not asked for.
  return commands;
}

}  // namespace swage::cli

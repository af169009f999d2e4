// `swage template list` and `show`: what templates there are, and what their parameters are.
#include <spdlog/fmt/fmt.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>

#include "report_json.h"
#include "template.h"
#include "template_choice.h"
#include "template_report.h"

namespace swage::cli {
namespace {

void run_list(const std::string& json_path, const CommonOptions& common) {
  if (!json_path.empty()) check_can_be_written(json_path, "--json");
  apply(common);
  Json json = {{"command", "template list"}, {"version", SWAGE_VERSION}, {"templates", Json::array()}};
  std::string text;
  for (const std::string& name : shipped_templates()) {
    const Template of = shipped_template(name);
    json["templates"].push_back({{"name", name},
                                 {"parameters", of.parameters().size()},
                                 {"up", std::string(1, of.up())},
                                 {"description", of.description()}});
    text += fmt::format("{:<10} {:>3} parameters  {}\n", name, of.parameters().size(), of.description());
  }
  write_json(json_path, json);
  if (json_path != kStdout) write_stdout(text);
}

struct ShowJob {
  std::string name, json;
  bool text = false;
  SettingOptions settings;
};

Json parameters_json(const Template& of, const Eigen::VectorXd& values) {
  Json list = Json::array();
  for (size_t i = 0; i < of.parameters().size(); ++i) {
    const TemplateParameter& parameter = of.parameters()[i];
    list.push_back({{"name", parameter.name},
                    {"value", values[static_cast<Eigen::Index>(i)]},
                    {"default", parameter.value},
                    {"min", parameter.least},
                    {"max", parameter.most},
                    {"group", parameter.group},
                    {"description", parameter.description}});
  }
  return list;
}

void run_show(const ShowJob& job, const CommonOptions& common) {
  if (!job.json.empty()) check_can_be_written(job.json, "--json");
  apply(common);
  const Template of = template_named(job.name);
  const Settings settings(job.settings, of);
  settings.check_single();
  const Eigen::VectorXd values = settings.on(of.defaults());
  write_json(job.json, {{"command", "template show"},
                        {"version", SWAGE_VERSION},
                        {"template", job.name},
                        {"name", of.name()},
                        {"description", of.description()},
                        {"up", std::string(1, of.up())},
                        {"parameters", parameters_json(of, values)}});
  if (job.json == kStdout) return;
  if (job.text) return write_stdout(of.text());
  write_stdout(fmt::format("{}: {} {} is up.\n{}", of.name(), of.description(), of.up(), table_of(of, values)));
}

}  // namespace

Command template_list_command(CLI::App& group, const CommonOptions& common) {
  CLI::App* app = group.add_subcommand("list", "Lists the templates that come with the program");
  auto json = std::make_shared<std::string>();
  app->add_option("--json", *json, "The list as JSON; - for stdout, instead of the table")->type_name("FILE");
  return {app, [json, &common] { run_list(*json, common); }};
}

Command template_show_command(CLI::App& group, const CommonOptions& common) {
  CLI::App* app = group.add_subcommand("show", "Tells the parameters of a template, with their ranges");
  auto job = std::make_shared<ShowJob>();
  app->add_option("TEMPLATE", job->name, "A name in `swage template list`, or a template's file")
      ->type_name(kTemplateType)
      ->required();
  CLI::Option* const json =
      app->add_option("--json", job->json, "The parameters as JSON; - for stdout, instead of the table")
          ->type_name("FILE");
  app->add_flag("--text", job->text, "Print the template's file instead, to begin an own one with")->excludes(json);
  add_setting_options(*app, job->settings, "as they are by default");
  return {app, [job, &common] { run_show(*job, common); }};
}

}  // namespace swage::cli

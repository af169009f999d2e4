#include "template_choice.h"

#include <spdlog/fmt/fmt.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cmath>

#include "failure.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

constexpr const char* kHow = "write NAME=VALUE, NAME*=FACTOR or NAME+=STEP, such as width=1.2 or width*=2";

/// Of a list with commas between. Empty where one is no finite number.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : CLI::detail::split(text, ',')) {
    double number = 0;
    if (!CLI::detail::lexical_cast(CLI::detail::trim_copy(part), number) || !std::isfinite(number)) return {};
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

std::string number_words(double value) { return fmt::format("{:.6g}", value); }

CLI::Option* add_template_option(CLI::App& app, std::string& name, const std::string& otherwise) {
  return app.add_option("--template", name, "A name in `swage template list`, or a template's file" + otherwise)
      ->type_name(kTemplateType);
}

std::string file_of_template(const std::string& name) { return name.ends_with(".json") ? name : ""; }

Template template_named(const std::string& name) {
  if (name.ends_with(".json")) return read_template(name);
  try {
    return shipped_template(name);
  } catch (const InvalidInput& e) {
    throw WrongUsage(fmt::format("{}, or name a .json file", e.what()));
  }
}

std::vector<CLI::Option*> add_setting_options(CLI::App& app, SettingOptions& options, const std::string& rest) {
  const std::string group = "Parameters";
  CLI::Option* const set =
      app.add_option(
             "--set", options.texts,
             "Values of parameters, the others being " + rest +
                 ": name=value, or name*=factor or name+=step to change them; several are taken one after the other")
          ->group(group)
          ->type_name("NAME=VALUE");
  CLI::Option* const beyond =
      app.add_flag("--beyond", options.beyond, "Parameters may leave their bounds, where the template may look odd")
          ->group(group);
  return {set, beyond};
}

Settings::Settings(const SettingOptions& options, const Template& of) : beyond_(options.beyond) {
  const Setting* longest = nullptr;
  settings_.reserve(options.texts.size());
  for (const std::string& text : options.texts) {
    const Setting& setting = settings_.emplace_back(read(text, of));
    for (const double value : setting.values) {
      if (setting.change == '=') check(setting, value);
    }
    if (setting.values.size() == 1) continue;
    if (longest != nullptr && longest->values.size() != setting.values.size()) {
      throw WrongUsage(fmt::format("--set {}: {} values, but {} has {}: give each one value or as many", text,
                                   setting.values.size(), longest->text, longest->values.size()));
    }
    longest = &setting;
    count_ = setting.values.size();
  }
}

Settings::Setting Settings::read(const std::string& text, const Template& of) {
  const size_t equals = text.find('=');
  const char before = equals == std::string::npos || equals == 0 ? '=' : text[equals - 1];
  const char change = before == '*' || before == '+' ? before : '=';
  const std::string name =
      equals == std::string::npos ? "" : CLI::detail::trim_copy(text.substr(0, equals - (change == '=' ? 0 : 1)));
  if (name.empty()) throw WrongUsage(fmt::format("--set {}: {}", text, kHow));
  Setting setting{text, name, {}, 0, change, numbers_in(text.substr(equals + 1))};
  if (setting.values.empty()) {
    throw WrongUsage(fmt::format("--set {}: '{}' is no number: {}", text, text.substr(equals + 1), kHow));
  }
  try {
    setting.parameter = of.parameter(name);
  } catch (const InvalidInput& e) {
    throw WrongUsage(fmt::format("--set {}: {}", text, e.what()));
  }
  setting.bounds = of.parameters()[static_cast<size_t>(setting.parameter)];
  return setting;
}

void Settings::check_single() const {
  for (const Setting& setting : settings_) {
    if (setting.values.size() > 1) throw WrongUsage(fmt::format("--set {}: give one value here", setting.text));
  }
}

void Settings::check(const Setting& setting, double value) const {
  const auto& [name, group, description, usual, least, most] = setting.bounds;
  if (beyond_ || (value >= least && value <= most)) return;
  throw WrongUsage(fmt::format("--set {}: {} would be {}, and is from {} to {} (--beyond: let it leave them)",
                               setting.text, name, number_words(value), number_words(least), number_words(most)));
}

Eigen::VectorXd Settings::on(Eigen::VectorXd values, size_t result) const {
  for (const Setting& setting : settings_) {
    double& value = values[setting.parameter];
    const double by = setting.value_of(result);
    value = setting.change == '*' ? value * by : setting.change == '+' ? value + by : by;
    if (!std::isfinite(value)) {
      throw WrongUsage(
          fmt::format("--set {}: {} is no longer finite: give smaller values", setting.text, setting.name));
    }
  }
  for (const Setting& setting : settings_) check(setting, values[setting.parameter]);
  return values;
}

std::string Settings::words(size_t result) const {
  std::string text;
  for (const Setting& setting : settings_) {
    const std::string change = setting.change == '=' ? "" : std::string(1, setting.change);
    text +=
        fmt::format("{}{}{}={}", text.empty() ? "" : " ", setting.name, change, number_words(setting.value_of(result)));
  }
  return text;
}

}  // namespace swage::cli

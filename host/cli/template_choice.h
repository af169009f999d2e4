// Templates and their parameters, as the command line names them.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "swage/template.h"

namespace swage::cli {

inline constexpr const char* kTemplateType = "NAME|FILE.json";

/// One that comes with the program or, where the name ends in .json, that of a file. Throws WrongUsage where none is
/// called so, and as read_template() does.
Template template_named(const std::string& name);
/// --template
CLI::Option* add_template_option(CLI::App& app, std::string& name, const std::string& otherwise = "");
/// Empty where it comes with the program.
std::string file_of_template(const std::string& name);

struct SettingOptions {
  std::vector<std::string> texts;
  bool beyond = false;  ///< Whether parameters may leave their bounds.
};

/// --set and --beyond. `rest`: what is changed, in words.
std::vector<CLI::Option*> add_setting_options(CLI::App& app, SettingOptions& options, const std::string& rest);

/// What is set: name=value, name*=factor or name+=step, each after those before, with one value or one of each result.
class Settings {
 public:
  /// Throws WrongUsage, naming the text, where it is not understood, the template has no such parameter, a value is out
  /// of its bounds, or two have different numbers of values.
  Settings(const SettingOptions& options, const Template& of);

  bool any() const { return !settings_.empty(); }
  /// Of results, at least 1.
  size_t count() const { return count_; }
  /// Throws WrongUsage where there are several.
  void check_single() const;
  /// What `values` become. Throws WrongUsage where one leaves its bounds.
  Eigen::VectorXd on(Eigen::VectorXd values, size_t result = 0) const;
  /// "width=2 legs*=1.5", as it is for one result.
  std::string words(size_t result) const;

 private:
  struct Setting {
    std::string text, name;
    TemplateParameter bounds;
    Eigen::Index parameter;
    char change;  ///< =, * or +
    std::vector<double> values;

    double value_of(size_t result) const { return values[values.size() == 1 ? 0 : result]; }
  };
  static Setting read(const std::string& text, const Template& of);
  void check(const Setting& setting, double value) const;

  std::vector<Setting> settings_;
  size_t count_ = 1;
  bool beyond_;
};

/// "2" of 2.0, at most six digits.
std::string number_words(double value);

}  // namespace swage::cli

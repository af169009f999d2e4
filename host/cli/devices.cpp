#include <spdlog/fmt/fmt.h>

#include <memory>

#include "backend_choice.h"
#include "options.h"
#include "report_json.h"

namespace swage::cli {
namespace {

constexpr double kGiga = 1e9;

Json device_json(const Device& device, bool taken) {
  return {{"index", device.index},
          {"name", device.name},
          {"platform", device.platform},
          {"driver", device.driver},
          {"kind", device.kind},
          {"compute_units", device.compute_units},
          {"memory", device.memory},
          {"largest_buffer", device.largest_buffer},
          {"double", device.computes_twice},
          {"usable", device.missing.empty()},
          {"missing", device.missing},
          {"auto", taken}};
}

std::string device_line(const Device& device, bool taken) {
  std::string line = fmt::format(
      "{:>3} {} {}\n      {} {}, {}: {} compute units, {:.3g} GB, arrays up to {:.3g} GB, {}\n", device.index,
      taken ? '*' : ' ', device.name, device.platform, device.driver, device.kind, device.compute_units,
      static_cast<double>(device.memory) / kGiga, static_cast<double>(device.largest_buffer) / kGiga,
      device.computes_twice ? "float and double" : "float only");
  if (!device.missing.empty()) line += fmt::format("      cannot be used: {}\n", device.missing);
  return line;
}

std::string auto_line(const std::optional<Device>& taken) {
  if (!taken) return "auto takes the cpu backend: there is no GPU or accelerator that can be used\n";
  return fmt::format("* auto takes it for meshes of {} triangles or more\n", kElementsForDevice);
}

void run_devices(const std::string& json_path, const CommonOptions& common) {
  if (!json_path.empty()) check_can_be_written(json_path, "--json");
  apply(common);
  const std::optional<Device> taken = device_of_auto();
  Json json = {{"command", "devices"}, {"version", SWAGE_VERSION}, {"devices", Json::array()}};
  std::string text;
  for (const Device& device : opencl_devices()) {
    const bool is_taken = taken && taken->index == device.index;
    json["devices"].push_back(device_json(device, is_taken));
    text += device_line(device, is_taken);
  }
  json["auto"] = taken ? Json(taken->index) : Json(nullptr);
  json["auto_from_triangles"] = kElementsForDevice;
  if (text.empty()) text = "There is no OpenCL device.\n";
  write_json(json_path, json);
  if (json_path != kStdout) write_stdout(text + auto_line(taken));
}

}  // namespace

Command devices_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* app = program.add_subcommand("devices", "Lists the OpenCL devices, with the one that auto would take");
  auto json = std::make_shared<std::string>();
  app->add_option("--json", *json, "The list as JSON; - for stdout, instead of the table")->type_name("FILE");
  return {app, [json, &common] { run_devices(*json, common); }};
}

}  // namespace swage::cli

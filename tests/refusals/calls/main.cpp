// Prints what each call is refused with, as JSON.
#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "calls.h"
#include "swage/error.h"

namespace swage::test {
namespace {

std::pair<std::string, std::string> answer(const Call& call) {
  try {
    call.run();
  } catch (const InvalidInput& e) {
    return {"InvalidInput", e.what()};
  } catch (const UnreadableFile& e) {
    return {"UnreadableFile", e.what()};
  } catch (const UnwritableFile& e) {
    return {"UnwritableFile", e.what()};
  } catch (const Unsolvable& e) {
    return {"Unsolvable", e.what()};
  } catch (const Unavailable& e) {
    return {"Unavailable", e.what()};
  } catch (const std::exception& e) {
    return {"another exception", e.what()};
  }
  return {"", ""};
}

int run() {
  const std::vector<std::pair<const char*, std::vector<Call>>> areas = {
      {"Meshes", mesh_calls()},
      {"Files", file_calls()},
      {"Reshaping and deforming", edit_calls()},
      {"Stylizing", style_calls()},
      {"Resizing", resize_calls()},
      {"Templates", template_calls()},
      {"Remeshing, scaffolds, transfer and comparing", surface_calls()},
      {"Pictures", picture_calls()}};
  nlohmann::json table = nlohmann::json::array();
  int accepted = 0;
  for (const auto& [area, calls] : areas) {
    for (const Call& call : calls) {
      const auto [type, message] = answer(call);
      if (type.empty()) std::cerr << "not refused: " << call.text << '\n';
      accepted += type.empty() ? 1 : 0;
      table.push_back({{"area", area}, {"call", call.text}, {"type", type}, {"message", message}});
    }
  }
  std::cout << table.dump(1) << '\n';
  return accepted == 0 ? 0 : 1;
}

}  // namespace
}  // namespace swage::test

int main() { return swage::test::run(); }

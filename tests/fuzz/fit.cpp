// Fits of templates, as `swage template fit --json` writes them.
#include "fit_file.h"

#include "fuzz.h"

namespace swage::fuzz {

void use(std::string_view bytes) {
  const auto fit = unless_refused<UnreadableFile>([&] { return cli::read_fit(file_of(".json", bytes).string()); });
  if (!fit) return;
  cli::Json json = {{"vertices", fit->vertices}, {"triangles", fit->triangles}};
  cli::add_fit(json, "fuzzed", fit->of, fit->parameters, fit->pose);
  cli::add_document(json, fit->of);
  const cli::FitFile again = cli::read_fit(file_of(".json", json.dump()).string());
  again.check_is_of(fit->of, "fuzzed");
  require(again.parameters == fit->parameters && again.vertices == fit->vertices && again.triangles == fit->triangles,
          "a fit is kept");
  require(again.pose.scale == fit->pose.scale && again.pose.rotation == fit->pose.rotation &&
              again.pose.offset == fit->pose.offset,
          "and so is its pose");
}

}  // namespace swage::fuzz

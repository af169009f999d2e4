// One mesh as another is, by way of a template that fits both.
#include <string>

#include "swage/error.h"
#include "swage/template_edit.h"

namespace swage {
namespace {

/// `work` is this stretch of the whole.
ProgressFn stretch(const ProgressFn& progress, double begin, double end) {
  return [&progress, begin, end](Progress p) {
    p.fraction = begin + (end - begin) * p.fraction;
    return !progress || progress(p);
  };
}

template <typename Work>
auto naming(const char* mesh, const Work& work) {
  try {
    return work();
  } catch (const InvalidInput& error) {
    throw InvalidInput(std::string("retarget: ") + mesh + ": " + error.what());
  }
}

}  // namespace

RetargetResult retarget(const Template& of, const PositionsRef& source_positions, const TrianglesRef& source_triangles,
                        const PositionsRef& target_positions, const TrianglesRef& target_triangles,
                        const RetargetOptions& options, const ProgressFn& progress) {
  RetargetResult result;
  naming("target", [&] { check(target_positions, target_triangles); });
  result.edit.positions = source_positions;
  result.edit.report.stop = Termination::cancelled;
  result.source = naming("source", [&] {
    return fit_template(of, source_positions, source_triangles, options.source, stretch(progress, 0, 0.3));
  });
  if (result.source.report.stop == Termination::cancelled) return result;
  result.target = naming("target", [&] {
    return fit_template(of, target_positions, target_triangles, options.target, stretch(progress, 0.3, 0.6));
  });
  if (result.target.report.stop == Termination::cancelled) return result;
  const TemplatePose& pose = result.source.pose;
  result.edit = naming("source", [&] {
    TemplateEdit edit(of, result.source.parameters, pose, source_positions, source_triangles, options.edit);
    return edit.solve(result.target.parameters, stretch(progress, 0.6, 1));
  });
  result.edit.positions = result.target.pose.back(pose.into(result.edit.positions));
  return result;
}

}  // namespace swage

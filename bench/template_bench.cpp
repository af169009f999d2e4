// Templates: fields against an evaluation by Eigen's arrays, fits, and passes of an edit.
//
// `field/WHO/TEMPLATE`: values at 100,000 points; `instructions`: of the template's tape. `fit/TEMPLATE`: of its own
// surface. `follow/WHO/VERTICES`: a pass, as while a slider is dragged; `prepare_s`: once before.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bench_main.h"
#include "stopwatch.h"
#include "swage/template_edit.h"

namespace swage::bench {
namespace {

using Eigen::ArrayXd;

ArrayXd made(TapeOp op, const ArrayXd& a, const ArrayXd& b) {
  switch (op) {
    case TapeOp::add:
      return a + b;
    case TapeOp::subtract:
      return a - b;
    case TapeOp::multiply:
      return a * b;
    case TapeOp::divide:
      return a / b;
    case TapeOp::minimum:
      return a.min(b);
    case TapeOp::maximum:
      return a.max(b);
    case TapeOp::less:
      return (a < b).cast<double>();
    case TapeOp::negate:
      return -a;
    case TapeOp::absolute:
      return a.abs();
    case TapeOp::root:
      return a.max(0).sqrt();
    default:
      return a.binaryExpr(b, [op](double x, double y) { return value_of(op, x, y); });
  }
}

/// An array of all points for each instruction, one after the other: what one would write first.
ArrayXd by_arrays(const Tape& tape, const Eigen::VectorXd& parameters, const Positions& points) {
  std::vector<ArrayXd> slots;
  for (const double parameter : parameters) slots.push_back(ArrayXd::Constant(1, parameter));
  for (const double constant : tape.constants) slots.push_back(ArrayXd::Constant(1, constant));
  const auto run = [&](const TapeInstruction& one) {
    slots.push_back(made(one.op, slots[static_cast<size_t>(one.a)], slots[static_cast<size_t>(one.b)]));
  };
  std::for_each(tape.setup.begin(), tape.setup.end(), run);
  for (ArrayXd& uniform : slots) uniform = ArrayXd::Constant(points.rows(), uniform[0]).eval();
  for (int u = 0; u < 3; ++u) slots.emplace_back(points.col(u).array());
  std::for_each(tape.body.begin(), tape.body.end(), run);
  return slots[static_cast<size_t>(tape.root)];
}

void add_fields() {
  constexpr int kPoints = 100'000;
  for (const char* name : {"box", "couch", "airplane"}) {
    const Template of = shipped_template(name);
    const Positions points = 1.5 * Positions::Random(kPoints, 3);
    const auto count = [of](benchmark::State& state) {
      state.SetItemsProcessed(state.iterations() * kPoints);
      state.counters["instructions"] = static_cast<double>(of.tape().body.size());
    };
    add_benchmark(std::string("field/arrays/double/") + name, [=](benchmark::State& state) {
      for (auto _ : state) benchmark::DoNotOptimize(by_arrays(of.tape(), of.defaults(), points));
      count(state);
    });
    for (const NamedBackend& choice : named_backends()) {
      add_benchmark("field/" + choice.name + "/" + name, [=](benchmark::State& state) {
        const std::shared_ptr<Backend> backend = choice.backend();
        const std::unique_ptr<FieldStep> step = of.field(*backend);
        FieldValues field;
        step->evaluate(points, of.defaults(), FieldDerivatives::none, field);
        for (auto _ : state) step->evaluate(points, of.defaults(), FieldDerivatives::none, field);
        count(state);
      });
    }
  }
}

void add_fits() {
  for (const char* name : {"box", "couch", "chair", "vase"}) {
    add_benchmark(std::string("fit/") + name, [=](benchmark::State& state) {
      const Template of = shipped_template(name);
      const Mesh mesh = template_mesh(of, of.defaults(), {64, nullptr});
      for (auto _ : state) {
        const TemplateFit fit = fit_template(of, mesh.positions, mesh.triangles);
        state.counters["residual_percent"] = 100 * fit.residual;
      }
    });
  }
}

void add_follow(const NamedBackend& choice, const char* vertices, int resolution) {
  add_benchmark("follow/" + choice.name + "/" + vertices, [=](benchmark::State& state) {
    const Template couch = shipped_template("couch");
    const Mesh mesh = template_mesh(couch, couch.defaults(), {resolution, nullptr});
    TemplateEditOptions options;
    options.backend = choice.backend();
    TemplateEdit edit(couch, couch.defaults(), {}, mesh.positions, mesh.triangles, options);
    double prepare = 0;
    {
      const Stopwatch watch(prepare);
      edit.prepare();
    }
    Eigen::VectorXd target = couch.defaults();
    double& width = target[couch.parameter("width")];
    double by = 1.01;
    for (auto _ : state) {
      if (width > 3 || width < 1.5) by = 1 / by;
      width *= by;
      edit.follow(target);
    }
    state.counters["vertices"] = static_cast<double>(mesh.positions.rows());
    state.counters["prepare_s"] = prepare;
  });
}

}  // namespace

void register_all() {
  add_fields();
  add_fits();
  for (const NamedBackend& choice : named_backends()) {
    add_follow(choice, "8k", 56);
    add_follow(choice, "34k", 69);
    add_follow(choice, "138k", 170);
  }
}

}  // namespace swage::bench

// What template files say, and what is refused in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "swage/backend.h"
#include "swage/error.h"
#include "swage/template.h"

namespace swage::test {
namespace {

using testing::HasSubstr;

/// A template of these parameters and nodes; the last node is its root, and called so.
std::string file_of(const std::string& parameters, const std::string& nodes) {
  return R"({"version": 1, "name": "test", "up": "y", "parameters": [)" + parameters + R"(], "nodes": [)" + nodes +
         R"(], "root": "root"})";
}

constexpr const char* kSize = R"({"name": "size", "default": 2, "min": 1, "max": 4})";

double value_at(const Template& of, const Eigen::RowVector3d& point, const Eigen::VectorXd& parameters) {
  FieldValues field;
  cpu_backend()->field(of.tape())->evaluate(point, parameters, FieldDerivatives::none, field);
  return field.values[0];
}

double value_at(const std::string& nodes, const Eigen::RowVector3d& point, const std::string& parameters = kSize) {
  const Template made = parse_template(file_of(parameters, nodes), "test.json");
  return value_at(made, point, made.defaults());
}

/// The value of an expression of `size`, as the offset of a plane.
double expression(const std::string& text) {
  return -value_at(R"({"id": "root", "type": "plane", "normal": [0, 1, 0], "offset": ")" + text + R"("})", {0, 0, 0});
}

TEST(TemplateExpression, IsArithmeticAsWritten) {
  EXPECT_DOUBLE_EQ(expression("1 + size * 3 - 4 / size"), 5);
  EXPECT_DOUBLE_EQ(expression("(1 + size) * -(3 - 4)"), 3);
  EXPECT_DOUBLE_EQ(expression("8 / 4 / 2 - 3 - 1"), -3);
  EXPECT_DOUBLE_EQ(expression("--size"), 2);
  EXPECT_DOUBLE_EQ(expression("1.5e1 * .5"), 7.5);
  EXPECT_DOUBLE_EQ(expression("min(size, 1, 5) + max(size, 3)"), 4);
  EXPECT_DOUBLE_EQ(expression("abs(-size) + sqrt(size * 8)"), 6);
  EXPECT_DOUBLE_EQ(expression("sin(pi / 2) + cos(0) + tan(0) + exp(0)"), 3);
  EXPECT_NEAR(expression("atan2(size, size)"), std::numbers::pi / 4, 1e-15);
  EXPECT_DOUBLE_EQ(expression("clamp(size, 3, 5) + mix(1, 3, 0.25)"), 4.5);
  EXPECT_NEAR(expression("radians(180)"), std::numbers::pi, 1e-15);
}

std::string text_refusal(const std::string& text) {
  try {
    parse_template(text, "test.json");
  } catch (const UnreadableFile& error) {
    return error.what();
  }
  return "";
}

std::string refused_expression(const std::string& text) {
  return text_refusal(file_of(kSize, R"({"id": "root", "type": "sphere", "radius": ")" + text + R"("})"));
}

TEST(TemplateExpression, IsRefusedWithItsPlace) {
  EXPECT_THAT(refused_expression("size +"), HasSubstr("nodes[0].radius: 'size +': a number, a name or '('"));
  EXPECT_THAT(refused_expression("siz * 2"), HasSubstr("there is no parameter 'siz'"));
  EXPECT_THAT(refused_expression("size 2"), HasSubstr("at '2'"));
  EXPECT_THAT(refused_expression("(size"), HasSubstr("')' is expected"));
  EXPECT_THAT(refused_expression("min(size)"), HasSubstr("min takes 2 or more arguments, not 1"));
  EXPECT_THAT(refused_expression("sqrt(1, 2)"), HasSubstr("sqrt takes 1 arguments, not 2"));
  EXPECT_THAT(refused_expression("1 / (size - 2)"), HasSubstr("is not finite by default"));
  EXPECT_THAT(refused_expression(""), HasSubstr("at the end"));
  EXPECT_THAT(refused_expression(std::string(1000, '(')), HasSubstr("nested too deep"));
  EXPECT_THAT(refused_expression("1e999"), HasSubstr("number"));
}

TEST(TemplateFile, IsRefusedWithPathAndRemedy) {
  const std::string sphere = R"({"id": "root", "type": "sphere", "radius": 1})";
  EXPECT_EQ(text_refusal(file_of(kSize, sphere)), "");
  EXPECT_THAT(text_refusal("{"), HasSubstr("test.json: line 1: not valid JSON"));
  EXPECT_THAT(text_refusal("[]"), HasSubstr("an object in braces is expected"));
  EXPECT_THAT(text_refusal(R"({"version": 2})"), HasSubstr("version: a whole number from 1 to 1"));
  EXPECT_THAT(text_refusal(R"({"version": 1, "version": 1})"), HasSubstr("there twice"));
  EXPECT_THAT(text_refusal(R"({"version": 1, "name": "n"})"), HasSubstr("'parameters' is missing"));
  const auto with = [&](const std::string& parameters, const std::string& nodes) {
    return text_refusal(file_of(parameters, nodes));
  };
  EXPECT_THAT(with(kSize, R"({"id": "root", "type": "spere", "radius": 1})"), HasSubstr("nodes[0].type: 'spere'"));
  EXPECT_THAT(with(kSize, R"({"id": "root", "type": "sphere"})"), HasSubstr("'radius' is missing"));
  EXPECT_THAT(with(kSize, R"({"id": "root", "type": "sphere", "radius": 1, "colour": 2})"),
              HasSubstr("nodes[0].colour: is not known here"));
  EXPECT_THAT(with(kSize, R"({"id": "root", "type": "sphere", "radius": -1})"), HasSubstr("is not above 0"));
  EXPECT_THAT(with(kSize, R"({"id": "root", "type": "sphere", "radius": null})"), HasSubstr("not null"));
  EXPECT_THAT(with(kSize, R"({"id": "root", "type": "box", "size": [1, 2]})"), HasSubstr("size: 3 entries"));
  EXPECT_THAT(with(kSize, R"({"id": "root", "type": "shell", "of": "root", "thickness": 1})"),
              HasSubstr("refers back to itself"));
  EXPECT_THAT(with(kSize, R"({"id": "root", "type": "shell", "of": "leg", "thickness": 1})"),
              HasSubstr("there is no node \"leg\""));
  EXPECT_THAT(with(kSize, sphere + "," + sphere), HasSubstr("nodes[1].id: 'root' is there twice"));
  EXPECT_THAT(with(kSize, R"({"id": "idle", "type": "sphere", "radius": 1}, )" + sphere),
              HasSubstr("nodes[0]: nothing refers to it"));
  EXPECT_THAT(with(std::string(kSize) + "," + kSize, sphere), HasSubstr("parameters[1].name: 'size' is there twice"));
  EXPECT_THAT(with(R"({"name": "2size", "default": 2, "min": 1, "max": 4})", sphere), HasSubstr("is no name"));
  EXPECT_THAT(with(R"({"name": "min", "default": 2, "min": 1, "max": 4})", sphere), HasSubstr("is no name"));
  EXPECT_THAT(with(R"({"name": "size", "default": 5, "min": 1, "max": 4})", sphere),
              HasSubstr("parameters[0].default: is not between min and max"));
  EXPECT_THAT(with(R"({"name": "size", "default": 1, "min": 1, "max": 1})", sphere), HasSubstr("is not below max"));
  EXPECT_THAT(with(kSize, R"({"id": "flat", "type": "circle", "radius": 1},
                             {"id": "root", "type": "rotate", "of": "flat", "direction": [0, 1, 0], "angle": 1})"),
              HasSubstr("is flat"));
  EXPECT_THAT(with(kSize, R"({"id": "ball", "type": "sphere", "radius": 1},
                             {"id": "root", "type": "extrude", "of": "ball", "height": 1})"),
              HasSubstr("a flat shape is expected"));
}

/// Copies of copies of copies end in words, not in memory.
TEST(TemplateFile, IsRefusedWhereItIsTooLarge) {
  std::string nodes = R"({"id": "n0", "type": "sphere", "radius": 1})";
  for (int i = 1; i <= 4; ++i) {
    nodes += R"(, {"id": ")" + (i == 4 ? std::string("root") : "n" + std::to_string(i)) +
             R"(", "type": "repeat", "of": "n)" + std::to_string(i - 1) + R"(", "count": 64, "spacing": )" +
             std::to_string(i) + "}";
  }
  EXPECT_THAT(text_refusal(file_of(kSize, nodes)), HasSubstr("too large"));
}

/// Numbers are too many to be kept as well.
TEST(TemplateFile, IsRefusedWhereItHasTooManyNumbers) {
  std::string nodes, ids;
  for (int i = 0; i < 120; ++i) {
    std::string corners;
    for (int c = 0; c < 250; ++c) {
      const int number = 2 * (250 * i + c);
      corners += (c > 0 ? ", [" : "[") + std::to_string(number) + ", " + std::to_string(number + 1) + "]";
    }
    const std::string id = "\"n" + std::to_string(i) + "\"";
    nodes += R"({"id": )" + id + R"(, "type": "polygon", "corners": [)" + corners + "]}, ";
    ids += (i > 0 ? ", " : "") + id;
  }
  nodes += R"({"id": "flat", "type": "union", "of": [)" + ids + "]}, ";
  EXPECT_THAT(text_refusal(file_of(kSize, nodes + R"({"id": "root", "type": "extrude", "of": "flat", "height": 1})")),
              HasSubstr("nodes: the template is too large"));
}

/// Twice as many terms with each mix: they are counted once.
TEST(TemplateExpression, MayBeNestedInItself) {
  std::string text = "size";
  for (int i = 0; i < 90; ++i) text = "mix(" + text + ", 0, 0.5)";
  EXPECT_DOUBLE_EQ(expression(text), std::ldexp(2, -90));
}

/// What calls itself for what is nested must not run out of stack.
TEST(TemplateFile, IsRefusedWhereItIsTooDeep) {
  const std::string brackets = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  EXPECT_THAT(text_refusal(R"({"version": )" + brackets + "}"), HasSubstr("nested too deep"));
  const auto chain = [](int count, int first) {
    std::string nodes;
    for (int i = first; i < first + count; ++i) {
      nodes += R"({"id": "n)" + std::to_string(i) + R"(", "type": "offset", "by": 1, "of": "n)" +
               std::to_string(i - 1) + R"("}, )";
    }
    return nodes;
  };
  const std::string ball = R"({"id": "n0", "type": "sphere", "radius": 1}, )";
  const auto root = [](const std::string& of) { return R"({"id": "root", "type": "union", "of": [)" + of + "]}"; };
  EXPECT_EQ(text_refusal(file_of(kSize, ball + chain(200, 1) + root("\"n200\""))), "");
  EXPECT_THAT(text_refusal(file_of(kSize, ball + chain(4000, 1) + root("\"n4000\""))),
              HasSubstr("one within the other"));
  // Each not deep beyond what is known already.
  EXPECT_THAT(text_refusal(file_of(kSize, ball + chain(400, 1) + root("\"n200\", \"n400\""))),
              HasSubstr("one within the other"));
}

TEST(TemplateFile, ComesBackAsItWas) {
  for (const std::string& name : shipped_templates()) {
    const Template made = shipped_template(name);
    const Template again = parse_template(made.text(), name);
    EXPECT_EQ(again.text(), made.text());
    EXPECT_EQ(again.tape().body.size(), made.tape().body.size());
    EXPECT_EQ(again.defaults(), made.defaults());
  }
}

TEST(Template, NamesItsParameters) {
  const Template couch = shipped_template("couch");
  EXPECT_EQ(couch.parameters()[static_cast<size_t>(couch.parameter("arm_width"))].name, "arm_width");
  try {
    couch.parameter("armwidth");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("armwidth"), HasSubstr("arm_width")));
  }
  EXPECT_THROW(shipped_template("spaceship"), InvalidInput);
}

TEST(Template, AVaseThatIsNotHollowIsSolidToItsAxis) {
  const Template vase = shipped_template("vase");
  Eigen::VectorXd parameters = vase.defaults();
  parameters[vase.parameter("hollow")] = 0;
  for (const double height : {0.1, 0.5, 0.9}) EXPECT_LT(value_at(vase, {0, height, 0}, parameters), -0.09) << height;
}

/// Of each node type the field at a point, in closed form.
TEST(TemplateNodes, HaveTheirFields) {
  const auto at = [](const std::string& node, double x, double y, double z) {
    return value_at(R"({"id": "root", )" + node + "}", {x, y, z});
  };
  EXPECT_DOUBLE_EQ(at(R"("type": "sphere", "radius": "size")", 3, 4, 0), 3);
  EXPECT_DOUBLE_EQ(at(R"("type": "ellipsoid", "radii": [1, 2, 3])", 0, 0, 3), 0);
  EXPECT_DOUBLE_EQ(at(R"("type": "box", "size": [2, 4, 6])", 4, 2, 7), 5);
  EXPECT_DOUBLE_EQ(at(R"("type": "box", "size": [2, 4, 6])", 0, 1.5, 0), -0.5);
  EXPECT_NEAR(at(R"("type": "box", "size": [2, 2, 2], "rounding": 0.5)", 1, 1, 0), 0.5 * std::sqrt(2) - 0.5, 1e-15);
  EXPECT_DOUBLE_EQ(at(R"("type": "cylinder", "radius": 1, "height": 2)", 4, 5, 0), 5);
  EXPECT_DOUBLE_EQ(at(R"("type": "cylinder", "axis": "z", "radius": 1, "height": 2)", 0, 3, 0), 2);
  EXPECT_DOUBLE_EQ(at(R"("type": "capsule", "from": [0, 0, 0], "to": [0, 2, 0], "radius": 1)", 0, 6, 3), 4);
  EXPECT_DOUBLE_EQ(at(R"("type": "cone", "bottom": 2, "top": 0, "height": 2)", 1, 0, 0), 0);
  EXPECT_DOUBLE_EQ(at(R"("type": "torus", "radius": 2, "tube": 0.5)", 2, 1, 0), 0.5);
  EXPECT_DOUBLE_EQ(at(R"("type": "plane", "normal": [0, 2, 0], "offset": 1)", 5, 3, 5), 2);
  EXPECT_DOUBLE_EQ(at(R"("type": "lathe", "heights": [0, 1, 2], "radii": [1, 3, 1])", 2, 0.5, 0), 0);
}

/// With a ball, or a disc, of radius 1 to work on.
double worked(const std::string& node, const Eigen::RowVector3d& at, const std::string& more = "") {
  return value_at(R"({"id": "ball", "type": "sphere", "radius": 1}, )" + more + R"({"id": "root", )" + node + "}", at);
}

TEST(TemplateNodes, CombineAndMove) {
  const std::string other = R"({"id": "far", "type": "translate", "of": "ball", "by": [3, 0, 0]}, )";
  EXPECT_DOUBLE_EQ(worked(R"("type": "union", "of": ["ball", "far"])", {1.5, 0, 0}, other), 0.5);
  EXPECT_DOUBLE_EQ(worked(R"("type": "intersection", "of": ["ball", "far"])", {1.5, 0, 0}, other), 0.5);
  EXPECT_DOUBLE_EQ(worked(R"("type": "difference", "of": ["ball", "far"])", {2.5, 0, 0}, other), 1.5);
  // Half way between two, a fillet takes a quarter of its width, four radii: the whole radius.
  EXPECT_DOUBLE_EQ(worked(R"("type": "union", "of": ["ball", "far"], "radius": 0.25)", {1.5, 0, 0}, other), 0.25);
  EXPECT_DOUBLE_EQ(worked(R"("type": "morph", "of": ["ball", "far"], "weight": 0.25)", {0, 0, 0}, other), -0.25);
  EXPECT_DOUBLE_EQ(worked(R"("type": "shell", "of": "ball", "thickness": 0.5)", {0.5, 0, 0}), 0.25);
  EXPECT_DOUBLE_EQ(worked(R"("type": "offset", "of": "ball", "by": 0.5)", {2, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(worked(R"("type": "translate", "of": "ball", "by": ["size", 0, 0])", {2, 0, 3}), 2);
  EXPECT_DOUBLE_EQ(worked(R"("type": "scale", "of": "ball", "by": [2, 2, 2])", {4, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(worked(R"("type": "mirror", "of": "far", "axis": "x")", {-3, 0, 2}, other), 1);
  EXPECT_DOUBLE_EQ(worked(R"("type": "repeat", "of": "ball", "axis": "z", "count": 2, "spacing": 4)", {0, 0, 5}), 2);
  EXPECT_NEAR(worked(R"("type": "repeat_around", "of": "far", "count": 4)", {0, 0, 3}, other), -1, 1e-12);
  EXPECT_NEAR(worked(R"("type": "rotate", "of": "far", "direction": [0, 0, 1], "angle": 90)", {0, 3, 0}, other), -1,
              1e-12);
  EXPECT_NEAR(worked(R"("type": "twist", "of": "far", "rate": 45)", {0, 2, -3}, other), 1, 1e-12);
  EXPECT_DOUBLE_EQ(worked(R"("type": "shear", "of": "ball", "axis": "x", "along": "y", "amount": 2)", {2, 1, 0}), 0);
  EXPECT_DOUBLE_EQ(worked(R"("type": "taper", "of": "ball", "from": -1, "to": 1, "bottom": 1, "top": 3)", {2, 0, 0}),
                   0);
}

TEST(TemplateNodes, MakeBodiesOfFlatShapes) {
  const auto flat = [](const std::string& node, const std::string& body, const Eigen::RowVector3d& at) {
    return value_at(R"({"id": "flat", )" + node + R"(}, {"id": "root", "of": "flat", )" + body + "}", at);
  };
  const std::string extruded = R"("type": "extrude", "axis": "z", "height": 2)";
  EXPECT_DOUBLE_EQ(flat(R"("type": "circle", "radius": 1)", extruded, {4, 0, 5}), 5);
  EXPECT_DOUBLE_EQ(flat(R"("type": "rectangle", "width": 2, "height": 4)", extruded, {3, 0, 0}), 2);
  const std::string corner = R"("type": "polygon", "corners": [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]])";
  EXPECT_DOUBLE_EQ(flat(corner, extruded, {0.5, 1.75, 0}), -0.25);
  EXPECT_NEAR(flat(corner, extruded, {1.5, 1.5, 0}), 0.5, 1e-12);
  EXPECT_NEAR(flat(corner, extruded, {1.75, 0.5, 0}), -0.25, 1e-12);
  EXPECT_DOUBLE_EQ(flat(R"("type": "circle", "radius": 1)", R"("type": "revolve", "offset": 3)", {0, 0, 5}), 1);
}

}  // namespace
}  // namespace swage::test

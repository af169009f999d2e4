// The published schema against the reader: the same types and keys, needed and not. tests/templates/schema_test.py asks
// a validator about whole files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "swage/error.h"
#include "swage/template.h"

namespace swage::test {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

using Names = std::set<std::string>;

const Json& schema() {
  static const Json kSchema = Json::parse(std::ifstream(SWAGE_TEMPLATE_SCHEMA));
  return kSchema;
}

Names keys_of(const Json& object) {
  Names names;
  for (const auto& [key, value] : object.items()) names.insert(key);
  return names;
}

std::string schema_refusal(const Json& document) {
  try {
    parse_template(document.dump(), "test.json");
  } catch (const UnreadableFile& error) {
    return error.what();
  }
  return "";
}

/// What an error lists between two of its words.
Names listed_in(const std::string& error, const std::string& before, const std::string& after) {
  const size_t begin = error.find(before) + before.size();
  std::string list = error.substr(begin, after.empty() ? std::string::npos : error.find(after, begin) - begin);
  std::erase(list, ' ');
  Names names;
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) names.insert(word);
  return names;
}

bool is_flat(const std::string& type) { return Names{"circle", "rectangle", "polygon"}.contains(type); }

/// Something that the schema allows, by its definition.
Json example(const std::string& type, const std::string& key, const Json& what) {
  if (key == "of" && what.contains("$ref")) return type == "extrude" || type == "revolve" ? "flat" : "ball";
  if (key == "of") return {"ball", "ball"};
  if (key == "corners") return {{0, 0}, {1, 0}, {0, 1}};
  if (key == "heights" || key == "radii") {
    return type == "ellipsoid" ? Json{1, 2, 3} : Json{0.5, 1.5};
  }
  if (key == "count") return 2;
  const std::string reference = what.at("$ref");
  if (reference == "#/$defs/axis") return key == "axis" ? "x" : "z";
  if (reference == "#/$defs/point" || reference == "#/$defs/sizes") return {1, 2, "size"};
  return "size / 4";
}

Json example(const std::string& type) {
  Json node = {{"id", "asked"}, {"type", type}};
  for (const auto& [key, what] : schema()["$defs"]["nodes"][type]["properties"].items()) {
    if (key != "id" && key != "type") node[key] = example(type, key, what);
  }
  return node;
}

/// A template of the node; it has what the node may refer to.
Json document_of(const Json& node) {
  const bool flat = is_flat(node.value("type", ""));
  Json nodes = {{{"id", "ball"}, {"type", "sphere"}, {"radius", 1}},
                {{"id", "flat"}, {"type", "circle"}, {"radius", 1}},
                {{"id", "disc"}, {"type", "extrude"}, {"of", "flat"}, {"height", 1}},
                node};
  if (flat) nodes.push_back({{"id", "body"}, {"type", "extrude"}, {"of", "asked"}, {"height", 1}});
  nodes.push_back({{"id", "all"}, {"type", "union"}, {"of", {"ball", "disc", flat ? "body" : "asked"}}});
  return {
      {"version", 1},
      {"name", "test"},
      {"description", "A test."},
      {"up", "z"},
      {"parameters",
       {{{"name", "size"}, {"default", 2}, {"min", 1}, {"max", 4}, {"group", "sizes"}, {"description", "Of all."}}}},
      {"nodes", nodes},
      {"root", "all"}};
}

/// The object has what the schema lists, and is refused with a key beyond, without one that is needed, and not without
/// another.
void expect_keys(const Json& described, const Json& object, const std::function<Json(const Json&)>& document) {
  EXPECT_EQ(schema_refusal(document(object)), "");
  EXPECT_EQ(keys_of(object), keys_of(described["properties"]));
  Json more = object;
  more["unheard_of"] = 1;
  EXPECT_EQ(listed_in(schema_refusal(document(more)), "known are ", ";"), keys_of(described["properties"]));
  const Names needed = described["required"].get<Names>();
  for (const std::string& key : keys_of(object)) {
    Json less = object;
    less.erase(key);
    if (needed.contains(key)) {
      EXPECT_THAT(schema_refusal(document(less)), HasSubstr("'" + key + "' is missing"));
    } else {
      EXPECT_EQ(schema_refusal(document(less)), "") << key;
    }
  }
}

TEST(TemplateSchema, HasTheTypesOfTheReader) {
  const Json& node = schema()["$defs"]["node"];
  const Names types = node["properties"]["type"]["enum"].get<Names>();
  EXPECT_EQ(listed_in(schema_refusal(document_of({{"id", "asked"}, {"type", "unheard_of"}})), "is none of ", ""),
            types);
  EXPECT_EQ(keys_of(schema()["$defs"]["nodes"]), types);
  Names told;
  for (const Json& one : node["allOf"]) {
    const std::string type = one["if"]["properties"]["type"]["const"];
    EXPECT_EQ(one["then"]["$ref"], "#/$defs/nodes/" + type);
    told.insert(type);
  }
  EXPECT_EQ(told, types);
}

TEST(TemplateSchema, HasTheKeysOfTheReader) {
  for (const std::string& type : keys_of(schema()["$defs"]["nodes"])) {
    SCOPED_TRACE(type);
    Json described = schema()["$defs"]["nodes"][type];
    described["required"].insert(described["required"].end(), {"id", "type"});
    expect_keys(described, example(type), document_of);
  }
  const Json document = document_of(example("sphere"));
  expect_keys(schema(), document, [](const Json& whole) { return whole; });
  expect_keys(schema()["$defs"]["parameter"], document["parameters"][0], [&](const Json& parameter) {
    Json whole = document;
    whole["parameters"].push_back(parameter);
    whole["parameters"].erase(0);
    return whole;
  });
}

/// Those that the validator refuses too.
TEST(TemplateSchema, RefusesWhatTheReaderRefuses) {
  const Json broken = Json::parse(std::ifstream(SWAGE_BROKEN_TEMPLATES));
  EXPECT_GT(broken.size(), 10);
  for (const Json& one : broken) EXPECT_NE(schema_refusal(one["template"]), "") << one["why"];
}

}  // namespace
}  // namespace swage::test

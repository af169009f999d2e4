#include "templating.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace swage::test {

using nlohmann::json;

Templating::Templating() { write_text(model_, box_obj()); }

Outcome Templating::ask(Arguments arguments) const {
  arguments.insert(arguments.begin(), "template");
  arguments.emplace_back("--quiet");
  return run(arguments);
}

std::string Templating::out_of(const Arguments& arguments) const {
  const Outcome outcome = ask(arguments);
  EXPECT_EQ(outcome.code, 0) << testing::PrintToString(arguments) << '\n' << outcome.err;
  return outcome.out;
}

json Templating::report(Arguments arguments) const {
  arguments.insert(arguments.end(), {"--json", "-"});
  const Outcome outcome = ask(arguments);
  EXPECT_EQ(outcome.code, 0) << testing::PrintToString(arguments) << '\n' << outcome.err;
  return outcome.code == 0 ? json::parse(outcome.out) : json();
}

void Templating::expect(int code, const std::string& says, const Arguments& arguments) const {
  SCOPED_TRACE(testing::PrintToString(arguments));
  const std::vector<std::string> before = names_in(folder_.path());
  const std::string model = read_text(model_);
  const Outcome outcome = ask(arguments);
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_THAT(outcome.err, testing::StartsWith("swage: error: "));
  EXPECT_THAT(outcome.err, testing::HasSubstr(says));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(names_in(folder_.path()), before);
  EXPECT_TRUE(read_text(model_) == model);
}

void expect_keys(const json& told, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    EXPECT_TRUE(told.contains(key)) << key;
    EXPECT_FALSE(told.value(key, json()).is_null()) << key;
  }
}

}  // namespace swage::test

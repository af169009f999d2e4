// Straight chains: found by `swage reshape` and written by `swage info`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"
#include "swage/handles.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A box of sides 1, 1 and 2, its sides of three edges each.
class Straight : public testing::Test {
 protected:
  void SetUp() override { write_text(box_, box_obj()); }

  static Outcome run_with(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  Outcome reshape(const Arguments& more) const {
    return run_with({"reshape", box_.string(), "--pin", "z<=0", "--move", "z>=2&x<=0=0,0,0.5", "--remesh", "never"},
                    more);
  }
  Outcome info(const Arguments& more) const { return run_with({"info", box_.string()}, more); }

  int chains_with(Arguments options) const {
    options.insert(options.end(), {"--json", "-"});
    const Outcome outcome = reshape(options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(outcome.out)["straight_chains"];
  }

  void expect_refused(int code, const Outcome& outcome, const std::string& says) const {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_THAT(outcome.err, testing::StartsWith("swage: error: "));
    EXPECT_THAT(outcome.err, HasSubstr(says));
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(names_in(folder_.path()), std::vector<std::string>{"box.obj"});
  }

  TempFolder folder_;
  std::filesystem::path box_ = folder_ / "box.obj";
  std::string chains_ = (folder_ / "box.straight").string();
};

TEST_F(Straight, ChainsAreFoundWhereAsked) {
  EXPECT_EQ(chains_with({"--straight", "auto"}), 12);
  EXPECT_EQ(chains_with({"--straight", "none"}), 0);
  EXPECT_EQ(chains_with({}), 0);
}

TEST_F(Straight, ChainsAreFoundByAngleAndLength) {
  EXPECT_EQ(chains_with({"--straight", "auto", "--straight-angle", "89"}), 0);
  EXPECT_EQ(chains_with({"--straight", "auto", "--straight-angle", "91"}), 12);
  // The diagonal is the root of 6.
  EXPECT_EQ(chains_with({"--straight", "auto", "--straight-shortest", "0.4"}), 12);
  EXPECT_EQ(chains_with({"--straight", "auto", "--straight-shortest", "0.5"}), 4);
  EXPECT_EQ(chains_with({"--straight", "auto", "--straight-shortest", "0.9"}), 0);
}

TEST_F(Straight, ChainsWrittenDoWhatThoseFoundDo) {
  const Outcome outcome = info({"--straight", chains_});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("vertices")) << "the facts are told all the same";
  const Mesh mesh = read_mesh(box_).mesh;
  EXPECT_EQ(read_straight_chains(chains_, static_cast<int>(mesh.positions.rows())).size(), 12U);
  EXPECT_EQ(chains_with({"--straight", chains_}), 12);
  const Outcome found = reshape({"-o", "-", "--straight", "auto"}), read = reshape({"-o", "-", "--straight", chains_});
  EXPECT_EQ(found.out, read.out);
  EXPECT_NE(found.out, reshape({"-o", "-"}).out);
}

TEST_F(Straight, InfoFindsByAngleAndLength) {
  EXPECT_EQ(info({"--straight", chains_, "--straight-shortest", "0.5"}).code, 0);
  EXPECT_EQ(read_straight_chains(chains_, 56).size(), 4U);
  EXPECT_EQ(info({"--straight", chains_, "--straight-angle", "89"}).code, 0);
  EXPECT_EQ(read_text(chains_), "");
}

TEST_F(Straight, WrongUsageExitsWith2) {
  const std::string out = (folder_ / "out.obj").string();
  expect_refused(2, reshape({"-o", out, "--straight-angle", "150"}), "--straight");
  expect_refused(2, reshape({"-o", out, "--straight", "none", "--straight-angle", "150"}), "--straight auto");
  expect_refused(2, reshape({"-o", out, "--straight", "x.straight", "--straight-shortest", "1"}), "--straight auto");
  for (const char* bad : {"-1", "181", "nan", "x"}) {
    expect_refused(2, reshape({"-o", out, "--straight", "auto", "--straight-angle", bad}), "--straight-angle");
    expect_refused(2, info({"--straight", chains_, "--straight-angle", bad}), "--straight-angle");
  }
  for (const char* bad : {"-0.1", "1.5", "short"}) {
    expect_refused(2, reshape({"-o", out, "--straight", "auto", "--straight-shortest", bad}), "--straight-shortest");
  }
  expect_refused(2, info({"--straight-angle", "150"}), "--straight");
  expect_refused(2, info({"--straight", "-"}), "name a file");
  expect_refused(2, info({"--straight", chains_, "--json", chains_}), "both name");
  expect_refused(2, info({"--straight", (folder_ / "missing" / "a").string()}), "there is no folder");
}

TEST_F(Straight, AMissingOrForeignFileExitsWith3) {
  const std::string out = (folder_ / "out.obj").string();
  expect_refused(3, reshape({"-o", out, "--straight", chains_}), chains_);
  write_text(chains_, "0 1 99");
  EXPECT_EQ(reshape({"-o", out, "--straight", chains_}).code, 3);
  EXPECT_THAT(reshape({"-o", out, "--straight", chains_}).err, HasSubstr("vertex 99 is not there"));
}

}  // namespace
}  // namespace swage::test

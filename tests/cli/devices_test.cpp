// The list of devices, and which backend a run takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "opencl_device.h"
#include "program.h"
#include "shapes.h"
#include "swage/backend.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class OnDevices : public testing::Test {
 protected:
  void SetUp() override {
    if (!opencl_or_skip(Precision::single)) return;
    write_text(folder_ / "box.obj", box_obj());
    first_ = opencl_devices().front();
  }

  Outcome reshape(const Arguments& more, const std::vector<std::string>& environment = {}) const {
    Arguments arguments{"reshape", (folder_ / "box.obj").string(), "--pin", "0", "--move", "55=0.1,0,0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments, environment);
  }

  json report(Arguments more, const std::vector<std::string>& environment = {}) const {
    more.insert(more.end(), {"--json", "-"});
    const Outcome outcome = reshape(more, environment);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(outcome.out, nullptr, false);
  }

  TempFolder folder_;
  Device first_;
};

TEST_F(OnDevices, AreListed) {
  const Outcome outcome = run({"devices"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr(first_.name));
  EXPECT_THAT(outcome.out, HasSubstr("auto takes"));
}

TEST_F(OnDevices, AreListedAsJson) {
  const json list = json::parse(run({"devices", "--json", "-"}).out);
  ASSERT_EQ(list["devices"].size(), opencl_devices().size());
  const json& device = list["devices"][0];
  EXPECT_EQ(device["name"], first_.name);
  EXPECT_EQ(device["driver"], first_.driver);
  EXPECT_EQ(device["kind"], first_.kind);
  EXPECT_EQ(device["compute_units"], first_.compute_units);
  EXPECT_EQ(device["double"], first_.computes_twice);
  EXPECT_EQ(device["usable"], first_.missing.empty());
}

TEST_F(OnDevices, AutoMarksNoCpuDeviceUnlessNamed) {
  const json told = json::parse(run({"devices", "--json", "-"}).out);
  for (const json& device : told.at("devices")) {
    EXPECT_FALSE(device["kind"] == "cpu" && device["auto"]) << device;
  }
  EXPECT_EQ(json::parse(run({"devices", "--json", "-"}, {"SWAGE_DEVICE=0"}).out)["auto"], 0);
}

TEST_F(OnDevices, NoPlatformIsNoError) {
  const Outcome outcome = run({"devices"}, {"OCL_ICD_VENDORS=/nonexistent"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("no OpenCL device"));
}

TEST_F(OnDevices, AHomeThatCannotBeWrittenHidesNone) {
  const json list = json::parse(run({"devices", "--json", "-"}, {"HOME=/proc/nowhere"}).out);
  EXPECT_EQ(list["devices"].size(), opencl_devices().size());
}

TEST_F(OnDevices, WithoutAnyOpenClIsRefusedAndAutoIsNot) {
  const Outcome asked = reshape({"--backend", "opencl", "--json", "-"}, {"OCL_ICD_VENDORS=/nonexistent"});
  EXPECT_EQ(asked.code, 4);
  EXPECT_THAT(asked.err, HasSubstr("no OpenCL device"));
  EXPECT_EQ(report({}, {"OCL_ICD_VENDORS=/nonexistent"})["backend"], "cpu");
}

TEST_F(OnDevices, OpenClIsTakenWhereAskedFor) {
  EXPECT_EQ(report({"--backend", "opencl"})["backend"], "opencl");
  EXPECT_EQ(report({"--device", "0"})["device"], first_.name);
  EXPECT_EQ(report({}, {"SWAGE_BACKEND=opencl"})["backend"], "opencl");
  EXPECT_EQ(report({"--backend", "opencl"}, {"SWAGE_DEVICE=0"})["device"], first_.name);
  EXPECT_EQ(report({"--backend", "cpu"}, {"SWAGE_DEVICE=0"})["backend"], "cpu");
}

TEST_F(OnDevices, PrecisionIsTheDevicesBestUnlessAskedFor) {
  EXPECT_EQ(report({"--backend", "opencl"})["precision"], first_.computes_twice ? "double" : "single");
  EXPECT_EQ(report({"--backend", "opencl", "--precision", "single"})["precision"], "single");
  EXPECT_EQ(report({"--backend", "cpu", "--precision", "double"})["precision"], "double");
}

TEST_F(OnDevices, APrecisionThatCannotBeIsRefused) {
  const Outcome outcome = reshape({"--backend", "cpu", "--precision", "single", "--json", "-"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the cpu backend computes in double"));
  EXPECT_EQ(reshape({"--precision", "half", "--json", "-"}).code, 2);
}

TEST_F(OnDevices, SmallMeshesStayOnTheCpu) {
  EXPECT_EQ(report({}, {"SWAGE_DEVICE=0"})["backend"], "cpu");
  EXPECT_EQ(report({"--backend", "auto"})["backend"], "cpu");
}

TEST_F(OnDevices, AWrongNameIsToldWhatThereIs) {
  const Outcome outcome = reshape({"--device", "abacus", "-o", (folder_ / "r.obj").string()});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("abacus"));
  EXPECT_THAT(outcome.err, HasSubstr(first_.name));
}

/// What a run says whose mesh is large, and all on a line: it ends before anything is solved.
std::string words_of_large_run(const TempFolder& folder, const std::vector<std::string>& environment) {
  const std::filesystem::path path = folder / "large.ply";
  Mesh line = sheet(230);
  line.positions.rightCols<2>().setZero();
  write_mesh(path, line);
  const Outcome outcome = run({"reshape", path.string(), "--pin", "0", "-v", "--json", "-"}, environment);
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  return outcome.err;
}

TEST_F(OnDevices, LargeMeshesGoToTheDevice) {
  EXPECT_THAT(words_of_large_run(folder_, {"SWAGE_DEVICE=0"}), HasSubstr("opencl on " + first_.name));
}

TEST_F(OnDevices, AutoFallsBackWithAWarning) {
  const std::string words = words_of_large_run(folder_, {"SWAGE_BACKEND=auto", "SWAGE_DEVICE=abacus"});
  EXPECT_THAT(words, HasSubstr("swage: warning: the cpu does the local steps: no OpenCL device is called \"abacus\""));
  EXPECT_THAT(words, HasSubstr("cpu on host"));
}

TEST_F(OnDevices, AutoWithoutAGpuIsQuietlyTheCpu) {
  if (first_.kind != "cpu") GTEST_SKIP() << "there is one";
  const std::string words = words_of_large_run(folder_, {});
  EXPECT_THAT(words, HasSubstr("cpu on host"));
  EXPECT_THAT(words, Not(HasSubstr("warning")));
}

}  // namespace
}  // namespace swage::test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/import_command.hpp"

#include "geometry/mesh/io/mesh_file.hpp"
#include "tests/apps/command_line/program_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include <sstream>

namespace plekton::apps::import_command_test {
namespace {

using testing::HasSubstr;

constexpr const char* kHammock = PLEKTON_SOURCE_DIR "/apps/examples/catch/hammock.stl";

TEST(ImportCommand, WritesTheRepairedMeshAndItsReport) {
  const test::TemporaryFolder folder;

  const Outcome outcome =
      outcome_of({"import", kHammock, "--weld", "1 um", "--out", (folder / "a/b").string()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("hammock-repaired.off"));
  const auto report = nlohmann::json::parse(test::bytes_of(folder / "a/b/report.json"));
  EXPECT_EQ(report["after"]["points"], 22 * 22);
  const auto soup = geometry::read_mesh_file(folder / "a/b/hammock-repaired.off");
  EXPECT_EQ(soup.points.size(), 22U * 22U);
  EXPECT_EQ(soup.polygons.size(), 2U * 21U * 21U);
}

TEST(ImportCommand, ReplacesAnEarlierImportOnlyWhenTold) {
  const test::TemporaryFolder folder;
  const std::vector<std::string> command = {"import", kHammock, "--out", (folder / "a").string()};
  ASSERT_EQ(outcome_of(command).exit_code, kDone);
  test::write_bytes(folder / "a/report.json", "mine");

  const Outcome refused = outcome_of(command);
  auto telling = command;
  telling.push_back("--overwrite");

  EXPECT_EQ(refused.exit_code, kFailed);
  EXPECT_THAT(refused.err, HasSubstr("hammock-repaired.off"));
  EXPECT_THAT(refused.err, HasSubstr("--overwrite"));
  EXPECT_EQ(test::bytes_of(folder / "a/report.json"), "mine");
  EXPECT_EQ(outcome_of(telling).exit_code, kDone);
  EXPECT_NE(test::bytes_of(folder / "a/report.json"), "mine");
}

TEST(ImportCommand, PrintsTheReportAsJson) {
  const Outcome outcome = outcome_of({"import", kHammock, "--json"});

  EXPECT_EQ(outcome.exit_code, kDone);
  EXPECT_TRUE(nlohmann::json::parse(outcome.out).contains("verdict"));
}

TEST(ImportCommand, PrintsJsonOfAFileWhoseNameIsNotUtf8) {
  const test::TemporaryFolder folder;
  const std::string name = "Sieb \xfc\"\n.off";
  test::write_bytes(folder / name, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");

  const Outcome outcome = outcome_of({"import", (folder / name).string(), "--json"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  ASSERT_TRUE(nlohmann::json::accept(outcome.out)) << outcome.out;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["source"], "Sieb \xef\xbf\xbd\"\n.off");
}

TEST(ImportCommand, RemeshesAndFillsHolesWhenAsked) {
  const Outcome remeshed =
      outcome_of({"import", kHammock, "--weld", "1 um", "--target-edge", "10 cm", "--json"});
  const Outcome filled =
      outcome_of({"import", kHammock, "--weld", "1 um", "--longest-hole", "1 mm", "--json"});

  ASSERT_EQ(remeshed.exit_code, kDone) << remeshed.err;
  EXPECT_EQ(nlohmann::json::parse(remeshed.out)["reshaped"]["target_edge"], 0.1);
  ASSERT_EQ(filled.exit_code, kDone) << filled.err;
  EXPECT_EQ(nlohmann::json::parse(filled.out)["reshaped"]["holes_filled"], 0);
}

TEST(ImportCommand, SaysWhenAThicknessDoesNotGoWithTheMesh) {
  const Outcome outcome = outcome_of({"import", kHammock, "--weld", "1 um", "--thickness", "5 cm"});

  EXPECT_EQ(outcome.exit_code, kDone);
  EXPECT_THAT(outcome.out, HasSubstr("thickness of 0.05 m exceeds the length"));
}

TEST(ImportCommand, RefusesBadMeshesWithOneMessageAndWritesNothing) {
  const test::TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"empty.off", ""},
      {"nan.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n"},
      {"no_facets.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"},
      {"range.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"},
      {"mesh.xyz", "0 0 0\n"}};
  for (const auto& [name, bytes] : bad) {
    test::write_bytes(folder / name, bytes);

    const Outcome outcome =
        outcome_of({"import", (folder / name).string(), "--out", (folder / "out").string()});

    EXPECT_EQ(outcome.exit_code, kFailed) << name;
    EXPECT_THAT(outcome.err, HasSubstr("plekton: ")) << name;
    EXPECT_THAT(outcome.err, HasSubstr(name)) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << name;
  }
}

TEST(ImportCommand, QuotesNothingOfAFileThatIsNoMesh) {
  const test::TemporaryFolder folder;
  for (const std::string text : {"root:secret:1\nuser:secret:2\n", "v root:secret\n",
                                 "f root:secret\n", "<root:secret></root>", "$root:secret\n"}) {
    for (const std::string ending : {"off", "obj", "stl", "ply", "msh", "vtp"}) {
      const std::string name = "a." + ending;
      test::write_bytes(folder / name, text);

      const Outcome outcome = outcome_of({"import", (folder / name).string()});

      EXPECT_EQ(outcome.exit_code, kFailed) << name << ": " << text;
      EXPECT_THAT(outcome.err, HasSubstr(name));
      EXPECT_THAT(outcome.err, testing::Not(HasSubstr("secret"))) << text;
    }
  }
}

TEST(ImportCommand, QuotesNoMoreThanTheBeginningOfAWord) {
  const test::TemporaryFolder folder;
  const std::string word(200, 'x');
  test::write_bytes(folder / "a.off", "OFF\n3 1 0\n0 0 " + word + "\n");

  const Outcome outcome = outcome_of({"import", (folder / "a.off").string()});

  EXPECT_THAT(outcome.err, HasSubstr("got '" + word.substr(0, 20) + "...'"));
}

TEST(ImportCommand, ReadsNoFilesButThoseOfADisk) {
  const test::TemporaryFolder folder;
  std::filesystem::create_symlink("/proc/self/maps", folder / "kernel.off");
  ASSERT_EQ(::mkfifo((folder / "pipe.off").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder / "device.off");

  for (const std::string name : {"kernel.off", "pipe.off", "device.off"}) {
    const Outcome outcome = outcome_of({"import", (folder / name).string()});

    EXPECT_EQ(outcome.exit_code, kFailed) << name;
    EXPECT_THAT(outcome.err, HasSubstr(name + ": not a file on a disk")) << name;
  }
}

TEST(ImportCommand, RefusesAMissingMeshAndABadLength) {
  EXPECT_EQ(outcome_of({"import", "/nowhere/mesh.off"}).exit_code, kFailed);
  const Outcome outcome = outcome_of({"import", kHammock, "--weld", "1 kg"});
  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("--weld: got \"1 kg\", a mass; expected a length"));
}

TEST(ImportCommand, RefusesLengthsThatAskForNothing) {
  for (const std::string option :
       {"--target-edge", "--wrap-detail", "--longest-hole", "--thickness"}) {
    for (const std::string length : {"0", "0 mm", "-1 mm", "-1e-300"}) {
      const Outcome outcome = outcome_of({"import", kHammock, option + "=" + length});

      EXPECT_EQ(outcome.exit_code, kFailed) << option << ' ' << length;
      EXPECT_EQ(outcome.err, fmt::format("plekton: {}: got \"{}\"; expected a length above 0\n",
                                         option, length));
    }
    for (const std::string text : {"", "nan", "inf", "1e999 m"}) {
      const Outcome outcome = outcome_of({"import", kHammock, option, text});

      EXPECT_NE(outcome.exit_code, kDone) << option << ' ' << text;
      EXPECT_THAT(outcome.err, HasSubstr(option)) << text;
    }
  }
  EXPECT_THAT(outcome_of({"import", kHammock, "--weld=-1 um"}).err,
              HasSubstr("--weld: got \"-1 um\"; expected a length of at least 0"));
}

TEST(ImportCommand, ScalesAMeshBeforeItsRepair) {
  const test::TemporaryFolder folder;
  // In mm; two points 1 um apart.
  test::write_bytes(folder / "a.off",
                    "OFF\n6 2 0\n0 0 0\n100 0 0\n0 100 0\n100 0.001 0\n0 100 0\n100 100 0\n"
                    "3 0 1 2\n3 3 5 4\n");

  const Outcome outcome = outcome_of(
      {"import", (folder / "a.off").string(), "--scale", "0.001", "--weld", "2 um", "--json"});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_NEAR(json["after"]["area"], 0.01, 1e-7);
  EXPECT_EQ(json["after"]["points"], 4);
}

TEST(ImportCommand, RefusesAScaleThatIsNone) {
  for (const std::string text : {"0", "-1", "nan", "1 mm", "x"}) {
    const Outcome outcome = outcome_of({"import", kHammock, "--scale=" + text});

    EXPECT_EQ(outcome.exit_code, kFailed) << text;
    EXPECT_THAT(outcome.err, HasSubstr("--scale: got ")) << text;
  }
}

TEST(ImportCommand, LeavesNoHalfOfItsFilesWhenTheFolderCannotBeWritten) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "file", "");

  const Outcome outcome = outcome_of({"import", kHammock, "--out", (folder / "file/out").string()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("a part of the path is a file"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

}  // namespace
}  // namespace plekton::apps::import_command_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/pvd_series.hpp"

#include "dynamics/output/file.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::dynamics {
namespace {

using test::bytes_of;
using test::TemporaryFolder;
using test::write_bytes;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A `.pvd` file with these lines.
std::string collection(const std::string& lines) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n  "
         "<Collection>\n" +
         lines + "  </Collection>\n</VTKFile>\n";
}

TEST(PvdSeries, IsCompleteAfterEveryMoment) {
  const TemporaryFolder folder;
  write_bytes(folder / "g0.vtp", "");
  write_bytes(folder / "g1.vtp", "");
  PvdSeries series(folder / "grains.pvd");
  const std::string first =
      "    <DataSet timestep=\"0\" group=\"\" part=\"0\" name=\"grains\" file=\"g0.vtp\"/>\n";
  const std::string second =
      "    <DataSet timestep=\"0.1\" group=\"\" part=\"0\" name=\"grains\" file=\"g1.vtp\"/>\n";

  series.add({{0.0, "grains", folder / "g0.vtp"}});
  EXPECT_EQ(bytes_of(folder / "grains.pvd"), collection(first));

  series.add({{0.1, "grains", folder / "g1.vtp"}});
  EXPECT_EQ(bytes_of(folder / "grains.pvd"), collection(first + second));
  EXPECT_THAT(folder.names(), ElementsAre("g0.vtp", "g1.vtp", "grains.pvd"));
}

TEST(PvdSeries, NumbersPartsByName) {
  const TemporaryFolder folder;
  write_bytes(folder / "g", "");
  write_bytes(folder / "s", "");
  PvdSeries series(folder / "all.pvd");

  series.add({{0.0, "grains", folder / "g"}, {0.0, "surface", folder / "s"}});
  series.add({{1.0, "surface", folder / "s"}});

  const std::string text = bytes_of(folder / "all.pvd");
  EXPECT_THAT(text, HasSubstr("timestep=\"0\" group=\"\" part=\"0\" name=\"grains\""));
  EXPECT_THAT(text, HasSubstr("timestep=\"0\" group=\"\" part=\"1\" name=\"surface\""));
  EXPECT_THAT(text, HasSubstr("timestep=\"1\" group=\"\" part=\"1\" name=\"surface\""));
}

TEST(PvdSeries, NamesFilesRelativeToItsFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "run" / "frames");
  write_bytes(folder / "run/frames/a.vtp", "");
  write_bytes(folder / "b.vtp", "");
  PvdSeries series(folder / "run" / "all.pvd");

  series.add({{0.0, "a", folder / "run/./frames/a.vtp"}, {0.0, "b", folder / "b.vtp"}});

  EXPECT_THAT(bytes_of(folder / "run" / "all.pvd"),
              AllOf(HasSubstr("\"frames/a.vtp\""), HasSubstr("\"../b.vtp\"")));
}

TEST(PvdSeries, TakesPathsRelativeToTheWorkingFolder) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.vtp", "");
  const auto from_here = [&](const std::string& name) {
    return std::filesystem::proximate(folder / name);
  };

  PvdSeries(from_here("all.pvd")).add({{0.0, "a", from_here("a.vtp")}});

  EXPECT_THAT(bytes_of(folder / "all.pvd"), HasSubstr("file=\"a.vtp\""));
}

TEST(PvdSeries, EscapesNames) {
  const TemporaryFolder folder;
  const std::string name = "Körner <1> & \"2\".vtp";
  write_bytes(folder / name, "");

  PvdSeries(folder / "all.pvd").add({{0.0, "a & b", folder / name}});

  EXPECT_THAT(bytes_of(folder / "all.pvd"),
              HasSubstr("name=\"a &amp; b\" file=\"Körner &lt;1&gt; &amp; &quot;2&quot;.vtp\""));
}

TEST(PvdSeries, RefusesAFileThatIsNotThere) {
  const TemporaryFolder folder;
  PvdSeries series(folder / "all.pvd");

  EXPECT_THAT(
      [&] {
        series.add({{0.0, "a", folder / "a.vtp"}});
      },
      ThrowsMessage<OutputError>(AllOf(HasSubstr("all.pvd: cannot list"), HasSubstr("a.vtp"))));
  EXPECT_TRUE(folder.names().empty());
}

TEST(PvdSeries, KeepsTheSeriesSoFarOnAFullDisk) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.vtp", "");
  PvdSeries series(folder / "all.pvd");
  series.add({{0.0, "a", folder / "a.vtp"}});
  const std::string before = bytes_of(folder / "all.pvd");
  test::fill_disk_at(folder / "all.pvd.part");

  EXPECT_THAT(
      [&] {
        series.add({{1.0, "b", folder / "a.vtp"}});
      },
      ThrowsMessage<OutputError>(HasSubstr("No space left on device")));

  EXPECT_EQ(bytes_of(folder / "all.pvd"), before);
  EXPECT_THAT(folder.names(), ElementsAre("a.vtp", "all.pvd"));
  series.add({{2.0, "c", folder / "a.vtp"}});
  EXPECT_THAT(bytes_of(folder / "all.pvd"),
              AllOf(Not(HasSubstr("name=\"b\"")),
                    HasSubstr("timestep=\"2\" group=\"\" part=\"1\" name=\"c\"")));
}

}  // namespace
}  // namespace plekton::dynamics

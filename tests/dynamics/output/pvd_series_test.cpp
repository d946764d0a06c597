// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/pvd_series.hpp"

#include "dynamics/output/file.hpp"
#include "geometry/mesh/io/xml_elements.hpp"
#include "geometry/mesh/mesh.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <sstream>

namespace plekton::dynamics::pvd_series_test {
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

/// A text without the blanks that stand before its closing tags as room for more.
std::string without_room(const std::string& text) {
  const std::size_t end = text.find("</Collection>");
  const std::size_t last = text.find_last_not_of(' ', end - 1);
  return text.substr(0, last + 1) + "  " + text.substr(end);
}

std::string series_of(const std::filesystem::path& file) {
  return without_room(bytes_of(file));
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
  EXPECT_EQ(series_of(folder / "grains.pvd"), collection(first));

  series.add({{0.1, "grains", folder / "g1.vtp"}});
  EXPECT_EQ(series_of(folder / "grains.pvd"), collection(first + second));
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

/// Bytes that this process has handed to the operating system to write so far.
std::size_t bytes_written() {
  std::istringstream counts(bytes_of("/proc/self/io"));
  std::string name;
  std::size_t bytes = 0;
  while (counts >> name >> bytes && name != "wchar:") {
  }
  return bytes;
}

TEST(PvdSeries, WritesBytesInProportionToItsMoments) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.vtp", "");
  PvdSeries series(folder / "all.pvd");
  const auto written_by = [&](int moments) {
    const std::size_t before = bytes_written();
    for (int i = 0; i < moments; ++i) series.add({{1.0, "a", folder / "a.vtp"}});
    return bytes_written() - before;
  };
  const std::size_t line =
      std::string("    <DataSet timestep=\"1\" group=\"\" part=\"0\" name=\"a\" file=\"a.vtp\"/>\n")
          .size();

  // Six bytes for each of the series, and the room that the first file has.
  EXPECT_LT(written_by(2000), 6 * 2000 * line + 4500);
  EXPECT_LT(written_by(2000), 6 * 4000 * line);
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
  std::string before;
  bool failed = false;

  try {
    // Entries go into the room that the file has, until there is none.
    const test::FileSizeLimit limit(bytes_of(folder / "all.pvd").size());
    for (int i = 1; i < 1000; ++i) {
      before = bytes_of(folder / "all.pvd");
      series.add({{1.0 * i, "b", folder / "a.vtp"}});
    }
  } catch (const OutputError& error) {
    failed = error.reason() == EFBIG;
  }

  EXPECT_TRUE(failed);
  EXPECT_EQ(bytes_of(folder / "all.pvd"), before);
  EXPECT_THAT(folder.names(), ElementsAre("a.vtp", "all.pvd"));
  series.add({{2000.0, "c", folder / "a.vtp"}});
  EXPECT_THAT(bytes_of(folder / "all.pvd"),
              AllOf(HasSubstr("timestep=\"2000\" group=\"\" part=\"2\" name=\"c\""),
                    HasSubstr("name=\"b\"")));
}

TEST(PvdSeries, IsWrittenAnewWhereItWasRemoved) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.vtp", "");
  PvdSeries series(folder / "all.pvd");
  series.add({{0.0, "a", folder / "a.vtp"}});
  std::filesystem::remove(folder / "all.pvd");

  series.add({{1.0, "a", folder / "a.vtp"}});

  EXPECT_THAT(bytes_of(folder / "all.pvd"),
              AllOf(HasSubstr("timestep=\"0\""), HasSubstr("timestep=\"1\"")));
}

TEST(PvdSeries, GoesOnToTheBytesOfASeriesThatWasNotStopped) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.vtp", "");
  const std::filesystem::path file = folder / "all.pvd";
  std::vector<SeriesEntry> entries;  // more than the first file has room for
  for (int i = 0; i < 300; ++i) entries.push_back({0.5 * i, "a", folder / "a.vtp"});
  PvdSeries whole(file);
  std::string in_the_middle;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i == 200) in_the_middle = bytes_of(file);
    whole.add({entries[i]});
  }
  const std::string at_the_end = bytes_of(file);

  PvdSeries resumed(file);
  resumed.go_on({entries.begin(), entries.begin() + 200});
  EXPECT_EQ(bytes_of(file), in_the_middle);
  for (std::size_t i = 200; i < entries.size(); ++i) resumed.add({entries[i]});

  EXPECT_EQ(bytes_of(file), at_the_end);
}

/// The data sets that a text names, if it is XML in which every reference is whole; -1 if not.
std::ptrdiff_t data_sets_in(const std::string& text) {
  for (std::size_t at = text.find('&'); at != std::string::npos; at = text.find('&', at + 1))
    if (text.compare(at, 5, "&amp;") != 0) return -1;
  try {
    const auto elements = geometry::read_xml(text, "series", "VTKFile");
    return std::count_if(elements.begin(), elements.end(), [](const geometry::XmlElement& element) {
      return element.name == "DataSet" && element.attribute("file").ends_with(".vtp");
    });
  } catch (const geometry::MeshError&) {
    return -1;
  }
}

TEST(PvdSeries, IsValidAfterEveryByteOfAWrite) {
  const std::string line = "<DataSet timestep=\"0\" name=\"a &amp; b\" file=\"a&amp;b.vtp\"/>\n";
  const std::string start = "<VTKFile>\n" + line;
  std::string text = start + std::string(200, ' ') + "</VTKFile>\n";
  std::ptrdiff_t least = 1;

  for (const PlacedBytes& write : writes_in_place(line + line, start.size())) {
    for (std::size_t i = 0; i < write.bytes.size(); ++i) {
      text[write.position + i] = write.bytes[i];

      const std::ptrdiff_t data_sets = data_sets_in(text);
      ASSERT_GE(data_sets, least) << text;
      least = data_sets;
    }
  }

  EXPECT_EQ(least, 3);
  EXPECT_EQ(text.substr(0, start.size() + 2 * line.size()), start + line + line);
}

TEST(PvdSeries, OpensWhereverItsWriterWasKilled) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.vtp", "");
  for (int trial = 0; trial < 20; ++trial) {
    const ::pid_t writer = ::fork();
    if (writer == 0) {
      PvdSeries series(folder / "all.pvd");
      while (true) series.add({{0.0, "a", folder / "a.vtp"}});
    }
    while (!std::filesystem::exists(folder / "all.pvd")) ::usleep(100);
    ::usleep(static_cast<::useconds_t>(500 * trial));
    ::kill(writer, SIGKILL);
    ::waitpid(writer, nullptr, 0);

    EXPECT_GE(data_sets_in(bytes_of(folder / "all.pvd")), 1);
    std::filesystem::remove(folder / "all.pvd");
  }
}

}  // namespace
}  // namespace plekton::dynamics::pvd_series_test

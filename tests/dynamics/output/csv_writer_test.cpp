// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/csv_writer.hpp"

#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

namespace plekton::dynamics::csv_writer_test {
namespace {

using test::bytes_of;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

const std::array<CsvColumn, 2> kColumns = {CsvColumn{"time", "s"},
                                           CsvColumn{"kinetic energy", "J"}};
const std::string kHead = "time (s),kinetic energy (J)\n";

TEST(CsvWriter, WritesEveryRowAtOnceByDefault) {
  const TemporaryFolder folder;
  CsvWriter csv(folder / "energy.csv", kColumns);
  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead);

  csv.add({0.1, 1.0 / 3.0});

  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead + "0.1,0.3333333333333333\n");
}

TEST(CsvWriter, GathersRowsUntilItIsAsked) {
  const TemporaryFolder folder;
  CsvWriter csv(folder / "energy.csv", kColumns, CsvWriter::Flush::on_request);

  csv.add({0.0, 1.0});
  csv.add({1.0, 2.0});
  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead);
  csv.flush();

  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead + "0,1\n1,2\n");
}

TEST(CsvWriter, WritesGatheredRowsAtTheEnd) {
  const TemporaryFolder folder;

  CsvWriter(folder / "energy.csv", kColumns, CsvWriter::Flush::on_request).add({0.0, 1.0});

  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead + "0,1\n");
}

TEST(CsvWriter, DoesNotGatherWithoutEnd) {
  const TemporaryFolder folder;
  CsvWriter csv(folder / "energy.csv", kColumns, CsvWriter::Flush::on_request);

  for (int i = 0; i < 20000; ++i) csv.add({0.0, 1.0});  // 4 bytes each, 64 kB are gathered at most

  EXPECT_GT(std::filesystem::file_size(folder / "energy.csv"), kHead.size() + 4 * 16000);
}

TEST(CsvWriter, ReplacesTheHistoryOfAnEarlierRun) {
  const TemporaryFolder folder;
  test::write_bytes(folder / "energy.csv",
                    "an earlier run, much longer than the head row of the new one");

  const CsvWriter csv(folder / "energy.csv", kColumns);

  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead);
}

TEST(CsvWriter, QuotesHeadsWithSeparatorsAndLeavesOutMissingUnits) {
  const TemporaryFolder folder;
  const std::array<CsvColumn, 3> columns = {CsvColumn{"x, y", "m"}, CsvColumn{"\"q\"", ""},
                                            CsvColumn{"θ", "°"}};

  const CsvWriter csv(folder / "a.csv", columns);

  EXPECT_EQ(bytes_of(folder / "a.csv"), "\"x, y (m)\",\"\"\"q\"\"\",θ (°)\n");
}

TEST(CsvWriter, LeavesNoFileIfTheHeadRowDoesNotFit) {
  const TemporaryFolder folder;
  std::string message;

  try {
    const test::FileSizeLimit limit(kHead.size() - 1);
    CsvWriter(folder / "energy.csv", kColumns);
  } catch (const OutputError& error) {
    message = error.what();
  }

  EXPECT_THAT(message, AllOf(HasSubstr("energy.csv"), HasSubstr("File too large")));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(CsvWriter, EndsWithAWholeRowWhenTheDiskFillsUp) {
  const TemporaryFolder folder;
  CsvWriter csv(folder / "energy.csv", kColumns);
  csv.add({0.0, 1.0});
  bool failed = false;

  try {
    const test::FileSizeLimit limit(kHead.size() +
                                    6);  // the first row has 4 bytes, half of the second one fits
    csv.add({1.0, 2.0});
  } catch (const OutputError&) {
    failed = true;
  }

  EXPECT_TRUE(failed);
  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead + "0,1\n");
  csv.flush();
  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead + "0,1\n1,2\n");
}

TEST(CsvWriter, TellsOfAFullDiskAtFlushAndNotInItsDestructor) {
  const TemporaryFolder folder;
  bool failed = false;
  {
    const test::FileSizeLimit limit(kHead.size() + 1);
    CsvWriter csv(folder / "energy.csv", kColumns, CsvWriter::Flush::on_request);
    csv.add({0.0, 1.0});
    try {
      csv.close();
    } catch (const OutputError&) {
      failed = true;
    }
  }

  EXPECT_TRUE(failed);
  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead);
}

TEST(CsvWriter, GoesOnAfterTheRowsThatItKeepsAndCutsOffWhatCameAfterThem) {
  const TemporaryFolder folder;
  CsvWriter first(folder / "energy.csv", kColumns);
  first.add({0.0, 1.0});
  const std::uint64_t kept = first.size();
  first.add({1.0, 2.0});
  first.close();

  CsvWriter second(folder / "energy.csv", kColumns, CsvWriter::Flush::every_row, kept);
  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead + "0,1\n");
  second.add({1.0, 3.0});

  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead + "0,1\n1,3\n");
  EXPECT_EQ(second.size(), kHead.size() + 8);
}

TEST(CsvWriter, RefusesToGoOnWithAnotherFileAndLeavesThatAsItIs) {
  const TemporaryFolder folder;
  const std::uint64_t kept = kHead.size() + 4;
  test::write_bytes(folder / "short.csv", kHead + "0,");
  test::write_bytes(folder / "other.csv", "time (s),kinetic energy (N)\n0,1\n");
  const auto go_on = [&](const char* name, std::uint64_t bytes) {
    return [path = folder / name, bytes] {
      CsvWriter(path, kColumns, CsvWriter::Flush::every_row, bytes);
    };
  };
  const auto is_refused = [](const char* name,
                             const char* why = "is not the file that the run has written so far") {
    return ThrowsMessage<OutputError>(AllOf(HasSubstr(name), HasSubstr(why)));
  };

  EXPECT_THAT(go_on("short.csv", kept), is_refused("short.csv"));
  EXPECT_THAT(go_on("short.csv", kHead.size() - 1), is_refused("short.csv"));  // within the head
  EXPECT_THAT(go_on("other.csv", kHead.size() + 4), is_refused("other.csv", "has other columns"));
  EXPECT_THAT(go_on("missing.csv", kept), is_refused("missing.csv"));
  EXPECT_EQ(bytes_of(folder / "short.csv"), kHead + "0,");
  EXPECT_THAT(folder.names(), testing::ElementsAre("other.csv", "short.csv"));
}

TEST(CsvWriter, RefusesRowsOfAnotherLengthAndRowsAfterItsEnd) {
  const TemporaryFolder folder;
  CsvWriter csv(folder / "energy.csv", kColumns);
  csv.add({0.0, 1.0});

  EXPECT_THAT([&] { csv.add({1.0}); },
              ThrowsMessage<std::logic_error>(HasSubstr("1 numbers; there are 2 columns")));
  csv.close();
  EXPECT_THAT(
      [&] {
        csv.add({1.0, 2.0});
      },
      ThrowsMessage<std::logic_error>(HasSubstr("after close()")));
  EXPECT_EQ(bytes_of(folder / "energy.csv"), kHead + "0,1\n");
}

}  // namespace
}  // namespace plekton::dynamics::csv_writer_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/csv_writer.hpp"

#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

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

}  // namespace
}  // namespace plekton::dynamics::csv_writer_test

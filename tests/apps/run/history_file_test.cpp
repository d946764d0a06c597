// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/history_file.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

namespace plekton::apps::history_file_test {
namespace {

constexpr std::array<dynamics::OutputField, 2> kFields = {{{"force", "N", ""}, {"slip", "m", ""}}};

class HistoryFileTest : public testing::Test {
 protected:
  std::string text() const { return test::bytes_of(folder_.path() / "a.csv"); }

  test::TemporaryFolder folder_;
};

TEST_F(HistoryFileTest, HasTheTimeAndTheFieldsOfEachBodyBehindItsName) {
  HistoryColumns columns;
  columns.add("rope", kFields);
  columns.add_vectors("post", std::span(kFields).first(1));
  HistoryFile file;
  file.open(folder_.path(), "a.csv", columns, nullptr);
  file.add_row({0.5, 1, 2, 3, 4, 5});
  file.close();

  EXPECT_EQ(text(),
            "time (s),rope.force (N),rope.slip (m),post.force_x (N),post.force_y (N),"
            "post.force_z (N)\n0.5,1,2,3,4,5\n");
}

TEST_F(HistoryFileTest, IsNotThereWithoutBodiesNorIsThatOfAnEarlierRun) {
  test::write_bytes(folder_.path() / "a.csv", "old\n");
  HistoryFile file;
  file.open(folder_.path(), "a.csv", HistoryColumns{}, nullptr);
  file.flush();
  file.close();
  WrittenFiles written;
  file.tell(written);

  EXPECT_FALSE(file.is_open());
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "a.csv"));
  EXPECT_TRUE(written.sizes.empty());
}

TEST_F(HistoryFileTest, GoesOnWhereItWasWhenItToldAndForgetsWhatCameAfter) {
  HistoryColumns columns;
  columns.add("rope", kFields[0]);
  WrittenFiles written;
  {
    HistoryFile file;
    file.open(folder_.path(), "a.csv", columns, nullptr);
    file.add_row({0, 1});
    file.flush();
    file.tell(written);
    file.add_row({1, 2});
    file.close();
  }
  HistoryFile again;
  again.open(folder_.path(), "a.csv", columns, &written);
  again.add_row({1, 3});
  again.close();

  EXPECT_EQ(text(), "time (s),rope.force (N)\n0,1\n1,3\n");
}

}  // namespace
}  // namespace plekton::apps::history_file_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/checkpoint/checkpoint_file.hpp"

#include "dynamics/output/file.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace plekton::dynamics {
namespace {

using geometry::StateTree;
using testing::HasSubstr;
using testing::ThrowsMessage;

StateTree example() {
  StateTree state;
  state.arrays["time"] = {std::vector<double>{0.25}, 1};
  state.arrays["nodes/position"] = {
      std::vector<double>{1.0, std::numeric_limits<double>::quiet_NaN(), -0.0, 4.0, 5e-324, 6.0},
      3};
  state.arrays["contacts/spheres/id"] = {
      std::vector<std::int64_t>{-1, std::numeric_limits<std::int64_t>::max()}, 1};
  state.arrays["contacts/spheres/pair"] = {std::vector<std::int32_t>{0, 1, 2, -3}, 2};
  state.arrays["run/text"] = {std::vector<std::uint8_t>{0, 127, 255}, 1};
  state.arrays["empty"] = {std::vector<double>{}, 3};
  return state;
}

class CheckpointFile : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_ / "a.h5"; }
  void write(const std::string& bytes) const { test::write_bytes(file(), bytes); }
  std::string bytes() const { return test::bytes_of(file()); }

  test::TemporaryFolder folder_;
};

TEST_F(CheckpointFile, GivesBackEveryBit) {
  write_checkpoint(file(), example());
  const StateTree read = read_checkpoint(file());

  EXPECT_EQ(read.hash(), example().hash());
  EXPECT_EQ(read.arrays.size(), example().arrays.size());
  EXPECT_EQ(read.arrays.at("empty").columns, 3U);
}

TEST_F(CheckpointFile, HasTheSameBytesForTheSameState) {
  write_checkpoint(file(), example());
  const std::string first = bytes();
  write_checkpoint(file(), example());

  EXPECT_EQ(bytes(), first);
}

TEST_F(CheckpointFile, LeavesNothingButItself) {
  write_checkpoint(file(), example());

  EXPECT_EQ(folder_.names(), std::vector<std::string>{"a.h5"});
}

TEST_F(CheckpointFile, RefusesAFileThatIsNotThere) {
  EXPECT_THAT([&] { read_checkpoint(file()); }, ThrowsMessage<CheckpointError>(HasSubstr("a.h5")));
}

TEST_F(CheckpointFile, RefusesAFolder) {
  EXPECT_THAT([&] { read_checkpoint(folder_.path()); },
              ThrowsMessage<CheckpointError>(HasSubstr("expected")));
}

TEST_F(CheckpointFile, RefusesWhatIsNoCheckpoint) {
  write("time = 1");

  EXPECT_THAT([&] { read_checkpoint(file()); },
              ThrowsMessage<CheckpointError>(HasSubstr("no checkpoint of Plekton")));
}

TEST_F(CheckpointFile, CannotBeWrittenWhereThereIsNoFolder) {
  EXPECT_THROW(write_checkpoint(folder_ / "none" / "a.h5", example()), OutputError);
}

/// Whatever is cut off or changed: one message, never a crash, never another state.
TEST_F(CheckpointFile, RefusesAFileThatIsCutOffAnywhere) {
  write_checkpoint(file(), example());
  const std::string whole = bytes();
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 40) {
    write(whole.substr(0, size));
    EXPECT_THROW(read_checkpoint(file()), CheckpointError) << size;
  }
}

TEST_F(CheckpointFile, IsTheSameStateOrRefusedWithAnyByteChanged) {
  write_checkpoint(file(), example());
  const std::string whole = bytes();
  test::Random random(5);
  for (int i = 0; i < 2000; ++i) {
    std::string changed = whole;
    const auto at =
        static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(whole.size())));
    changed[std::min(at, whole.size() - 1)] ^=
        static_cast<char>(1U << static_cast<unsigned>(random.uniform(0.0, 8.0)));
    write(changed);
    try {
      EXPECT_EQ(read_checkpoint(file()).hash(), example().hash()) << at;
    } catch (const CheckpointError&) {
    }
  }
}

}  // namespace
}  // namespace plekton::dynamics

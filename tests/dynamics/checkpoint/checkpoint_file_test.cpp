// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/checkpoint/checkpoint_file.hpp"

#include "dynamics/output/file.hpp"
#include "geometry/base/bit_hash.hpp"
#include "geometry/version.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace plekton::dynamics::checkpoint_file_test {
namespace {

using geometry::StateTree;
using testing::AllOf;
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

TEST_F(CheckpointFile, TellsWhoWroteItAndTheStateIsTheSame) {
  write_checkpoint(file(), example(), "abc123-modified");

  EXPECT_EQ(writer_of_checkpoint(file()).revision, "abc123-modified");
  EXPECT_EQ(writer_of_checkpoint(file()).version, kVersion);
  EXPECT_EQ(read_checkpoint(file()).hash(), example().hash());
  write_checkpoint(file(), example(), std::string(1000, 'a'));
  EXPECT_EQ(writer_of_checkpoint(file()).revision, std::string(256, 'a'));
  EXPECT_EQ(read_checkpoint(file()).hash(), example().hash());
  write_checkpoint(file(), example());
  EXPECT_EQ(writer_of_checkpoint(file()).revision, kUnknownRevision);
  write("time = 1");
  EXPECT_THROW(writer_of_checkpoint(file()), CheckpointError);
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

TEST_F(CheckpointFile, RefusesAnotherVersionAndNamesBoth) {
  write_checkpoint(file(), example());
  std::string bytes = test::bytes_of(file());
  const std::string version = "version " + std::to_string(kCheckpointVersion) + "\n";
  bytes.replace(bytes.find(version), version.size(), "version 1\n");
  write(bytes);

  EXPECT_THAT([&] { read_checkpoint(file()); },
              ThrowsMessage<CheckpointError>(
                  AllOf(HasSubstr("is of version 1, written by Plekton"),
                        HasSubstr("reads version " + std::to_string(kCheckpointVersion)))));
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

/// A file that leads elsewhere, with the head that a checkpoint has.
std::string forged(const std::filesystem::path& file, void (*fill)(hid_t)) {
  constexpr hsize_t kHead = 512;  // bytes
  const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_userblock(creation, kHead);
  const hid_t made = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
  fill(made);
  H5Fclose(made);
  H5Pclose(creation);
  const std::string image = test::bytes_of(file).substr(kHead);
  geometry::BitHash hash;
  for (std::size_t i = 0; i < image.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, image.data() + i, std::min(sizeof word, image.size() - i));
    hash.add(word);
  }
  std::ostringstream head;
  head << "plekton checkpoint\nversion " << kCheckpointVersion << "\nwriter x\nbytes "
       << image.size() << "\nchecksum " << std::hex << hash.value() << '\n';
  std::string bytes = head.str();
  bytes.resize(kHead, '\0');
  return bytes + image;
}

void add_rows(hid_t file, hid_t how) {
  const std::array<hsize_t, 2> size = {4, 1};
  const hid_t space = H5Screate_simple(2, size.data(), nullptr);
  const std::array<double, 4> numbers = {1.0, 2.0, 3.0, 4.0};
  const hid_t set = H5Dcreate2(file, "a", H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT);
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
  H5Dclose(set);
  H5Sclose(space);
}

/// The checksum is no signature, so whoever made a file may have put anything into it.
TEST_F(CheckpointFile, RefusesOneThatLeadsToAnotherFile) {
  const std::string plain = forged(file(), [](hid_t made) { add_rows(made, H5P_DEFAULT); });
  EXPECT_EQ(parse_checkpoint(plain, "plain").arrays.at("a").rows(), 4U);

  const std::string numbers_elsewhere = forged(file(), [](hid_t made) {
    const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(how, "/dev/zero", 0, 4 * sizeof(double));
    add_rows(made, how);
    H5Pclose(how);
  });
  EXPECT_THROW(parse_checkpoint(numbers_elsewhere, "forged"), CheckpointError);

  const std::string packed = forged(file(), [](hid_t made) {
    const std::array<hsize_t, 2> chunk = {4, 1};
    const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(how, 2, chunk.data());
    add_rows(made, how);
    H5Pclose(how);
  });
  EXPECT_THROW(parse_checkpoint(packed, "forged"), CheckpointError);

  const std::string link = forged(file(), [](hid_t made) {
    H5Lcreate_external("/nonexistent/other.h5", "a", made, "b", H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_THROW(parse_checkpoint(link, "forged"), CheckpointError);
}

TEST_F(CheckpointFile, IsWrittenAndReadInSeveralThreadsAtOnce) {
  constexpr int kTimes = 30;
  std::vector<int> right(4, 0);
  {
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < right.size(); ++k)
      threads.emplace_back([this, &right, k] {
        const std::filesystem::path own = folder_ / (std::to_string(k) + ".h5");
        for (int i = 0; i < kTimes; ++i) {
          StateTree state = example();
          state.arrays["time"] = {std::vector<double>{static_cast<double>(k) + 0.1 * i}, 1};
          write_checkpoint(own, state);
          right[k] += read_checkpoint(own).hash() == state.hash();
        }
      });
  }

  EXPECT_EQ(right, std::vector<int>(right.size(), kTimes));
}

}  // namespace
}  // namespace plekton::dynamics::checkpoint_file_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/state_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace plekton::geometry::state_archive_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

enum class Colour : std::int32_t { red, green };

/// Some of everything that a class may keep.
struct Thing {
  double length = 0.0;
  std::size_t count = 0;
  bool is_there = false;
  Colour colour = Colour::red;
  Vec3 place = Vec3::Zero();
  Quat turn = Quat::Identity();
  std::string name;
  std::vector<Vec3> path;
  std::vector<bool> flags;
  struct Part {
    NodeId node{};
    std::vector<double> numbers;
  };
  std::vector<Part> parts;

  void exchange(const StateArchive& archive) {
    archive("length", length);
    archive("count", count);
    archive("is_there", is_there);
    archive("colour", colour);
    archive("place", place);
    archive("turn", turn);
    archive("name", name);
    archive("path", path);
    archive("flags", flags);
    archive.group("inner").rows("parts", parts, [](RowFields& row, Part& part) {
      row("node", part.node);
      row("numbers", part.numbers);
    });
  }
};

Thing example() {
  return {-0.0,
          3,
          true,
          Colour::green,
          {1.0, std::numeric_limits<double>::quiet_NaN(), -2e-300},
          Quat(0.5, -0.5, 0.5, 0.5),
          "a name",
          {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}},
          {true, false, true},
          {{NodeId{7}, {}}, {NodeId{8}, {0.1, 0.2, 0.3}}}};
}

StateTree written(Thing thing) {
  StateTree tree;
  thing.exchange(StateArchive::writer(tree));
  return tree;
}

TEST(StateArchive, GivesBackEveryBitThatWasWritten) {
  const StateTree tree = written(example());
  Thing read;
  read.exchange(StateArchive::reader(tree));

  EXPECT_EQ(written(read).hash(), tree.hash());
  EXPECT_EQ(read.name, "a name");
  EXPECT_EQ(read.parts[1].numbers, (std::vector{0.1, 0.2, 0.3}));
  EXPECT_EQ(read.colour, Colour::green);
  EXPECT_TRUE(std::signbit(read.length));
}

TEST(StateArchive, HasTheRowsOfAGroupUnderTheirNames) {
  const StateTree tree = written(example());

  const StateArray& numbers = tree.arrays.at("inner/parts/numbers");
  EXPECT_EQ(numbers.rows(), 3U);
  EXPECT_EQ(tree.arrays.at("path").columns, 3U);
  EXPECT_EQ(tree.arrays.at("inner/parts/node").rows(), 2U);
}

TEST(StateArchive, NamesWhatIsMissing) {
  StateTree tree = written(example());
  tree.arrays.erase("path");
  Thing read;

  EXPECT_THAT([&] { read.exchange(StateArchive::reader(tree)); },
              ThrowsMessage<StateMismatch>(HasSubstr("no \"path\"")));
}

TEST(StateArchive, KnowsWhatAStateThatItReadsHas) {
  StateTree tree = written(example());
  const StateArchive reader = StateArchive::reader(tree);

  EXPECT_TRUE(reader.has("path"));
  EXPECT_TRUE(reader.group("inner").has("parts/node"));
  EXPECT_FALSE(reader.group("inner").has("path"));
  EXPECT_FALSE(StateArchive::writer(tree).has("path"));
}

TEST(StateArchive, NamesWhatIsOfAnotherKind) {
  StateTree tree = written(example());
  tree.arrays["length"] = {std::vector<std::int64_t>{1}, 1};
  Thing read;

  EXPECT_THAT([&] { read.exchange(StateArchive::reader(tree)); },
              ThrowsMessage<StateMismatch>(HasSubstr("\"length\"")));
}

TEST(StateArchive, RefusesRowsWithFewerNumbersThanTheyCount) {
  StateTree tree = written(example());
  std::get<std::vector<std::int64_t>>(tree.arrays["inner/parts/count"].numbers)[0] =
      std::numeric_limits<std::int64_t>::max();
  Thing read;

  EXPECT_THROW(read.exchange(StateArchive::reader(tree)), StateMismatch);
}

TEST(StateArchive, RefusesAListThatIsLongerThanItsNumbers) {
  StateTree tree = written(example());
  std::get<std::vector<std::int64_t>>(tree.arrays["inner/parts/numbers_count"].numbers)[1] =
      std::numeric_limits<std::int64_t>::max();
  Thing read;

  EXPECT_THROW(read.exchange(StateArchive::reader(tree)), StateMismatch);
}

TEST(StateArchive, RefusesRowsThatLeaveNumbersOver) {
  StateTree tree = written(example());
  std::get<std::vector<std::int64_t>>(tree.arrays["inner/parts/count"].numbers)[0] = 1;
  Thing read;

  EXPECT_THROW(read.exchange(StateArchive::reader(tree)), StateMismatch);
}

TEST(StateArchive, RefusesAnotherNumberOfWhatIsFixed) {
  StateTree tree;
  std::vector<double> two = {1.0, 2.0}, three = {1.0, 2.0, 3.0};
  StateArchive::writer(tree).fixed("masses", two, "nodes");

  EXPECT_THAT([&] { StateArchive::reader(tree).fixed("masses", three, "nodes"); },
              ThrowsMessage<StateMismatch>(HasSubstr("2 nodes, here are 3")));
}

TEST(StateArchive, RefusesWhatHasToBeTheSameAndIsNot) {
  StateTree tree;
  StateArchive::writer(tree).same("scene", 12, "another scene");

  StateArchive::reader(tree).same("scene", 12, "another scene");
  EXPECT_THAT([&] { StateArchive::reader(tree).same("scene", 13, "another scene"); },
              ThrowsMessage<StateMismatch>(HasSubstr("another scene")));
}

TEST(StateTree, HasAnotherHashWhereABitOrANameDiffers) {
  const StateTree tree = written(example());
  StateTree other = tree;
  std::get<std::vector<double>>(other.arrays["length"].numbers)[0] = 0.0;
  StateTree renamed = tree;
  renamed.arrays["width"] = renamed.arrays["length"];
  renamed.arrays.erase("length");

  EXPECT_NE(other.hash(), tree.hash());
  EXPECT_NE(renamed.hash(), tree.hash());
}

}  // namespace
}  // namespace plekton::geometry::state_archive_test

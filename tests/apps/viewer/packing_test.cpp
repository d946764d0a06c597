// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/packing.hpp"

#include "tests/apps/viewer/unpacked.hpp"

#include <gtest/gtest.h>

#include <random>

namespace plekton::apps::packing_test {
namespace {

std::vector<double> there_and_back(const std::vector<double>& values, std::size_t components,
                                   NumberType type) {
  const PackedNumbers packed = pack_numbers(values, components, type);
  const nlohmann::json record = {{"type", name_of(type)},
                                 {"components", components},
                                 {"lo", packed.low},
                                 {"hi", packed.high},
                                 {"scale", packed.scale}};
  return unpacked(inflated_text(deflated_text(packed.bytes)), record);
}

std::vector<double> some_numbers(std::size_t count, double scale) {
  std::mt19937_64 random(7);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(scale * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.3));
  return numbers;
}

TEST(Packing, KeepsPlacesToHalfAStepOfTheirBoxOnEachAxis) {
  std::vector<double> places = some_numbers(300, 1.0);
  for (std::size_t i = 0; i < places.size(); i += 3) places[i] *= 100.0;

  const auto back = there_and_back(places, 3, NumberType::u16);

  ASSERT_EQ(back.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double box = i % 3 == 0 ? 100.0 : 1.0;  // no wider than that
    EXPECT_NEAR(back[i], places[i], box / 65535.0 / 2.0 * (1.0 + 1e-9));
  }
}

TEST(Packing, KeepsTheEndsOfABoxAndWhatLiesInAPlane) {
  EXPECT_EQ(there_and_back({1.0, 5.0, 3.0, 5.0}, 2, NumberType::u16),
            (std::vector<double>{1.0, 5.0, 3.0, 5.0}));
}

TEST(Packing, KeepsValuesToOnePartIn512OverNineOrdersOfMagnitude) {
  std::vector<double> values;
  for (double x = 3.7e5; x > 3.7e-4; x *= -0.83) values.push_back(x);
  for (double x = 3.7e5; x > 3.7e-4; x *= 0.83) values.insert(values.end(), {x, -x});

  const auto back = there_and_back(values, 1, NumberType::f16);

  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(back[i], values[i], std::abs(values[i]) / 512.0) << i;
}

TEST(Packing, KeepsZero) {
  EXPECT_EQ(there_and_back({0.0, 0.0}, 1, NumberType::f16), (std::vector<double>{0.0, 0.0}));
  EXPECT_EQ(there_and_back({0.0, 4.0}, 1, NumberType::f16)[0], 0.0);
  EXPECT_EQ(half_of(0.0), 0);
}

// IEEE 754-2019, table 3.5, and the neighbours of 1 with 8 bits of fraction.
TEST(Packing, HasTheHalvesOfTheStandard) {
  EXPECT_EQ(half_of(1.0), 0x3c00);
  EXPECT_EQ(half_of(-2.0), 0xc000);
  EXPECT_EQ(half_of(1.0 + 1.0 / 256.0), 0x3c04);
  EXPECT_EQ(half_of(2.0 - 1e-9), 0x4000) << "rounded up into the next exponent";
  EXPECT_EQ(half_of(0x1p-14), 0x0400);
  EXPECT_EQ(half_of(0x1p-22), 0x0004) << "below the normal numbers";
}

TEST(Packing, LeavesWhatIsNoNumberWhatItIs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();

  const auto back = there_and_back({1.0, nan, 2.0}, 1, NumberType::f16);

  EXPECT_TRUE(std::isnan(back[1]));
  EXPECT_EQ(back[2], there_and_back({2.0}, 1, NumberType::f16)[0]);
}

TEST(Packing, KeepsWholeNumbersAndSingleAndDoublePrecision) {
  const std::vector<double> whole = {5, 2147483647, -2147483648.0, 0, 17, 17};
  EXPECT_EQ(there_and_back(whole, 2, NumberType::i32), whole);
  const std::vector<double> numbers = {0.5, -1e30, 3.0};
  EXPECT_EQ(there_and_back(numbers, 3, NumberType::f64), numbers);
  EXPECT_EQ(there_and_back({0.1}, 1, NumberType::f32)[0], static_cast<double>(0.1F));
}

TEST(Packing, TakesNoElements) {
  for (const NumberType type : {NumberType::u16, NumberType::f16, NumberType::i32})
    EXPECT_TRUE(pack_numbers({}, 3, type).bytes.empty());
}

TEST(Packing, TellsWaysInStepsOfTheBoxOfBefore) {
  const PackedNumbers before =
      pack_numbers(std::vector{0.0, 5.0, 65535.0, 9.0}, 2, NumberType::u16);
  nlohmann::json record = {{"components", 2}, {"lo", before.low}, {"hi", before.high}};

  const std::vector<double> values = {-3.0, 5.0, 65540.0, 9.0};
  const auto ways = pack_ways(values, 2, before);

  ASSERT_TRUE(ways);
  EXPECT_EQ(unpacked_ways(*ways, before.bytes, record), values);
}

TEST(Packing, TellsNoWaysWhereTheyWouldNotDo) {
  const PackedNumbers before = pack_numbers(std::vector{0.0, 65535.0}, 1, NumberType::u16);

  EXPECT_TRUE(pack_ways(std::vector{32767.0, 65535.0}, 1, before));
  EXPECT_FALSE(pack_ways(std::vector{32768.0, 65536.0}, 1, before)) << "too far for two bytes";
  EXPECT_FALSE(pack_ways(std::vector{32767.0, 65534.0}, 1, before)) << "a box half as wide";
  EXPECT_FALSE(pack_ways(std::vector{0.0}, 1, before)) << "fewer than before";
  EXPECT_FALSE(pack_ways(std::vector{0.0, std::nan("")}, 1, before));
  const PackedNumbers flat = pack_numbers(std::vector{7.0, 7.0}, 1, NumberType::u16);
  EXPECT_TRUE(pack_ways(std::vector{7.0, 7.0}, 1, flat));
  EXPECT_FALSE(pack_ways(std::vector{7.0, 7.1}, 1, flat)) << "out of a box without a width";
}

TEST(Packing, GivesLowAndHighBytesCodesOfTheirOwn) {
  std::mt19937_64 random(11);
  std::string bytes;  // low bytes of all values, high bytes of four
  for (int i = 0; i < 3000; ++i) bytes += static_cast<char>(random());
  for (int i = 0; i < 3000; ++i) bytes += static_cast<char>(random() % 4);

  const std::string text = deflated_text(bytes, 2);

  EXPECT_EQ(inflated_text(text), bytes);
  EXPECT_LT(text.size(), deflated_text(bytes).size());
}

// RFC 4648, 10: "foobar" and its beginnings, here behind zlib.
TEST(Packing, EndsBase64AsTheStandardSays) {
  for (const std::string text : {"", "f", "fo", "foo", "foob", "fooba", "foobar"}) {
    const std::string packed = deflated_text(text);
    EXPECT_EQ(packed.size() % 4, 0U);
    EXPECT_EQ(inflated_text(packed), text);
  }
}

}  // namespace
}  // namespace plekton::apps::packing_test

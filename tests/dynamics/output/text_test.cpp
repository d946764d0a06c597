// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace plekton::dynamics::text_test {
namespace {

std::string number_text(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

TEST(AppendNumber, IsShortAndReadsBackAsTheSameNumber) {
  using Limits = std::numeric_limits<double>;

  EXPECT_EQ(number_text(0.1), "0.1");
  for (const double value :
       {0.0, -0.0, 1.0 / 3.0, 1e23, Limits::denorm_min(), Limits::max(), -Limits::min()}) {
    const double back = std::strtod(number_text(value).c_str(), nullptr);
    EXPECT_EQ(back, value) << number_text(value);
  }
  EXPECT_EQ(number_text(-0.0), "-0");
}

TEST(AppendNumber, WritesWhatIsNotANumberAsReadersExpectIt) {
  EXPECT_EQ(number_text(std::nan("")), "nan");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(XmlEscaped, KeepsEveryCharacterThatXmlCanExpress) {
  EXPECT_EQ(xml_escaped("Körner <&> \"x\" 'y' \t\n"),
            "Körner &lt;&amp;&gt; &quot;x&quot; 'y' &#9;&#10;");
  EXPECT_EQ(xml_escaped("\x01"), "?");
}

}  // namespace
}  // namespace plekton::dynamics::text_test

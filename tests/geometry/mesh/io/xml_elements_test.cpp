// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/xml_elements.hpp"

#include "geometry/mesh/mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plekton::geometry::xml_elements_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::StartsWith;

std::string message_of(std::string_view bytes) {
  try {
    read_xml(bytes, "a.vtp", "VTKFile");
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

/// A root and elements in each other, this many levels in all.
std::string nested(int levels, std::string_view innermost) {
  std::string text = "<VTKFile>";
  for (int i = 1; i < levels; ++i) text += "<a>";
  text += innermost;
  for (int i = 1; i < levels; ++i) text += "</a>";
  return text + "</VTKFile>";
}

constexpr std::string_view kFile =
    "<?xml version=\"1.0\"?>\n"
    "<!-- <Ignored> and > are\n no tags here -->\n"
    "<!DOCTYPE VTKFile>\n"
    "<VTKFile type = 'Poly\"Data' version=\"0.1\"\n"
    "   empty=\"\">one\n"
    "<Piece a='1 > 0'/>two\n"
    "<Piece\n"
    ">\n"
    " 1 2\n"
    "<Points name=\"x\" name=\"y\"></Points ></Piece>\n"
    "<Other/>\n"
    "</VTKFile>\n";

TEST(ReadXml, HasElementsInTheOrderOfTheirStartsWithDepthsAndLines) {
  const auto elements = read_xml(kFile, "a.vtp", "VTKFile");

  std::vector<std::string_view> names;
  std::vector<std::size_t> depths, lines, text_lines;
  for (const XmlElement& element : elements) {
    names.push_back(element.name);
    depths.push_back(element.depth);
    lines.push_back(element.line);
    text_lines.push_back(element.text_line);
  }
  EXPECT_THAT(names, ElementsAre("VTKFile", "Piece", "Piece", "Points", "Other"));
  EXPECT_THAT(depths, ElementsAre(0, 1, 1, 2, 1));
  EXPECT_THAT(lines, ElementsAre(5, 7, 8, 11, 12));
  EXPECT_THAT(text_lines, ElementsAre(6, 7, 9, 11, 12)) << "where start tags end";
}

TEST(ReadXml, HasTextUpToTheNextTagAndAttributesAsWritten) {
  const auto elements = read_xml(kFile, "a.vtp", "VTKFile");

  ASSERT_EQ(elements.size(), 5u);
  EXPECT_EQ(elements[0].text, "one\n");
  EXPECT_EQ(elements[1].text, "") << "what follows belongs to the root";
  EXPECT_EQ(elements[2].text, "\n 1 2\n");
  EXPECT_THAT(elements[0].attributes,
              ElementsAre(Pair("type", "Poly\"Data"), Pair("version", "0.1"), Pair("empty", "")));
  EXPECT_EQ(elements[1].attribute("a"), "1 > 0");
  EXPECT_EQ(elements[3].attribute("name"), "x") << "the first of two";
  EXPECT_EQ(elements[3].attribute("nam"), "");
}

TEST(ReadXml, StopsAtAppendedDataWhichMayHoldAnything) {
  const std::string bytes("<VTKFile><AppendedData encoding=\"raw\">_<a></b><!--\0\"</VTKFile>", 63);

  const auto elements = read_xml(bytes, "a.vtp", "VTKFile");

  ASSERT_EQ(elements.size(), 2u);
  EXPECT_EQ(elements[1].attribute("encoding"), "raw");
  EXPECT_EQ(elements[1].text, std::string_view(bytes).substr(bytes.find('_')));
}

TEST(ChildrenOf, AreThoseOfANameOneLevelBelowAndNotOfTheNextElement) {
  const std::string_view text = "<VTKFile><a><b/><c><b/></c><b/></a><b/><a><b/></a><bb/></VTKFile>";
  const auto elements = read_xml(text, "a.vtp", "VTKFile");
  // 0 VTKFile, 1 a, 2 b, 3 c, 4 b, 5 b, 6 b, 7 a, 8 b, 9 bb

  EXPECT_THAT(children_of(elements, 0, "a"), ElementsAre(1, 7));
  EXPECT_THAT(children_of(elements, 0, "b"), ElementsAre(6));
  EXPECT_THAT(children_of(elements, 1, "b"), ElementsAre(2, 5));
  EXPECT_THAT(children_of(elements, 3, "b"), ElementsAre(4));
  EXPECT_THAT(children_of(elements, 2, "b"), IsEmpty());
  EXPECT_THAT(children_of(elements, 9, "b"), IsEmpty());
}

TEST(ReadXml, RefusesAnotherRootWithoutShowingIt) {
  for (const char* text : {"", "once upon a time", "<html></html>", "<VTKFiles></VTKFiles>",
                           "<!-- VTKFile --><secret/>", "</VTKFile>"}) {
    EXPECT_THAT(message_of(text),
                StartsWith("a.vtp: line 1: expected the root VTKFile; this is another kind of"))
        << text;
  }
  EXPECT_EQ(message_of("<VTKFile/>"), "accepted");
}

TEST(ReadXml, NamesTheLineAndTheTagThatDoesNotMatch) {
  const auto error = [](const char* place_and_problem) {
    return StartsWith("a.vtp: line " + std::string(place_and_problem));
  };

  EXPECT_THAT(message_of("<VTKFile>\n<a>\n</b></VTKFile>"),
              error("3: expected the end tag of 'a', got that of 'b'"));
  EXPECT_THAT(message_of("<VTKFile>\n<a>\n"),
              error("3: expected the end tag of 'a', got the end of the file"));
  EXPECT_THAT(message_of("<VTKFile></VTKFile>\n</VTKFile>"),
              error("2: expected a start tag, got that of 'VTKFile'"));
  EXPECT_THAT(message_of("<VTKFile>\n<a b>"), error("2: expected an attribute and its value, got"));
  EXPECT_THAT(message_of("<VTKFile\n\na=1>"), error("3: expected a value in quotes, got '1'"));
  EXPECT_THAT(message_of("<VTKFile a=\"1>\n</VTKFile>"),
              error("2: expected \", got the end of the file"));
  EXPECT_THAT(message_of("<VTKFile>\n<!-- never\n ends"),
              error("2: expected -->, got the end of the file"));
  EXPECT_THAT(message_of("<VTKFile"), HasSubstr("expected an attribute"));
}

TEST(ReadXml, TakesSixtyFourLevels) {
  EXPECT_EQ(message_of(nested(64, "")), "accepted");
  EXPECT_THAT(message_of(nested(65, "")), HasSubstr("expected at most 64 levels of elements"));
  EXPECT_THAT(message_of(nested(64, "<b/>")), HasSubstr("expected at most 64 levels of elements"));
}

}  // namespace
}  // namespace plekton::geometry::xml_elements_test

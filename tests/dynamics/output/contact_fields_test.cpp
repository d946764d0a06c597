// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/contact_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace plekton::dynamics::contact_fields_test {
namespace {

using contact::BodyKind;
using contact::ContactBody;
using contact::ContactRecord;
using geometry::Feature;
using geometry::Vec3;
using testing::ElementsAre;

/// All of its numbers differ.
ContactRecord contact_of_all() {
  ContactRecord contact{};
  contact.id = 9'007'199'254'740'991;  // the last whole number before doubles have gaps
  contact.a = {BodyKind::structure, 11, Feature(geometry::FaceId{12})};
  contact.b = {BodyKind::plane, 13, {}};
  contact.point_a = contact.point_b = Vec3(90, 91, 92);
  contact.point = Vec3(14, 15, 16);
  contact.normal = Vec3(17, 18, 19);
  contact.gap = -20.0;
  contact.deepest = 93.0;
  contact.normal_force = Vec3(2, 3, 6);
  contact.tangential_force = Vec3(1, 4, 8);
  contact.moment = Vec3(24, 25, 26);
  contact.elastic_force = 94.0;
  contact.is_bonded = true;
  return contact;
}

std::vector<double> row_of(const ContactRecord& contact, const ContactLabels& labels = {}) {
  std::vector<double> row;
  fill_contact_row(10.0, contact, labels, row);
  return row;
}

TEST(ContactFields, StandInARowAsTheirColumnsAreNamed) {
  std::vector<std::string> names;
  for (const CsvColumn& column : contact_columns()) names.push_back(column.name);
  EXPECT_THAT(
      names,
      ElementsAre("time", "id", "kind_a", "body_a", "feature_a", "kind_b", "body_b", "feature_b",
                  "point_x", "point_y", "point_z", "normal_x", "normal_y", "normal_z", "gap",
                  "normal_force_x", "normal_force_y", "normal_force_z", "normal_force_magnitude",
                  "tangential_force_x", "tangential_force_y", "tangential_force_z",
                  "tangential_force_magnitude", "moment_x", "moment_y", "moment_z", "is_bonded",
                  "is_slipping", "group_a", "material_a", "group_b", "material_b"));

  EXPECT_THAT(row_of(contact_of_all(), {31, 32, 33, 34}),
              ElementsAre(10, 9007199254740991.0, 3, 11, 12, 4, 13, -1, 14, 15, 16, 17, 18, 19, -20,
                          2, 3, 6, 7, 1, 4, 8, 9, 24, 25, 26, 1, 0, 31, 33, 32, 34));
}

TEST(ContactFields, TellSpheresNodesEdgesFacetsAndPlanesApartOnBothSides) {
  const std::vector<std::pair<ContactBody, double>> kinds = {
      {{BodyKind::sphere, 1, Feature(geometry::NodeId{5})}, 0.0},
      {{BodyKind::structure, 1, Feature(geometry::NodeId{5})}, 1.0},
      {{BodyKind::structure, 1, Feature(geometry::EdgeId{5})}, 2.0},
      {{BodyKind::structure, 1, Feature(geometry::FaceId{5})}, 3.0},
      {{BodyKind::plane, 1, {}}, 4.0}};
  for (const auto& [a, kind_a] : kinds) {
    for (const auto& [b, kind_b] : kinds) {
      ContactRecord contact = contact_of_all();
      contact.a = a;
      contact.b = b;
      const std::vector<double> row = row_of(contact);
      EXPECT_EQ(row[2], kind_a);
      EXPECT_EQ(row[5], kind_b);
    }
  }
}

TEST(ContactFields, HaveNamesOfTheirOwnAndUnitsWhereTheyHaveADimension) {
  std::set<std::string> names;
  for (const ContactField& field : contact_fields()) {
    const std::string name(field.name);
    EXPECT_TRUE(names.insert(name).second) << name;
    // Forces are told in N, what is counted or a direction without a unit.
    EXPECT_EQ(field.unit == "N", name.find("_force") != std::string::npos) << name;
    const bool is_vector = std::holds_alternative<ContactField::Vector>(field.value);
    const bool is_number = std::holds_alternative<ContactField::Number>(field.value);
    EXPECT_EQ(field.unit.empty(), (!is_vector && !is_number) || name == "normal") << name;
  }
  const std::vector<CsvColumn> columns = contact_columns();
  const auto moment = std::find_if(columns.begin(), columns.end(), [](const CsvColumn& column) {
    return column.name == "moment_z";
  });
  ASSERT_NE(moment, columns.end());
  EXPECT_EQ(moment->unit, "N m");
}

}  // namespace
}  // namespace plekton::dynamics::contact_fields_test

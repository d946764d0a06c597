// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/contact_fields.hpp"

#include <array>
#include <string>

namespace plekton::dynamics {

using contact::BodyKind;
using contact::ContactBody;
using contact::ContactRecord;
using geometry::Vec3;

namespace {

constexpr std::string_view kKinds =
    "0 a sphere, 1 a node, 2 an edge, 3 a facet of a structure, 4 a plane";

std::int64_t kind_of(const ContactBody& body) {
  if (body.kind == BodyKind::sphere) return 0;
  return body.kind == BodyKind::plane ? 4 : 1 + static_cast<std::int64_t>(body.feature.kind);
}

const std::array<ContactField, 21> kFields = {{
    {{"id", "", "number that a contact keeps as long as it lasts; none is given twice"},
     [](const ContactRecord& c) { return c.id; }},
    {{"kind_a", "", kKinds}, [](const ContactRecord& c) { return kind_of(c.a); }},
    {{"body_a", "", "number of the sphere, connected structure or plane"},
     [](const ContactRecord& c) { return std::int64_t{c.a.index}; }},
    {{"feature_a", "", "number of the node, edge or facet that is deepest; -1 of a plane"},
     [](const ContactRecord& c) { return std::int64_t{c.a.feature.id}; }},
    {{"kind_b", "", kKinds}, [](const ContactRecord& c) { return kind_of(c.b); }},
    {{"body_b", "", "likewise of b"},
     [](const ContactRecord& c) { return std::int64_t{c.b.index}; }},
    {{"feature_b", "", "likewise of b"},
     [](const ContactRecord& c) { return std::int64_t{c.b.feature.id}; }},
    {{"point", "m", "contact point, where the forces act"},
     [](const ContactRecord& c) { return c.point; }},
    {{"normal", "", "unit vector from a to b"}, [](const ContactRecord& c) { return c.normal; }},
    {{"gap", "m", "negative: overlap"}, [](const ContactRecord& c) { return c.gap; }},
    {{"normal_force", "N", "on b"}, [](const ContactRecord& c) { return c.normal_force; }},
    {{"normal_force_magnitude", "N", "its magnitude"},
     [](const ContactRecord& c) { return c.normal_force.norm(); }},
    {{"tangential_force", "N", "on b"}, [](const ContactRecord& c) { return c.tangential_force; }},
    {{"tangential_force_magnitude", "N", "its magnitude"},
     [](const ContactRecord& c) { return c.tangential_force.norm(); }},
    {{"moment", "N m", "on b about the contact point, of rolling and twisting"},
     [](const ContactRecord& c) { return c.moment; }},
    {{"is_bonded", "",
      "1: the bodies stick to each other; between structures every bond has a row of its own, "
      "with what it carries beside the elastic force of their contact"},
     [](const ContactRecord& c) { return std::int64_t{c.is_bonded}; }},
    {{"is_slipping", "", "1: the tangential force is at its limit"},
     [](const ContactRecord& c) { return std::int64_t{c.is_slipping}; }},
    {{"group_a", "",
      "number of the table [[grains]], [[membranes]] or [[planes]], from 0; run.json has the "
      "names"},
     &ContactLabels::group_a},
    {{"material_a", "", "number of the material, from 0; run.json has the names"},
     &ContactLabels::material_a},
    {{"group_b", "", "likewise of b"}, &ContactLabels::group_b},
    {{"material_b", "", "likewise of b"}, &ContactLabels::material_b},
}};

}  // namespace

std::span<const ContactField> contact_fields() {
  return kFields;
}

std::vector<CsvColumn> contact_columns() {
  std::vector<CsvColumn> columns{{"time", "s"}};
  for (const ContactField& field : kFields) {
    const std::string name(field.name), unit(field.unit);
    if (!std::holds_alternative<ContactField::Vector>(field.value)) {
      columns.push_back({name, unit});
      continue;
    }
    for (const char* axis : {"_x", "_y", "_z"}) columns.push_back({name + axis, unit});
  }
  return columns;
}

void fill_contact_row(double time, const ContactRecord& contact, const ContactLabels& labels,
                      std::vector<double>& row) {
  row.assign(1, time);
  for (const ContactField& field : kFields) {
    if (const auto* vector = std::get_if<ContactField::Vector>(&field.value)) {
      const Vec3 value = (*vector)(contact);
      row.insert(row.end(), value.data(), value.data() + 3);
    } else if (const auto* number = std::get_if<ContactField::Number>(&field.value)) {
      row.push_back((*number)(contact));
    } else if (const auto* label = std::get_if<ContactField::Label>(&field.value)) {
      row.push_back(labels.**label);
    } else {
      row.push_back(static_cast<double>(std::get<ContactField::Whole>(field.value)(contact)));
    }
  }
}

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/tracking/contact_record.hpp"
#include "dynamics/output/csv_writer.hpp"
#include "dynamics/output/output_field.hpp"

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace plekton::dynamics {

/// Where the bodies of a contact come from: numbers that the simulation knows nothing of.
struct ContactLabels {
  std::int32_t group_a = -1;  ///< among those of its kind: of grains, membranes or planes
  std::int32_t group_b = -1;
  std::int32_t material_a = -1;
  std::int32_t material_b = -1;
};

/// Something that is told of every contact.
struct ContactField : OutputField {
  using Number = double (*)(const contact::ContactRecord&);
  using Vector = geometry::Vec3 (*)(const contact::ContactRecord&);
  using Whole = std::int64_t (*)(const contact::ContactRecord&);

  using Label = std::int32_t ContactLabels::*;

  std::variant<Number, Vector, Whole, Label> value;
};

/// All of them: the arrays of contacts.pvd and the columns of contacts.csv.
std::span<const ContactField> contact_fields();

/// A column for the time, then one for each field, three for a vector.
std::vector<CsvColumn> contact_columns();
/// What stands in them.
/// @param time  s
/// @param row   is overwritten
void fill_contact_row(double time, const contact::ContactRecord& contact,
                      const ContactLabels& labels, std::vector<double>& row);

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_row.hpp"
#include "dynamics/output/csv_writer.hpp"
#include "dynamics/output/output_field.hpp"

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace plekton::dynamics {

/// Something that is told of every contact.
struct ContactField : OutputField {
  using Number = double (*)(const contact::ContactRow&);
  using Vector = geometry::Vec3 (*)(const contact::ContactRow&);
  using Whole = std::int64_t (*)(const contact::ContactRow&);

  std::variant<Number, Vector, Whole> value;
};

/// All of them: the arrays of contacts.pvd and the columns of contacts.csv.
std::span<const ContactField> contact_fields();

/// A column for the time, then one for each field, three for a vector.
std::vector<CsvColumn> contact_columns();
/// What stands in them.
/// @param time  s
/// @param row   is overwritten
void fill_contact_row(double time, const contact::ContactRow& contact, std::vector<double>& row);

}  // namespace plekton::dynamics

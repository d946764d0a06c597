// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/list_outputs.hpp"

#include "apps/run/history.hpp"
#include "apps/run/measures.hpp"
#include "apps/run/plane_places.hpp"
#include "apps/run/pressures.hpp"
#include "apps/run/reactions.hpp"
#include "apps/run/rigid_motions.hpp"
#include "apps/run/tie_histories.hpp"
#include "dynamics/output/contact_fields.hpp"
#include "dynamics/output/frame_fields.hpp"

#include <fmt/format.h>

#include <ostream>

namespace plekton::apps {
namespace {

void list_field(const dynamics::OutputField& field, std::ostream& out) {
  out << fmt::format("    {:<26} {:<6} {}\n", field.name, field.unit.empty() ? "-" : field.unit,
                     field.what);
}

/// Of any list of fields.
template <class Fields>
OutputTable table_of(std::string_view title, const Fields& fields) {
  return {title, {fields.begin(), fields.end()}};
}

}  // namespace

std::vector<OutputTable> output_tables() {
  using namespace dynamics::frame_fields;
  return {
      table_of("energy.csv, every `history_interval`", history_fields()),
      table_of("reactions.csv, every `reactions_interval`, for each of [[output.reactions]]",
               reaction_fields()),
      table_of("pressures.csv, every `history_interval`, for each load of kind pressure",
               pressure_fields()),
      table_of(
          "rigid_bodies.csv, every `history_interval`, for each of [[rigid_bodies]]: _x, _y, _z",
          rigid_fields()),
      table_of("ties.csv, every `history_interval`, for each of [[ties]]", tie_fields()),
      table_of("ties.csv, for each tie of a table with `each`, as NAME[0].tension",
               single_tie_fields()),
      table_of("measures/NAME.csv, every `history_interval`, for each of [[output.measures]]",
               measure_fields()),
      table_of("planes.csv, every `interval`, for each of [[planes]]", plane_fields()),
      table_of("grains.pvd, every `interval`: points", kOfGrains),
      table_of("membranes.pvd, every `interval`: points", kOfNodes),
      table_of("membranes.pvd: lines and facets; what one of them has not is 0", kOfCells),
      table_of("contacts.pvd, every `interval`: lines; contacts.csv, with `contact_list`",
               dynamics::contact_fields()),
  };
}

void list_outputs(std::ostream& out) {
  out << "Outputs, chosen in [output]; columns and arrays with unit and meaning\n";
  for (const OutputTable& table : output_tables()) {
    out << "  " << table.title << '\n';
    for (const dynamics::OutputField& field : table.fields) list_field(field, out);
  }
}

}  // namespace plekton::apps

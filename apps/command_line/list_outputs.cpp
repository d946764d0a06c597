// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/list_outputs.hpp"

#include "apps/run/history.hpp"
#include "apps/run/plane_places.hpp"
#include "apps/run/pressures.hpp"
#include "apps/run/reactions.hpp"
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

template <class Fields>
void list_file(std::string_view title, const Fields& fields, std::ostream& out) {
  out << "  " << title << '\n';
  for (const dynamics::OutputField& field : fields) list_field(field, out);
}

}  // namespace

void list_outputs(std::ostream& out) {
  using namespace dynamics::frame_fields;
  out << "Outputs, chosen in [output]; columns and arrays with unit and meaning\n";
  list_file("energy.csv, every `history_interval`", history_fields(), out);
  list_file("reactions.csv, every `reactions_interval`, for each of [[output.reactions]]",
            reaction_fields(), out);
  list_file("pressures.csv, every `history_interval`, for each load of kind pressure",
            pressure_fields(), out);
  list_file("planes.csv, every `interval`, for each of [[planes]]", plane_fields(), out);
  list_file("grains.pvd, every `interval`: points", kOfGrains, out);
  list_file("membranes.pvd, every `interval`: points", kOfNodes, out);
  list_file("membranes.pvd: lines and facets; what one of them has not is 0", kOfCells, out);
  list_file("contacts.pvd, every `interval`: lines; contacts.csv, with `contact_list`",
            dynamics::contact_fields(), out);
}

}  // namespace plekton::apps

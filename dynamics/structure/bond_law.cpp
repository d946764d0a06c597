// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/bond_law.hpp"

#include <cmath>
#include <ostream>
#include <sstream>
#include <string>

namespace plekton::dynamics {
namespace {

/// The stiffness of a wire follows from its curve; a section made by wire_section differs from it
/// by rounding.
constexpr double kRounding = 1e-12;

void list_wire(const WireCurve& curve, const BeamBond& bond, const std::string& where,
               std::ostream& problems) {
  const BeamSection& section = bond.section;
  if (section.second_moment != 0.0 || section.torsion_constant != 0.0) {
    problems << where << ": follows the curve of a wire, which neither bends nor twists, but its "
             << "section does; use wire_section\n";
  }
  const double stiffness = section.young_modulus * section.area;
  if (std::abs(stiffness - curve.first_slope()) <= kRounding * curve.first_slope()) return;
  problems << where << ": E A is " << stiffness << " N, but the first piece of its curve has "
           << curve.first_slope() << " N for each unit of strain; use wire_section\n";
}

}  // namespace

void list_problems(std::span<const BondLaw> laws, std::span<const BeamBond> bonds,
                   std::ostream& problems) {
  std::vector<bool> has_law(bonds.size(), false);
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const std::string name = "bond law " + std::to_string(i);
    std::ostringstream own;
    std::visit([&](const auto& law) { list_problems(law, name, own); }, laws[i].law);
    problems << own.str();
    const WireCurve* const curve = std::get_if<WireCurve>(&laws[i].law);
    for (const std::size_t bond : laws[i].bonds) {
      const std::string where = name + ": bond " + std::to_string(bond);
      if (bond >= bonds.size()) {
        problems << where << " does not exist; there are " << bonds.size() << " bonds\n";
        continue;
      }
      if (has_law[bond]) problems << where << " has a law already; give it one\n";
      has_law[bond] = true;
      if (curve && own.str().empty()) list_wire(*curve, bonds[bond], where, problems);
    }
  }
}

}  // namespace plekton::dynamics

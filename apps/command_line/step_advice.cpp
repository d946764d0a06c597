// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/step_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace plekton::apps {
namespace {

using dynamics::StepCause;
using dynamics::StepPart;
using geometry::index_of;
using geometry::NodeId;

/// A bond or facet whose size is below this part of the usual one is what to look at.
constexpr double kSmall = 0.5;
/// What gases and damping take of the step that is worth a line.
constexpr double kShortened = 0.9;

/// In mm where that reads better.
std::string length_text(double length) {
  return length < 0.1 ? fmt::format("{:.3g} mm", 1e3 * length) : fmt::format("{:.3g} m", length);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// m, of a facet of a sheet at rest.
double smallest_height(const dynamics::SheetFacet& facet) {
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(longest, (facet.corners[(i + 1) % 3] - facet.corners[i]).norm());
  return 2.0 * dynamics::area_of(facet) / longest;
}

/// Explains one step.
class StepAdvice {
 public:
  StepAdvice(const Scenario& scenario, const PreparedRun& prepared)
      : scenario_(scenario),
        prepared_(prepared),
        scene_(prepared.simulation->scene()),
        cause_(prepared.simulation->critical_cause()),
        node_(index_of(cause_.step.node)) {
    for (std::size_t i = 0; i < prepared.built.membranes.size(); ++i) {
      const BuiltMembrane& membrane = prepared.built.membranes[i];
      if (node_ >= membrane.first_node && node_ < membrane.first_node + membrane.nodes)
        membrane_ = i;
    }
  }

  std::string text() const {
    std::string text = fmt::format(
        "critical step limited by node {} of {}, {:.3g} kg, as it {}; {:.0f} % of what holds it is "
        "{}\n",
        node_, body(), scene_.properties.mass[node_], cause_.step.rotation ? "turns" : "moves",
        100.0 * cause_.share, part());
    text += fmt::format("  to lengthen it: {}\n", advice());
    if (cause_.step.rotation && membrane_ &&
        scenario_.membranes[*membrane_].nodal_inertia == dynamics::NodalInertia::ball)
      text += fmt::format("  or nodal_inertia = \"length\" of {}, as it is a turn\n",
                          scenario_.membranes[*membrane_].name);
    if (cause_.without_gas_and_damping < kShortened * cause_.without_dashpots)
      text += fmt::format(
          "  dashpots shorten it from {:.4g} s, most where heavy grains meet light nodes: raise "
          "restitution, or make these nodes heavier\n",
          cause_.without_dashpots);
    if (cause_.step.dt < kShortened * cause_.without_gas_and_damping)
      text += fmt::format(
          "  gas and viscous damping shorten it from {:.4g} s: lower the pressure, ratio or rate "
          "of "
          "these loads\n",
          cause_.without_gas_and_damping);
    return text;
  }

 private:
  std::string place() const {
    const Vec3& x = scene_.state.position[node_];
    return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x[0], x[1], x[2]);
  }

  std::string body() const {
    if (membrane_)
      return fmt::format("membrane {} at {}", scenario_.membranes[*membrane_].name, place());
    for (const BuiltRigidBody& rigid : prepared_.built.rigid_bodies) {
      if (index_of(rigid.node) == node_)
        return fmt::format("rigid body {} at {}", rigid.name, place());
    }
    std::size_t sphere = sphere_of_node();
    for (const BuiltGrains& grains : prepared_.built.grains) {
      if (sphere < grains.count) return fmt::format("grains {} at {}", grains.name, place());
      sphere -= grains.count;
    }
    return place();
  }

  std::size_t sphere_of_node() const {
    const auto& spheres = scene_.elements.spheres;
    const auto found = std::find_if(spheres.begin(), spheres.end(), [&](const auto& sphere) {
      return index_of(sphere.nodes[0]) == node_;
    });
    return static_cast<std::size_t>(found - spheres.begin());
  }

  std::string part() const {
    switch (cause_.part.kind) {
      case StepPart::Kind::bond: {
        const dynamics::BeamBond& bond = scene_.bonds[cause_.part.id];
        return fmt::format("bond {}, {} long, of {} radius", cause_.part.id,
                           length_text(bond.length),
                           length_text(std::sqrt(bond.section.area / std::numbers::pi)));
      }
      case StepPart::Kind::sheet_facet:
        return fmt::format("sheet facet {}, {} high where it is narrowest, {} thick",
                           cause_.part.id,
                           length_text(smallest_height(scene_.sheet_facets[cause_.part.id])),
                           length_text(scene_.sheet_facets[cause_.part.id].section.thickness));
      case StepPart::Kind::tie:
        return fmt::format("its tie {}, of {:.3g} N/m", cause_.part.id,
                           scene_.ties[cause_.part.id].stiffness);
      case StepPart::Kind::ball_contact:
        return fmt::format("the contact of nodes {} and {}", index_of(cause_.part.a),
                           index_of(cause_.part.b));
      case StepPart::Kind::surface_contact:
        return fmt::format("the contact of node {} with the surface at node {}",
                           index_of(cause_.part.a), index_of(cause_.part.b));
      case StepPart::Kind::structure_contact:
        return "a contact of its membrane with another, or with itself";
      case StepPart::Kind::plane_contact:
        return "its contact with a plane";
      case StepPart::Kind::coming_contacts:
        return "contacts that may come" + coming();
      case StepPart::Kind::ground_springs:
        return "its springs to ground";
      case StepPart::Kind::pressure:
        return "the pressure on its facets";
      case StepPart::Kind::nothing:
        break;
    }
    return "nothing";
  }

  /// As in ", the stiffest with grains of rock of 5 mm radius".
  std::string coming() const {
    const dynamics::ComingPartner& partner = cause_.part.partner;
    switch (partner.kind) {
      case dynamics::ComingPartner::Kind::balls:
        return fmt::format(", the stiffest with grains of {} of {} radius",
                           scenario_.materials[static_cast<std::size_t>(partner.material)].name,
                           length_text(partner.radius));
      case dynamics::ComingPartner::Kind::structure:
        return ", the stiffest with membrane " + name_of_structure(partner.id);
      case dynamics::ComingPartner::Kind::plane: {
        const std::string& name = scenario_.planes[partner.id].name;
        return ", the stiffest with plane " + (name.empty() ? std::to_string(partner.id) : name);
      }
      case dynamics::ComingPartner::Kind::nothing:
        break;
    }
    return "";
  }

  /// A membrane may be in several pieces, each a structure.
  std::string name_of_structure(std::size_t structure) const {
    const geometry::Surface& surface = prepared_.simulation->surface();
    for (const BuiltMembrane& membrane : prepared_.built.membranes) {
      for (std::size_t n = membrane.first_node; n < membrane.first_node + membrane.nodes; ++n) {
        const auto of_node = surface.structure_of(geometry::id_at<NodeId>(n));
        if (of_node != geometry::StructureId{-1} && index_of(of_node) == structure)
          return membrane.name;
      }
    }
    return std::to_string(structure);
  }

  std::string advice() const {
    switch (cause_.part.kind) {
      case StepPart::Kind::bond:
        return size_advice(scene_.bonds[cause_.part.id].length, median(lengths_of_bonds()), "bond");
      case StepPart::Kind::sheet_facet:
        return size_advice(smallest_height(scene_.sheet_facets[cause_.part.id]),
                           median(heights_of_facets()), "facet");
      case StepPart::Kind::tie:
        return "lower the stiffness of [[ties]], or give the node more mass";
      case StepPart::Kind::ground_springs:
        return "lower the stiffness of loads of kind ground_springs, or give the node more mass";
      case StepPart::Kind::pressure:
        return "lower the pressure, or give the node more mass";
      default:
        return contact_advice();
    }
  }

  /// The step goes with the length of a bond and the square root of density over stiffness.
  std::string size_advice(double size, double usual, std::string_view what) const {
    const std::string& name = scenario_.membranes[membrane_.value()].name;
    if (size < kSmall * usual)
      return fmt::format(
          "half of the {}s of {} are larger than {}, this one is {}: coarsen the mesh there (weld, "
          "target_edge)",
          what, name, length_text(usual), length_text(size));
    return fmt::format(
        "the {}s of {} are all of about this size: a coarser mesh, {} or a larger density of it",
        what, name,
        scenario_.membranes[*membrane_].wire ? "a softer first piece of wire"
                                             : "a lower young_modulus");
  }

  std::string contact_advice() const {
    constexpr std::size_t kMostNames = 8;
    const std::size_t count = scenario_.materials.size();
    std::string names;
    for (std::size_t i = 0; i < std::min(count, kMostNames); ++i)
      names += fmt::format("{}{}", i == 0 ? "" : ", ", scenario_.materials[i].name);
    if (count > kMostNames) names += fmt::format(" and {} others", count - kMostNames);
    const auto& pairs = scenario_.contacts;
    const bool is_given = std::any_of(pairs.begin(), pairs.end(), [](const PairSettings& pair) {
      return pair.contact.springs.normal_stiffness > 0.0 ||
             pair.contact.springs.tangential_stiffness > 0.0;
    });
    return fmt::format("a lower young_modulus of the materials that touch ({}){}, or {}", names,
                       is_given ? " or the stiffness that [[contacts]] give" : "",
                       membrane_
                           ? "more mass in each node of " + scenario_.membranes[*membrane_].name +
                                 " (a coarser mesh, a larger density or areal_mass)"
                           : "larger or heavier grains");
  }

  std::vector<double> lengths_of_bonds() const {
    const auto [first, count] = range_of(&BuiltMembrane::beams, false);
    std::vector<double> lengths;
    for (std::size_t i = first; i < first + count; ++i) lengths.push_back(scene_.bonds[i].length);
    return lengths;
  }

  std::vector<double> heights_of_facets() const {
    const auto [first, count] = range_of(&BuiltMembrane::facets, true);
    std::vector<double> heights;
    for (std::size_t i = first; i < first + count; ++i)
      heights.push_back(smallest_height(scene_.sheet_facets[i]));
    return heights;
  }

  /// The first bond or sheet facet of the membrane, and how many there are.
  std::pair<std::size_t, std::size_t> range_of(std::size_t BuiltMembrane::*count,
                                               bool of_sheets) const {
    std::size_t first = 0;
    for (std::size_t i = 0; i < *membrane_; ++i) {
      if ((scenario_.membranes[i].mode == MembraneMode::continuum) == of_sheets)
        first += prepared_.built.membranes[i].*count;
    }
    return {first, prepared_.built.membranes[*membrane_].*count};
  }

  const Scenario& scenario_;
  const PreparedRun& prepared_;
  const dynamics::Scene& scene_;
  StepCause cause_;
  std::size_t node_;
  std::optional<std::size_t> membrane_;
};

}  // namespace

std::string step_advice(const Scenario& scenario, const PreparedRun& prepared) {
  if (!std::isfinite(prepared.simulation->critical_step().dt)) return "";
  return StepAdvice(scenario, prepared).text();
}

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law_list.hpp"

#include "contact/law/dashpot.hpp"
#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/restitution.hpp"
#include "contact/with_parts.hpp"

#include <array>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace plekton::contact {
namespace {

using Kind = LawParameter::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A parameter of at least 0.
constexpr LawParameter parameter(std::string_view name, Kind kind, double standard,
                                 std::string_view what, double& (*in)(ContactSettings&)) {
  return {name, kind, standard, 0.0, kInfinity, true, " of at least 0", what, in};
}

/// A limit of at least 0 that is not there if nothing is said.
constexpr LawParameter limit(std::string_view name, std::string_view what,
                             double& (*in)(ContactSettings&)) {
  return {name,
          Kind::number,
          kInfinity,
          0.0,
          kInfinity,
          true,
          " of at least 0, or no such key for no limit",
          what,
          in};
}

/// A stiffness that does not follow from the materials.
constexpr LawParameter given_stiffness(std::string_view name, std::string_view what,
                                       double& (*in)(ContactSettings&)) {
  return {name,
          Kind::stiffness,
          0.0,
          0.0,
          kInfinity,
          false,
          " above 0, or no such key for that of the materials",
          what,
          in};
}

constexpr LawParameter kNormalStiffness = given_stiffness(
    "normal_stiffness", "k_n of every contact of the pair, whatever its bodies' size",
    [](ContactSettings& s) -> double& { return s.springs.normal_stiffness; });
constexpr LawParameter kTangentialStiffness = given_stiffness(
    "tangential_stiffness", "k_s; if not given, in the ratio to k_n that the materials have",
    [](ContactSettings& s) -> double& { return s.springs.tangential_stiffness; });
constexpr std::array kSprings{kNormalStiffness, kTangentialStiffness};

constexpr std::array<std::string_view, 2> kRadiusWords{"half_thickness", "curvature"};
constexpr LawChoice kStiffnessRadius{
    "stiffness_radius", kRadiusWords,
    "R of a membrane of facets in E R: half its thickness, or, as it is flat, that of the grain or "
    "bar that it meets",
    [](ContactSettings& s, std::size_t word) {
      using Radius = LinearFrictional::StiffnessRadius;
      s.springs.radius = word == 0 ? Radius::half_thickness : Radius::curvature;
    }};
constexpr std::array kSpringChoices{kStiffnessRadius};

constexpr std::array kAdhesion{parameter(
    "work_of_adhesion", Kind::energy_per_area, 0.0,
    "w; the bodies attract each other with 2 pi w R while they touch, R of their curvature",
    [](ContactSettings& s) -> double& { return s.adhesion.work_of_adhesion; })};

constexpr std::array kCohesion{
    kNormalStiffness, kTangentialStiffness,
    parameter("tensile_strength", Kind::pressure, 0.0,
              "a bond carries this times the square of the smaller radius (no pi)",
              [](ContactSettings& s) -> double& { return s.cohesion.tensile_strength; }),
    parameter("shear_strength", Kind::pressure, 0.0, "the same for shear, beyond friction",
              [](ContactSettings& s) -> double& { return s.cohesion.shear_strength; }),
    parameter("rupture_distance", Kind::length, 0.0,
              "by which a bond yields until it breaks; 0: it breaks at once",
              [](ContactSettings& s) -> double& { return s.cohesion.rupture_distance; })};

constexpr std::array<std::string_view, 2> kBondWords{"new", "start"};
constexpr std::array kCohesionChoices{
    kStiffnessRadius,
    LawChoice{"bonds", kBondWords,
              "which contacts are glued: all when the bodies come to touch (new), or only those of "
              "the first step (start)",
              [](ContactSettings& s, std::size_t word) {
                s.cohesion.bonds = word == 0 ? Bonds::new_contacts : Bonds::at_start;
              }}};

constexpr std::array kCommon{
    parameter("rolling_stiffness", Kind::number, 0.0,
              "alpha: the stiffness of rolling is alpha R_a R_b k_s",
              [](ContactSettings& s) -> double& { return s.rolling.rolling_stiffness; }),
    parameter("twisting_stiffness", Kind::number, 0.0, "the same for twisting about the normal",
              [](ContactSettings& s) -> double& { return s.rolling.twisting_stiffness; }),
    limit("rolling_limit",
          "eta: the moment of rolling is at most eta times the smaller radius times the normal "
          "force",
          [](ContactSettings& s) -> double& { return s.rolling.rolling_limit; }),
    limit("twisting_limit", "the same for twisting",
          [](ContactSettings& s) -> double& { return s.rolling.twisting_limit; }),
    LawParameter{"restitution", Kind::number, 1.0, 0.0, 1.0, false, " above 0 and at most 1",
                 "speed after an impact over that before, by a dashpot along the normal that never "
                 "pulls; 1: none",
                 [](ContactSettings& s) -> double& { return s.restitution; }}};

constexpr std::array<LawEntry, 4> kLaws{
    {{LinearFrictional::name, "linear springs, Coulomb friction (Cundall & Strack 1979)", kSprings,
      kSpringChoices},
     {HertzMindlin::name,
      "elastic bodies by their curvature, no slip inside the contact, Coulomb friction (Johnson "
      "1985)",
      {}},
     {DmtAdhesion::name, "hertz_mindlin with adhesion (Derjaguin, Muller & Toporov 1975)",
      kAdhesion},
     {CohesiveFrictional::name,
      "linear springs glued where they touch, fragile or ductile (Bourrier et al. 2013)", kCohesion,
      kCohesionChoices}}};

}  // namespace

std::span<const LawEntry> contact_laws() noexcept {
  return kLaws;
}

std::span<const LawParameter> common_law_parameters() noexcept {
  return kCommon;
}

namespace {

/// @throws std::invalid_argument
const LawEntry& entry_of(const ContactSettings& settings) {
  if (settings.law < kLaws.size()) return kLaws[settings.law];
  throw std::invalid_argument("contact settings: there is no law " + std::to_string(settings.law) +
                              ", only " + std::to_string(kLaws.size()) +
                              " laws; contact_laws() lists them");
}

/// @throws std::invalid_argument
void require_restitution(double restitution) {
  if (restitution > 0.0 && restitution <= 1.0) return;
  std::ostringstream text;
  text << "contact settings: restitution is " << restitution
       << "; it must be above 0 and at most 1";
  throw std::invalid_argument(text.str());
}

}  // namespace

PropertiesOf<AnyLaw> properties_of(const ContactSettings& settings) {
  const std::string_view name = entry_of(settings).name;
  require_restitution(settings.restitution);
  const bool is_hertz = name == HertzMindlin::name || name == DmtAdhesion::name;
  const Dashpot::Properties dashpot{
      damping_ratio(is_hertz ? SpringKind::hertz : SpringKind::linear, settings.restitution)};
  if (name == HertzMindlin::name) return with_parts<HertzMindlin>({}, settings.rolling, dashpot);
  if (name == DmtAdhesion::name)
    return with_parts<DmtAdhesion>(settings.adhesion, settings.rolling, dashpot);
  if (name == CohesiveFrictional::name) {
    CohesiveFrictional::Properties cohesion = settings.cohesion;
    cohesion.elastic = settings.springs;
    return with_parts<CohesiveFrictional>(cohesion, settings.rolling, dashpot);
  }
  return with_parts<LinearFrictional>(settings.springs, settings.rolling, dashpot);
}

std::optional<Bonds> bonds_of(const ContactSettings& settings) {
  if (entry_of(settings).name != CohesiveFrictional::name) return std::nullopt;
  const CohesiveFrictional::Properties& cohesion = settings.cohesion;
  const bool has_strength = cohesion.tensile_strength > 0.0 || cohesion.shear_strength > 0.0;
  return has_strength ? cohesion.bonds : Bonds::none;
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/law/cohesive_frictional.hpp"
#include "contact/law/dmt_adhesion.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/rolling_twisting.hpp"

#include <optional>
#include <span>
#include <string_view>

/// The contact laws by name, with their parameters: what scenario files may say and `plekton list`
/// prints comes from here.
namespace plekton::contact {

/// What a scenario says about a pair of materials.
struct ContactSettings {
  std::size_t law = 0;                        ///< place in contact_laws()
  LinearFrictional::Properties springs = {};  ///< also of cohesion
  DmtAdhesion::Properties adhesion = {};
  CohesiveFrictional::Properties cohesion = {};  ///< but for its springs
  RollingTwisting::Properties rolling = {};
  double restitution = 1.0;  ///< of an impact along the normal, in (0, 1]
};

struct LawParameter {
  enum class Kind { number, pressure, length, stiffness, energy_per_area };

  std::string_view name;
  Kind kind;
  double standard;  ///< SI, if nothing is said; outside of the range: there is none
  double low;       ///< SI, the least that is allowed
  double high;
  bool with_low;          ///< whether low itself is
  std::string_view text;  ///< of the range, as in " of at least 0"
  std::string_view what;
  double& (*in)(ContactSettings&);
};

/// A parameter that is a word; the first one if nothing is said.
struct LawChoice {
  std::string_view name;
  std::span<const std::string_view> words;
  std::string_view what;
  void (*choose)(ContactSettings&, std::size_t word);
};

struct LawEntry {
  std::string_view name;
  std::string_view what;
  std::span<const LawParameter> parameters;
  std::span<const LawChoice> choices = {};
};

/// The first one is that of pairs of which nothing is said.
std::span<const LawEntry> contact_laws() noexcept;

/// Parameters that go with every law.
std::span<const LawParameter> common_law_parameters() noexcept;

/// Of the law with what goes with it, as far as there is any: linear_frictional with nothing beside
/// it is that law alone.
/// @throws std::invalid_argument for a law that there is none of, or a restitution out of its range;
///         what else is out of its range is found when contacts are made (models.hpp)
PropertiesOf<AnyLaw> properties_of(const ContactSettings& settings);

/// Which contacts are glued; nothing for a law without bonds. Bonds without any strength are none.
/// @throws std::invalid_argument for a law that there is none of
std::optional<Bonds> bonds_of(const ContactSettings& settings);

}  // namespace plekton::contact

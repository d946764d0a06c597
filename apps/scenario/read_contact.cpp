// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace plekton::apps {
namespace {

using contact::LawParameter;

const Dimension& dimension_of(LawParameter::Kind kind) {
  switch (kind) {
    case LawParameter::Kind::pressure:
      return kPressure;
    case LawParameter::Kind::length:
      return kLength;
    case LawParameter::Kind::stiffness:
      return kStiffness;
    case LawParameter::Kind::energy_per_area:
      return kEnergyPerArea;
    case LawParameter::Kind::number:
      break;
  }
  return kNumber;
}

void read_parameters(std::span<const LawParameter> parameters, Section& section,
                     contact::ContactSettings& settings) {
  for (const LawParameter& parameter : parameters) {
    const Range range{parameter.low, parameter.high, parameter.with_low, true, parameter.text};
    parameter.in(settings) =
        section.quantity(parameter.name, {dimension_of(parameter.kind), range}, parameter.standard);
  }
}

void read_choices(std::span<const contact::LawChoice> choices, Section& section,
                  contact::ContactSettings& settings) {
  for (const contact::LawChoice& choice : choices)
    choice.choose(settings, section.choice(choice.name, choice.words, 0));
}

/// The keys that go with a law, and not with all of them.
std::vector<std::string_view> keys_of(const contact::LawEntry& law) {
  std::vector<std::string_view> keys;
  for (const LawParameter& parameter : law.parameters) keys.push_back(parameter.name);
  for (const contact::LawChoice& choice : law.choices) keys.push_back(choice.name);
  return keys;
}

bool has_key(const contact::LawEntry& law, std::string_view key) {
  const std::vector<std::string_view> keys = keys_of(law);
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// As in "\"this\" or \"that\"".
std::string laws_with(std::string_view key) {
  std::string names;
  for (const contact::LawEntry& law : contact::contact_laws()) {
    if (has_key(law, key)) names += fmt::format("{}\"{}\"", names.empty() ? "" : " or ", law.name);
  }
  return names;
}

/// Complains about parameters of laws that were not chosen.
void refuse_others(const contact::LawEntry& chosen, Section& section) {
  std::set<std::string_view> refused;
  for (const contact::LawEntry& law : contact::contact_laws()) {
    for (const std::string_view key : keys_of(law)) {
      if (has_key(chosen, key) || !section.has(key) || !refused.insert(key).second) continue;
      section.complain(key, fmt::format("goes with law = {}, but this pair has \"{}\"; change the "
                                        "law, or leave {} out",
                                        laws_with(key), chosen.name, key));
    }
  }
}

/// Complains about a radius for a stiffness that does not follow from one.
void refuse_two_stiffnesses(const contact::LinearFrictional::Properties& springs,
                            Section& section) {
  if (!(springs.normal_stiffness > 0.0) || !section.has("stiffness_radius")) return;
  section.complain("stiffness_radius",
                   "says how the stiffness follows from the materials, but normal_stiffness gives "
                   "it; leave one of them out");
}

/// For a law that is not known: any parameter may be one of its.
void announce_all(Section& section) {
  for (const contact::LawEntry& law : contact::contact_laws())
    for (const std::string_view key : keys_of(law)) section.has(key);
}

std::vector<std::string_view> names_of_laws() {
  std::vector<std::string_view> names;
  for (const contact::LawEntry& law : contact::contact_laws()) names.push_back(law.name);
  return names;
}

}  // namespace

PairSettings read_contact(Section section, const Known& known, MaterialPairSet& taken) {
  PairSettings pair;
  pair.place = section.place();
  const auto first = read_material_of(section, known, "between");
  const auto second = read_material_of(section, known, "and");
  const std::vector<std::string_view> names = names_of_laws();
  const auto chosen = section.known_choice("law", names, 0);
  pair.contact.law = chosen.value_or(0);
  const contact::LawEntry& law = contact::contact_laws()[pair.contact.law];
  read_parameters(law.parameters, section, pair.contact);
  read_choices(law.choices, section, pair.contact);
  read_parameters(contact::common_law_parameters(), section, pair.contact);
  if (chosen) {
    refuse_others(law, section);
    refuse_two_stiffnesses(pair.contact.springs, section);
  } else {
    announce_all(section);
  }
  section.finish();
  if (!first || !second) return pair;
  std::tie(pair.first, pair.second) = std::minmax(*first, *second);
  if (!taken.emplace(pair.first, pair.second).second) {
    section.complain(
        "and", fmt::format("\"{}\" and \"{}\" have a table [[contacts]] already; "
                           "expected one for each pair of materials",
                           known.materials[pair.first].name, known.materials[pair.second].name));
  }
  return pair;
}

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/shipped_laws.hpp"

namespace plekton::contact {

/// The functions of one law, on their numbers.
template <class Law>
struct LawTable {
  using Properties = AnyLaw::Properties;
  using Parameters = AnyLaw::Parameters;
  using History = AnyLaw::History;
  using ForceOfState = decltype(AnyLaw::Functions::force_of_state);
  using LawParameters = typename Law::Parameters;
  using LawHistory = typename Law::History;

  /// How many numbers a type takes, its last one maybe in part.
  template <class Typed>
  static constexpr std::size_t number_count() noexcept {
    return (sizeof(Typed) + sizeof(double) - 1) / sizeof(double);
  }
  static LawParameters of(const Parameters& p) noexcept { return p.as<LawParameters>(); }
  static Parameters kept(const LawParameters& p) noexcept {
    Parameters parameters;
    parameters.keep(functions, p);
    return parameters;
  }
  /// Of another law, or none: a new one.
  static LawHistory own(const History& history) noexcept {
    return history.law == &functions ? history.as<LawHistory>() : LawHistory{};
  }
  static const AnyLaw::Functions& self() noexcept { return functions; }
  template <class Change>
  static void change(History& history, const Change& to) {
    LawHistory typed = own(history);
    to(typed);
    history.keep(functions, typed);
  }

  static constexpr AnyLaw::Functions functions{
      .name = Law::name,
      .parameter_numbers = number_count<LawParameters>(),
      .history_numbers = number_count<LawHistory>(),
      .has_interaction_range = HasInteractionRange<Law>,
      .list_problems =
          [](const Properties& properties, std::ostream& out) {
            Law::list_problems(properties.as<PropertiesOf<Law>>(), out);
          },
      .combine =
          [](const Properties& properties, const Body& a, const Body& b) {
            return kept(contact::combine<Law>(properties.as<PropertiesOf<Law>>(), a, b));
          },
      .scaled = [](const Parameters& p, double count) { return kept(Law::scaled(of(p), count)); },
      .elastic_normal_force = [](const Parameters& p, double gap) -> double {
        return Law::elastic_normal_force(of(p), gap);
      },
      .elastic_normal_energy = [](const Parameters& p,
                                  double gap) { return Law::elastic_normal_energy(of(p), gap); },
      .normal_stiffness = [](const Parameters& p,
                             double gap) { return Law::normal_stiffness(of(p), gap); },
      .tangential_stiffness = [](const Parameters& p,
                                 double gap) { return Law::tangential_stiffness(of(p), gap); },
      .normal_damping = [](const Parameters& p,
                           double gap) { return Law::normal_damping(of(p), gap); },
      .interaction_range = [](const Parameters& p) { return interaction_range_of<Law>(of(p)); },
      .attraction = [](const Parameters& p) { return Law::attraction(of(p)); },
      .without_attraction =
          [](const Parameters& p) { return kept(Law::without_attraction(of(p))); },
      .end_start =
          [](Properties& properties) {
            auto typed = properties.as<PropertiesOf<Law>>();
            const bool changed = Law::end_start(typed);
            properties.keep(self(), typed);
            return changed;
          },
      .cements = [](const Parameters& p) { return Law::cements(of(p)); },
      .cement =
          [](const Parameters& p, History& history) {
            change(history, [&](LawHistory& typed) { Law::cement(of(p), typed); });
          },
      .of_bond = [](const Parameters& p) { return kept(Law::of_bond(of(p))); },
      .unbonded_part = [](const Parameters& p,
                          double part) { return kept(Law::unbonded_part(of(p), part)); },
      .force =
          [](const Parameters& p, const RelativeMotion& motion, History& history, double dt) {
            LawHistory typed = own(history);
            const ContactForce answer = Law::force(of(p), motion, typed, dt);
            history.keep(self(), typed);
            return answer;
          },
      .tangential_limit =
          [](const Parameters& p, double elastic_force, const History& history) {
            return Law::tangential_limit(of(p), elastic_force, own(history));
          },
      .history_energy = [](const Parameters& p, const History& history) -> double {
        return Law::history_energy(of(p), own(history));
      },
      .other_force =
          [](const Parameters& p, const Vec3& normal, const History& history) {
            return contact::other_force<Law>(of(p), normal, own(history));
          },
      .holds = [](const History& history) { return contact::holds<Law>(own(history)); },
      .moment = [](const History& history,
                   const Vec3& normal) { return moment_of<Law>(own(history), normal); },
      .rotate =
          [](History& history, const FrameRotation& rotation) {
            change(history, [&](LawHistory& typed) { Law::rotate(typed, rotation); });
          },
      .scale_history =
          [](History& history, double factor) {
            change(history, [&](LawHistory& typed) { Law::scale_history(typed, factor); });
          },
      .accumulate_history =
          [](History& history, const History& other, double share) {
            change(history,
                   [&](LawHistory& typed) { Law::accumulate_history(typed, own(other), share); });
          },
      .force_of_state = []() -> ForceOfState {
        if constexpr (TellsForce<Law>)
          return [](const Parameters& p, double gap, const Vec3& normal, const History& history) {
            return Law::force_of_state(of(p), gap, normal, own(history));
          };
        return nullptr;
      }(),
      .combines_radii = [](const Properties& properties) -> bool {
        if constexpr (CombinesRadii<Law>)
          return properties.as<PropertiesOf<Law>>() == PropertiesOf<Law>{};
        return false;
      },
      .advance_spheres = LawLoops<Law>::spheres,
      .advance_batch = LawLoops<Law>::batch(),
      .advance_single_feature = LawLoops<Law>::facets()};
};

template <ContactLaw Law>
AnyLaw::Properties AnyLaw::of(const PropertiesOf<Law>& properties) {
  Properties kept;
  kept.keep(LawTable<Law>::functions, properties);
  return kept;
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/bonds.hpp"
#include "contact/contact_law.hpp"

#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

namespace plekton::contact {

/// Several laws in one scene: every pair of materials has one of them, chosen by its properties.
/// Pairs without properties have the first.
template <ContactLaw... Laws>
struct OneOf {
  static constexpr std::string_view name = "one_of";
  static constexpr bool has_moments = (HasMoments<Laws> || ...);

  /// The choice of a law, with its properties.
  template <class Law>
  struct Chosen {
    PropertiesOf<Law> properties{};
  };
  template <class Law>
  struct ParametersFor {
    using TheLaw = Law;
    typename Law::Parameters values;
  };
  template <class Law>
  struct HistoryFor {
    typename Law::History values{};
  };

  using Properties = std::variant<Chosen<Laws>...>;
  using Parameters = std::variant<ParametersFor<Laws>...>;
  using History = std::variant<HistoryFor<Laws>...>;

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) {
    return std::visit(
        [&]<class Law>(const Chosen<Law>& chosen) -> Parameters {
          return ParametersFor<Law>{contact::combine<Law>(chosen.properties, a, b)};
        },
        properties);
  }
  static Parameters multiplied(const Parameters& parameters, double count) {
    return of_law(parameters, [&]<class Law>(const ParametersFor<Law>& p) -> Parameters {
      return ParametersFor<Law>{Law::multiplied(p.values, count)};
    });
  }

  static double elastic_normal_force(const Parameters& parameters, double gap) {
    return of_law(parameters, [&]<class Law>(const ParametersFor<Law>& p) {
      return Law::elastic_normal_force(p.values, gap);
    });
  }
  static double elastic_normal_energy(const Parameters& parameters, double gap) {
    return of_law(parameters, [&]<class Law>(const ParametersFor<Law>& p) {
      return Law::elastic_normal_energy(p.values, gap);
    });
  }

  static double reach(const Parameters& parameters) {
    return of_law(parameters,
                  []<class Law>(const ParametersFor<Law>& p) { return reach_of<Law>(p.values); });
  }
  static bool holds(const History& history) {
    return std::visit(
        []<class Law>(const HistoryFor<Law>& kept) { return contact::holds<Law>(kept.values); },
        history);
  }

  /// See HasAttraction.
  static double attraction(const Parameters& parameters) {
    return of_law(parameters, []<class Law>(const ParametersFor<Law>& p) {
      return attraction_of<Law>(p.values);
    });
  }
  static Parameters without_attraction(const Parameters& parameters) {
    return of_law(parameters, []<class Law>(const ParametersFor<Law>& p) -> Parameters {
      return ParametersFor<Law>{contact::without_attraction<Law>(p.values)};
    });
  }

  /// See HasStart and HasBonds.
  static bool end_start(Properties& properties) {
    return std::visit(
        []<class Law>(Chosen<Law>& chosen) { return contact::end_start<Law>(chosen.properties); },
        properties);
  }
  static bool glues(const Parameters& parameters) {
    return of_law(parameters, []<class Law>(const ParametersFor<Law>& p) {
      return contact::glues<Law>(p.values);
    });
  }
  static void glue(const Parameters& parameters, History& history) {
    of_law(parameters, [&]<class Law>(const ParametersFor<Law>& p) {
      contact::glue<Law>(p.values, own<Law>(history));
    });
  }
  static Parameters of_bond(const Parameters& parameters) {
    return of_law(parameters, []<class Law>(const ParametersFor<Law>& p) -> Parameters {
      return ParametersFor<Law>{contact::of_bond<Law>(p.values)};
    });
  }
  static Parameters beside_bonds(const Parameters& parameters, double part) {
    return of_law(parameters, [&]<class Law>(const ParametersFor<Law>& p) -> Parameters {
      return ParametersFor<Law>{contact::beside_bonds<Law>(p.values, part)};
    });
  }

  static ContactForce force(const Parameters& parameters, const RelativeMotion& motion,
                            History& history, double dt) {
    return of_law(parameters, [&]<class Law>(const ParametersFor<Law>& p) {
      return Law::force(p.values, motion, own<Law>(history), dt);
    });
  }

  /// See HasMoments.
  static Vec3 moment(const History& history, const Vec3& normal) {
    return std::visit(
        [&]<class Law>(const HistoryFor<Law>& kept) -> Vec3 {
          if constexpr (HasMoments<Law>) return Law::moment(kept.values, normal);
          return Vec3::Zero();
        },
        history);
  }

  /// See TellsTangentialLimit; infinite of a law that does not tell, and of a new history.
  static double tangential_limit(const Parameters& parameters, double elastic_force,
                                 const History& history) {
    return of_law(parameters, [&]<class Law>(const ParametersFor<Law>& p) {
      constexpr double kNone = std::numeric_limits<double>::infinity();
      if constexpr (TellsTangentialLimit<Law>) {
        const auto* kept = std::get_if<HistoryFor<Law>>(&history);
        return kept ? Law::tangential_limit(p.values, elastic_force, kept->values) : kNone;
      } else {
        return kNone;
      }
    });
  }

  static double history_energy(const Parameters& parameters, const History& history) {
    return of_law(parameters, [&]<class Law>(const ParametersFor<Law>& p) {
      const auto* kept = std::get_if<HistoryFor<Law>>(&history);
      return kept ? Law::history_energy(p.values, kept->values) : 0.0;
    });
  }

  static double normal_stiffness(const Parameters& parameters, double gap) {
    return of_law(parameters, [&]<class Law>(const ParametersFor<Law>& p) {
      return Law::normal_stiffness(p.values, gap);
    });
  }
  static double tangential_stiffness(const Parameters& parameters, double gap) {
    return of_law(parameters, [&]<class Law>(const ParametersFor<Law>& p) {
      return Law::tangential_stiffness(p.values, gap);
    });
  }

  static void rotate(History& history, const FrameRotation& rotation) {
    std::visit([&]<class Law>(HistoryFor<Law>& kept) { Law::rotate(kept.values, rotation); },
               history);
  }
  static void add_share(History& history, const History& other, double share) {
    std::visit(
        [&]<class Law>(const HistoryFor<Law>& kept) {
          Law::add_share(own<Law>(history), kept.values, share);
        },
        other);
  }

 private:
  template <class Visit>
  static auto of_law(const Parameters& parameters, Visit&& visit) {
    return std::visit(std::forward<Visit>(visit), parameters);
  }

  /// A new history is one of the first law until its own law looks at it.
  template <class Law>
  static typename Law::History& own(History& history) {
    auto* kept = std::get_if<HistoryFor<Law>>(&history);
    if (kept == nullptr) kept = &history.template emplace<HistoryFor<Law>>();
    return kept->values;
  }
};

}  // namespace plekton::contact

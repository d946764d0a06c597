// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/bonds.hpp"
#include "contact/law/contact_law.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>

namespace plekton::contact {

/// A law that is chosen at run time, for each pair of materials its own: those that come with the
/// library, in any combination, and any other.
///
/// It knows a law by a table of functions, and keeps its properties, parameters and histories as
/// bytes. A history that no law has looked at yet belongs to none: it is new.
struct AnyLaw {
  static constexpr std::string_view name = "any_law";
  static constexpr bool has_moments = true;

  struct Functions;

  /// Numbers of a law, as bytes. A law's types must fit: consist of numbers, and not be larger.
  template <std::size_t kNumbers>
  struct Kept {
    const Functions* law = nullptr;
    alignas(double) std::array<std::byte, kNumbers * sizeof(double)> bytes{};

    /// Plain numbers; Eigen's small vectors are, though not by the letter trivially copyable.
    template <class Typed>
    static constexpr bool fits =
        std::is_trivially_destructible_v<Typed>&& std::is_default_constructible_v<Typed> &&
        sizeof(Typed) <= kNumbers * sizeof(double);

    template <class Typed>
    Typed as() const noexcept {
      static_assert(fits<Typed>);
      Typed typed;
      std::memcpy(static_cast<void*>(&typed), bytes.data(), sizeof typed);
      return typed;
    }
    template <class Typed>
    void keep(const Functions& of, const Typed& typed) noexcept {
      static_assert(fits<Typed>);
      law = &of;
      std::memcpy(bytes.data(), static_cast<const void*>(&typed), sizeof typed);
    }
  };
  struct Properties : Kept<16> {
    Properties() noexcept;  ///< LinearFrictional, with nothing beside its materials
  };
  using Parameters = Kept<18>;
  using History = Kept<18>;

  /// What it knows of a law: the functions of ContactLaw, and those of what a law may have beside.
  struct Functions {
    std::string_view name;
    Parameters (*combine)(const Properties&, const Body&, const Body&);
    Parameters (*multiplied)(const Parameters&, double);
    double (*elastic_normal_force)(const Parameters&, double);
    double (*elastic_normal_energy)(const Parameters&, double);
    double (*normal_stiffness)(const Parameters&, double);
    double (*tangential_stiffness)(const Parameters&, double);
    double (*reach)(const Parameters&);
    double (*attraction)(const Parameters&);
    Parameters (*without_attraction)(const Parameters&);
    bool (*end_start)(Properties&);
    bool (*glues)(const Parameters&);
    void (*glue)(const Parameters&, History&);
    Parameters (*of_bond)(const Parameters&);
    Parameters (*beside_bonds)(const Parameters&, double);
    ContactForce (*force)(const Parameters&, const RelativeMotion&, History&, double);
    double (*tangential_limit)(const Parameters&, double, const History&);
    double (*history_energy)(const Parameters&, const History&);
    bool (*holds)(const History&);
    Vec3 (*moment)(const History&, const Vec3&);
    void (*rotate)(History&, const FrameRotation&);
    void (*add_share)(History&, const History&, double);
  };

  /// A law, with its properties for a pair of materials.
  template <ContactLaw Law>
  static Properties of(const PropertiesOf<Law>& properties = {});

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) {
    return properties.law->combine(properties, a, b);
  }
  static Parameters multiplied(const Parameters& p, double count) {
    return p.law->multiplied(p, count);
  }
  static double elastic_normal_force(const Parameters& p, double gap) {
    return p.law->elastic_normal_force(p, gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) {
    return p.law->elastic_normal_energy(p, gap);
  }
  static double normal_stiffness(const Parameters& p, double gap) {
    return p.law->normal_stiffness(p, gap);
  }
  static double tangential_stiffness(const Parameters& p, double gap) {
    return p.law->tangential_stiffness(p, gap);
  }

  /// See HasReach.
  static double reach(const Parameters& p) { return p.law->reach(p); }
  static bool holds(const History& history) {
    return history.law != nullptr && history.law->holds(history);
  }

  /// See HasAttraction.
  static double attraction(const Parameters& p) { return p.law->attraction(p); }
  static Parameters without_attraction(const Parameters& p) { return p.law->without_attraction(p); }

  /// See HasStart and HasBonds.
  static bool end_start(Properties& properties) { return properties.law->end_start(properties); }
  static bool glues(const Parameters& p) { return p.law->glues(p); }
  static void glue(const Parameters& p, History& history) { p.law->glue(p, history); }
  static Parameters of_bond(const Parameters& p) { return p.law->of_bond(p); }
  static Parameters beside_bonds(const Parameters& p, double part) {
    return p.law->beside_bonds(p, part);
  }

  static ContactForce force(const Parameters& p, const RelativeMotion& motion, History& history,
                            double dt) {
    return p.law->force(p, motion, history, dt);
  }
  /// See HasMoments.
  static Vec3 moment(const History& history, const Vec3& normal) {
    return history.law == nullptr ? Vec3(Vec3::Zero()) : history.law->moment(history, normal);
  }
  /// See TellsTangentialLimit; infinite of a law that does not tell, and of a new history.
  static double tangential_limit(const Parameters& p, double elastic_force,
                                 const History& history) {
    return history.law != p.law ? std::numeric_limits<double>::infinity()
                                : p.law->tangential_limit(p, elastic_force, history);
  }
  static double history_energy(const Parameters& p, const History& history) {
    return history.law != p.law ? 0.0 : p.law->history_energy(p, history);
  }
  static void rotate(History& history, const FrameRotation& rotation) {
    if (history.law != nullptr) history.law->rotate(history, rotation);
  }
  static void add_share(History& history, const History& other, double share) {
    if (other.law != nullptr) other.law->add_share(history, other, share);
  }

 private:
  template <class Law>
  struct Table;
};

/// The functions of one law, on bytes.
template <class Law>
struct AnyLaw::Table {
  using LawParameters = typename Law::Parameters;
  using LawHistory = typename Law::History;

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
  static const Functions& self() noexcept { return functions; }
  template <class Change>
  static void change(History& history, const Change& to) {
    LawHistory typed = own(history);
    to(typed);
    history.keep(functions, typed);
  }

  static constexpr Functions functions{
      .name = Law::name,
      .combine =
          [](const Properties& properties, const Body& a, const Body& b) {
            return kept(contact::combine<Law>(properties.as<PropertiesOf<Law>>(), a, b));
          },
      .multiplied = [](const Parameters& p,
                       double count) { return kept(Law::multiplied(of(p), count)); },
      .elastic_normal_force = [](const Parameters& p, double gap) -> double {
        return Law::elastic_normal_force(of(p), gap);
      },
      .elastic_normal_energy = [](const Parameters& p,
                                  double gap) { return Law::elastic_normal_energy(of(p), gap); },
      .normal_stiffness = [](const Parameters& p,
                             double gap) { return Law::normal_stiffness(of(p), gap); },
      .tangential_stiffness = [](const Parameters& p,
                                 double gap) { return Law::tangential_stiffness(of(p), gap); },
      .reach = [](const Parameters& p) { return reach_of<Law>(of(p)); },
      .attraction = [](const Parameters& p) { return attraction_of<Law>(of(p)); },
      .without_attraction =
          [](const Parameters& p) { return kept(contact::without_attraction<Law>(of(p))); },
      .end_start =
          [](Properties& properties) {
            auto typed = properties.as<PropertiesOf<Law>>();
            const bool changed = contact::end_start<Law>(typed);
            properties.keep(self(), typed);
            return changed;
          },
      .glues = [](const Parameters& p) { return contact::glues<Law>(of(p)); },
      .glue =
          [](const Parameters& p, History& history) {
            change(history, [&](LawHistory& typed) { contact::glue<Law>(of(p), typed); });
          },
      .of_bond = [](const Parameters& p) { return kept(contact::of_bond<Law>(of(p))); },
      .beside_bonds = [](const Parameters& p,
                         double part) { return kept(contact::beside_bonds<Law>(of(p), part)); },
      .force =
          [](const Parameters& p, const RelativeMotion& motion, History& history, double dt) {
            LawHistory typed = own(history);
            const ContactForce answer = Law::force(of(p), motion, typed, dt);
            history.keep(self(), typed);
            return answer;
          },
      .tangential_limit =
          [](const Parameters& p, double elastic_force, const History& history) {
            if constexpr (TellsTangentialLimit<Law>)
              return Law::tangential_limit(of(p), elastic_force, own(history));
            return std::numeric_limits<double>::infinity();
          },
      .history_energy = [](const Parameters& p, const History& history) -> double {
        return Law::history_energy(of(p), own(history));
      },
      .holds = [](const History& history) { return contact::holds<Law>(own(history)); },
      .moment = [](const History& history, const Vec3& normal) -> Vec3 {
        if constexpr (HasMoments<Law>) return Law::moment(own(history), normal);
        return Vec3::Zero();
      },
      .rotate =
          [](History& history, const FrameRotation& rotation) {
            change(history, [&](LawHistory& typed) { Law::rotate(typed, rotation); });
          },
      .add_share =
          [](History& history, const History& other, double share) {
            change(history, [&](LawHistory& typed) { Law::add_share(typed, own(other), share); });
          }};
};

template <ContactLaw Law>
AnyLaw::Properties AnyLaw::of(const PropertiesOf<Law>& properties) {
  Properties kept;
  kept.keep(Table<Law>::functions, properties);
  return kept;
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_law.hpp"
#include "geometry/base/copy_bits.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <iosfwd>
#include <limits>
#include <type_traits>

namespace plekton::contact {

class SingleFeatureBatch;
struct SphereBatch;
struct SphereRange;
struct SphereWork;

/// A law that is chosen at run time, for each pair of materials its own: those that come with the
/// library, in any combination, and any other.
///
/// It knows a law by a table of functions, and keeps its properties, parameters and histories as
/// numbers. A history that no law has looked at yet belongs to none: it is new. Where many contacts
/// are, those of one law go through a loop that knows it as a type (contact/law_table.hpp).
struct AnyLaw {
  static constexpr std::string_view name = "any_law";

  struct Functions;

  /// Numbers of a law, whose types fit in here (contact_law.hpp).
  template <std::size_t kNumbers>
  struct Kept {
    const Functions* law = nullptr;
    std::array<double, kNumbers> numbers{};

    /// Plain numbers; Eigen's small vectors are, though not by the letter trivially copyable.
    template <class Typed>
    static constexpr void require_fit() noexcept {
      static_assert(sizeof(Typed) <= kNumbers * sizeof(double),
                    "a contact law is too large: its Parameters may be of the size of 24 doubles, "
                    "its History and its Properties of 16 each");
      static_assert(std::is_trivially_destructible_v<Typed>,
                    "Parameters, History and Properties of a contact law are plain numbers, which "
                    "are copied bit by bit: no std::vector, std::string or owning pointer");
      static_assert(std::is_default_constructible_v<Typed>,
                    "Parameters, History and Properties of a contact law are made without "
                    "arguments, and filled then");
    }

    template <class Typed>
    Typed as() const noexcept {
      require_fit<Typed>();
      Typed typed;
      std::memcpy(static_cast<void*>(&typed), numbers.data(), sizeof typed);
      return typed;
    }
    template <class Typed>
    void keep(const Functions& of, const Typed& typed) noexcept {
      require_fit<Typed>();
      law = &of;
      geometry::copy_bits(typed, numbers.data());
    }
  };
  // Multiples of 8: read by whole vectors.
  static constexpr std::size_t kMostNumbers = 24;         ///< of parameters
  static constexpr std::size_t kMostHistoryNumbers = 16;  ///< kept with every contact
  struct Properties : Kept<16> {
    Properties() noexcept;  ///< LinearFrictional, with nothing beside its materials
  };
  using Parameters = Kept<kMostNumbers>;
  using History = Kept<kMostHistoryNumbers>;

  /// What it knows of a law: the functions of ContactLaw, and those of what a law may have beside.
  struct Functions {
    std::string_view name;
    std::size_t parameter_numbers;  ///< how many numbers its parameters are
    std::size_t history_numbers;
    bool has_interaction_range;  ///< see HasInteractionRange
    void (*list_problems)(const Properties&, std::ostream&);
    Parameters (*combine)(const Properties&, const Body&, const Body&);
    Parameters (*scaled)(const Parameters&, double);
    double (*elastic_normal_force)(const Parameters&, double);
    double (*elastic_normal_energy)(const Parameters&, double);
    double (*normal_stiffness)(const Parameters&, double);
    double (*tangential_stiffness)(const Parameters&, double);
    double (*normal_damping)(const Parameters&, double);
    double (*interaction_range)(const Parameters&);
    double (*attraction)(const Parameters&);
    Parameters (*without_attraction)(const Parameters&);
    bool (*end_start)(Properties&);
    bool (*cements)(const Parameters&);
    void (*cement)(const Parameters&, History&);
    Parameters (*of_bond)(const Parameters&);
    Parameters (*unbonded_part)(const Parameters&, double);
    ContactForce (*force)(const Parameters&, const RelativeMotion&, History&, double);
    double (*tangential_limit)(const Parameters&, double, const History&);
    double (*history_energy)(const Parameters&, const History&);
    Vec3 (*other_force)(const Parameters&, const Vec3&, const History&);
    bool (*holds)(const History&);
    Vec3 (*moment)(const History&, const Vec3&);
    void (*rotate)(History&, const FrameRotation&);
    void (*scale_history)(History&, double);
    void (*accumulate_history)(History&, const History&, double);
    /// See TellsForce; null of a law that does not tell it.
    Vec3 (*force_of_state)(const Parameters&, double, const Vec3&, const History&);
    /// Whether its parameters follow from materials and radii alone; see CombinesRadii.
    bool (*combines_radii)(const Properties&);

    // Loops with the law known as a type (contact/law_loops.hpp). The last two are null of a law
    // that is not written for contacts side by side.
    void (*advance_spheres)(const SphereRange&, SphereWork&);
    bool (*advance_batch)(SphereBatch&, std::size_t, double);
    void (*advance_single_feature)(SingleFeatureBatch&, const Motion&, double);
  };

  /// A law, with its properties for a pair of materials (contact/law_table.hpp).
  template <ContactLaw Law>
  static Properties of(const PropertiesOf<Law>& properties = {});

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) {
    return properties.law->combine(properties, a, b);
  }
  static Parameters scaled(const Parameters& p, double count) { return p.law->scaled(p, count); }
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

  static void list_problems(const Properties& properties, std::ostream& out) {
    properties.law->list_problems(properties, out);
  }
  static double normal_damping(const Parameters& p, double gap) {
    return p.law->normal_damping(p, gap);
  }

  /// See HasInteractionRange.
  static double interaction_range(const Parameters& p) { return p.law->interaction_range(p); }
  static bool holds(const History& history) {
    return history.law != nullptr && history.law->holds(history);
  }

  static double attraction(const Parameters& p) { return p.law->attraction(p); }
  static Parameters without_attraction(const Parameters& p) { return p.law->without_attraction(p); }

  static bool end_start(Properties& properties) { return properties.law->end_start(properties); }
  static bool cements(const Parameters& p) { return p.law->cements(p); }
  static void cement(const Parameters& p, History& history) { p.law->cement(p, history); }
  static Parameters of_bond(const Parameters& p) { return p.law->of_bond(p); }
  static Parameters unbonded_part(const Parameters& p, double part) {
    return p.law->unbonded_part(p, part);
  }

  static ContactForce force(const Parameters& p, const RelativeMotion& motion, History& history,
                            double dt) {
    return p.law->force(p, motion, history, dt);
  }
  /// See HasMoments.
  static Vec3 moment(const History& history, const Vec3& normal) {
    return history.law == nullptr ? Vec3(Vec3::Zero()) : history.law->moment(history, normal);
  }
  /// Infinite of a new history too.
  static double tangential_limit(const Parameters& p, double elastic_force,
                                 const History& history) {
    return history.law != p.law ? std::numeric_limits<double>::infinity()
                                : p.law->tangential_limit(p, elastic_force, history);
  }
  static double history_energy(const Parameters& p, const History& history) {
    return history.law != p.law ? 0.0 : p.law->history_energy(p, history);
  }
  static Vec3 other_force(const Parameters& p, const Vec3& normal, const History& history) {
    return history.law != p.law ? Vec3(Vec3::Zero()) : p.law->other_force(p, normal, history);
  }
  static void rotate(History& history, const FrameRotation& rotation) {
    if (history.law != nullptr) history.law->rotate(history, rotation);
  }
  static void scale_history(History& history, double factor) {
    if (history.law != nullptr) history.law->scale_history(history, factor);
  }
  static void accumulate_history(History& history, const History& other, double share) {
    if (other.law != nullptr) other.law->accumulate_history(history, other, share);
  }
};

}  // namespace plekton::contact

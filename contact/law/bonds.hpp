// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_law.hpp"

#include <concepts>

namespace plekton::contact {

/// Which contacts a law with bonds glues.
enum class Bonds {
  new_contacts,  ///< all, where the bodies come to touch
  at_start,      ///< those of the first step
  none
};

/// A law that glues bodies. Between structures a bond is a spring of its own between two material
/// points, and the rest of their contact has what it has beside.
///
/// cements(parameters): whether bodies that come to touch stick; cement(parameters, history): the
/// history of ones that do now; of_bond(parameters): what a bond has of a law with parts;
/// unbonded_part(parameters, part): what is left of a contact of which bonds carry all but that
/// part of the tangential force.
template <class Law>
concept HasBonds = requires(const typename Law::Parameters& parameters,
                            typename Law::History& history, double part) {
  { Law::cements(parameters) } -> std::same_as<bool>;
  { Law::cement(parameters, history) } -> std::same_as<void>;
  { Law::of_bond(parameters) } -> std::same_as<typename Law::Parameters>;
  { Law::unbonded_part(parameters, part) } -> std::same_as<typename Law::Parameters>;
};

/// A law whose contacts of the first step are not like later ones. end_start(properties) makes
/// those of the first step the ones of later steps. @returns whether that changed any
template <class Law>
concept HasStart = requires(PropertiesOf<Law>& properties) {
  { Law::end_start(properties) } -> std::same_as<bool>;
};

template <class Law>
bool cements(const typename Law::Parameters& parameters) {
  if constexpr (HasBonds<Law>) {
    return Law::cements(parameters);
  } else {
    return false;
  }
}

template <class Law>
void cement(const typename Law::Parameters& parameters, typename Law::History& history) {
  if constexpr (HasBonds<Law>) Law::cement(parameters, history);
}

template <class Law>
typename Law::Parameters of_bond(const typename Law::Parameters& parameters) {
  if constexpr (HasBonds<Law>) {
    return Law::of_bond(parameters);
  } else {
    return parameters;
  }
}

template <class Law>
typename Law::Parameters unbonded_part(const typename Law::Parameters& parameters, double part) {
  if constexpr (HasBonds<Law>) {
    return Law::unbonded_part(parameters, part);
  } else {
    return parameters;
  }
}

template <class Law>
bool end_start(PropertiesOf<Law>& properties) {
  if constexpr (HasStart<Law>) {
    return Law::end_start(properties);
  } else {
    return false;
  }
}

}  // namespace plekton::contact

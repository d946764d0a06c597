// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/balls/ball_contacts.hpp"

/// Contacts between balls as they are reported.
namespace plekton::contact {

template <ContactLaw Law>
std::size_t BallContacts<Law>::touching() const noexcept {
  std::size_t count = 0;
  for (const Outcome& outcome : outcomes_) count += outcome.touching;
  return count;
}

template <ContactLaw Law>
double BallContacts<Law>::largest_overlap_ratio() const noexcept {
  double deepest = 0.0;
  for (const Outcome& outcome : outcomes_) deepest = std::max(deepest, outcome.largest_ratio());
  return deepest;
}

template <ContactLaw Law>
double BallContacts<Law>::elastic_energy() const {
  double energy = 0.0;
  for_each_lane([&](const geometry::IndexPair&, const Parameters& parameters, const Rows& rows,
                    std::size_t lane) {
    energy += Law::elastic_normal_energy(parameters, rows.gap.number(lane)) +
              Law::history_energy(parameters, rows.memory(lane).history);
  });
  return energy;
}

template <ContactLaw Law>
void BallContacts<Law>::number(std::int64_t& last) {
  PairNumbers::Reader known(numbers_);
  PairNumbers numbers;
  for_each_lane(
      [&](const geometry::IndexPair& pair, const Parameters&, const Rows& rows, std::size_t lane) {
        const auto row = static_cast<std::size_t>(&rows - rows_.data());
        const bool has_one = touched_[row].since_numbered(lane);
        numbers.add(pair, has_one ? known.of(pair) : ++last);
      });
  numbers_ = std::move(numbers);
  for (TouchedLanes& touched : touched_) touched.set_numbered();
}

template <ContactLaw Law>
template <class Visit>
void BallContacts<Law>::for_each_row(Positions x, Visit&& visit) const {
  PairNumbers::Reader numbers(numbers_);
  for_each_lane([&](const geometry::IndexPair& pair, const Parameters& parameters, const Rows& rows,
                    std::size_t lane) {
    const Ball &a = ball(pair.a), &b = ball(pair.b);
    ContactRow row;
    if (touched_[static_cast<std::size_t>(&rows - rows_.data())].since_numbered(lane))
      row.id = numbers.of(pair);
    row.a = {BodyKind::sphere, pair.a, geometry::Feature(a.node)};
    row.b = {BodyKind::sphere, pair.b, geometry::Feature(b.node)};
    row.point_a = x[index_of(a.node)];
    row.point_b = x[index_of(b.node)];
    const ContactMemory<Law> memory = rows.memory(lane);
    row.normal = memory.normal;
    row.gap = rows.gap.number(lane);
    row.point = row.point_a + (a.radius + 0.5 * row.gap) * row.normal;
    set_force(row, rows.force_on_b(lane, parameters));
    if constexpr (HasMoments<Law>) row.moment = Law::moment(memory.history, memory.normal);
    set_state<Law>(row, parameters, memory.history, Law::elastic_normal_force(parameters, row.gap));
    visit(row);
  });
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/yielding_bonds.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <utility>

namespace plekton::dynamics {
namespace {

template <class Bond>
const Bond* find(const std::vector<Bond>& all, std::size_t bond) noexcept {
  const auto place = std::lower_bound(all.begin(), all.end(), bond,
                                      [](const Bond& b, std::size_t i) { return b.bond < i; });
  return place != all.end() && place->bond == bond ? &*place : nullptr;
}

template <class Bond>
void sort_by_bond(std::vector<Bond>& all) {
  std::sort(all.begin(), all.end(), [](const Bond& a, const Bond& b) { return a.bond < b.bond; });
}

}  // namespace

YieldingBonds::YieldingBonds(std::vector<BondLaw> laws, std::span<const BeamBond> bonds) {
  for (BondLaw& law : laws) {
    if (auto* const curve = std::get_if<WireCurve>(&law.law)) {
      for (const std::size_t bond : law.bonds)
        wires_.push_back({bond, curves_.size(), bonds[bond].length, {bonds[bond].length}});
      curves_.push_back(std::move(*curve));
      continue;
    }
    const BondStrength& strength = std::get<BondStrength>(law.law);
    for (const std::size_t bond : law.bonds)
      beams_.push_back({bond, limits_of(strength, bonds[bond]), {}});
  }
  sort_by_bond(beams_);
  sort_by_bond(wires_);
  breaks_.assign(beams_.size() + wires_.size() > 0 ? bonds.size() : 0, 0);
  broken_.reserve(beams_.size() + wires_.size());
}

void YieldingBonds::yield_one(Beam& beam, BeamBonds& bonds, const Drifted& to) noexcept {
  const BeamSpringOf<double> before = bonds.spring(beam.bond);
  BeamSpringOf<double> spring = before;
  if (yield(bonds.ends(beam.bond, to.state), beam.limits, spring, beam.memory))
    bonds.set_spring(beam.bond, spring);
  if (!is_broken(beam.limits, beam.memory)) return;
  breaks_[beam.bond] = 1;
  beam.memory.dissipated +=
      bonds.lost_by_break(beam.bond, before, to.state, to.drift) - beam.memory.loss;
}

void YieldingBonds::yield_one(Wire& wire, BeamBonds& bonds, const Drifted& to) noexcept {
  const BeamSpringOf<double> before = bonds.spring(wire.bond);
  BeamSpringOf<double> spring = before;
  const double length = bonds.ends(wire.bond, to.state).chord.norm();
  if (yield(length, wire.length, curves_[wire.curve], spring, wire.memory)) {
    breaks_[wire.bond] = 1;
    wire.memory.dissipated += bonds.lost_by_break(wire.bond, before, to.state, to.drift);
  }
  bonds.set_spring(wire.bond, spring);
}

template <class Bond>
void YieldingBonds::yield_all(std::vector<Bond>& all, BeamBonds& bonds, const Drifted& to,
                              geometry::ThreadPool& pool) {
  if (all.empty()) return;
  pool.for_each_range(all.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!bonds.is_broken(all[i].bond)) yield_one(all[i], bonds, to);
    }
  });
}

template <class Bond>
void YieldingBonds::break_all(const std::vector<Bond>& all, BeamBonds& bonds) noexcept {
  for (const Bond& one : all) {
    if (breaks_[one.bond] == 0) continue;
    breaks_[one.bond] = 0;
    bonds.break_bond(one.bond);
    broken_.push_back(one.bond);
  }
}

void YieldingBonds::advance(BeamBonds& bonds, const NodeState& state, double drift,
                            geometry::ThreadPool& pool) {
  if (breaks_.empty()) return;
  const Drifted to{state, drift};
  yield_all(beams_, bonds, to, pool);
  yield_all(wires_, bonds, to, pool);
  broken_.clear();
  break_all(beams_, bonds);
  break_all(wires_, bonds);
  std::sort(broken_.begin(), broken_.end());
}

BondForces YieldingBonds::forces_of(std::size_t bond, const BeamBonds& bonds,
                                    const NodeState& state) const noexcept {
  const BeamEndsOf<double> ends = bonds.ends(bond, state);
  BeamSpringOf<double> spring = bonds.spring(bond);
  bool breaks = bonds.is_broken(bond);
  if (const Beam* const beam = find(beams_, bond)) {
    BeamYield memory = beam->memory;
    yield(ends, beam->limits, spring, memory);
    breaks = breaks || is_broken(beam->limits, memory);
  } else if (const Wire* const wire = find(wires_, bond)) {
    WireYield memory = wire->memory;
    breaks = yield(ends.chord.norm(), wire->length, curves_[wire->curve], spring, memory) || breaks;
  }
  return breaks ? BondForces{} : bond_forces(spring, ends);
}

double YieldingBonds::dissipated() const noexcept {
  double sum = 0.0;
  for (const Beam& beam : beams_) sum += beam.memory.dissipated;
  for (const Wire& wire : wires_) sum += wire.memory.dissipated;
  return sum;
}

double YieldingBonds::dissipated(std::size_t bond) const noexcept {
  if (const Beam* const beam = find(beams_, bond)) return beam->memory.dissipated;
  const Wire* const wire = find(wires_, bond);
  return wire ? wire->memory.dissipated : 0.0;
}

void YieldingBonds::forget_dissipated() noexcept {
  for (Beam& beam : beams_) beam.memory.dissipated = 0.0;
  for (Wire& wire : wires_) wire.memory.dissipated = 0.0;
}

double YieldingBonds::plastic_strain(std::size_t bond) const noexcept {
  if (const Beam* const beam = find(beams_, bond))
    return beam->memory.stretch / beam->limits.length;
  const Wire* const wire = find(wires_, bond);
  return wire ? wire->memory.rest_length / wire->length - 1.0 : 0.0;
}

void YieldingBonds::exchange(const geometry::StateArchive& archive) {
  std::vector<BeamYield> beams;
  for (const Beam& beam : beams_) beams.push_back(beam.memory);
  std::vector<WireYield> wires;
  for (const Wire& wire : wires_) wires.push_back(wire.memory);
  archive.rows("beams", beams, [](geometry::RowFields& row, BeamYield& memory) {
    row("stretch", memory.stretch);
    row("turn_a", memory.turn_a);
    row("turn_b", memory.turn_b);
    row("twist", memory.twist);
    row("tension", memory.forces.tension);
    row("shear", memory.forces.shear);
    row("moment_a", memory.forces.moment_a);
    row("moment_b", memory.forces.moment_b);
    row("torque", memory.forces.torque);
    row("loss", memory.loss);
    row("dissipated", memory.dissipated);
  });
  archive.rows("wires", wires, [](geometry::RowFields& row, WireYield& memory) {
    row("rest_length", memory.rest_length);
    row("force", memory.force);
    row("dissipated", memory.dissipated);
  });
  if (beams.size() != beams_.size() || wires.size() != wires_.size())
    throw geometry::StateMismatch(
        "the state has another number of bonds that yield than there are here");
  for (std::size_t i = 0; i < beams.size(); ++i) beams_[i].memory = beams[i];
  for (std::size_t i = 0; i < wires.size(); ++i) wires_[i].memory = wires[i];
}

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/laws/any_law.hpp"
#include "dynamics/simulation.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace plekton::apps {

/// A simulation as a run sees it, whatever its contact laws are. Its functions are those of
/// dynamics::Simulation of the same names.
class Simulation {
 public:
  Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  virtual ~Simulation() = default;

  virtual bool step_until(double end) = 0;
  virtual double time() const = 0;
  virtual std::int64_t steps() const = 0;
  virtual double time_step() const = 0;
  virtual void set_time_step(double dt) = 0;

  virtual const dynamics::Scene& scene() const = 0;
  virtual const dynamics::NodeState& state() const = 0;
  virtual const dynamics::NodeProperties& properties() const = 0;
  virtual const geometry::Elements& elements() const = 0;
  virtual const std::vector<contact::Plane>& planes() const = 0;
  virtual const dynamics::BeamBonds& bonds() const = 0;
  virtual const dynamics::SheetFacets& sheet_facets() const = 0;
  virtual const dynamics::AppliedLoads& loads() const = 0;
  virtual const dynamics::NodeForces& forces() const = 0;
  virtual const geometry::Vec3& gravity() const = 0;
  virtual const geometry::Surface& surface() const = 0;

  virtual dynamics::Energy energy() const = 0;
  virtual void check_energy() = 0;
  virtual dynamics::CriticalStep critical_step() const = 0;
  /// What the present step has to keep to: a given one to contacts that may come too.
  virtual dynamics::CriticalStep limit_of_step() const = 0;
  virtual dynamics::StepCause critical_cause() const = 0;
  virtual dynamics::ExactStep exact_critical_step() const = 0;
  virtual double motion_ratio() const = 0;
  virtual double largest_overlap_ratio() const = 0;
  virtual std::int64_t pass_throughs() const = 0;
  virtual std::size_t most_crossings() const = 0;

  virtual contact::ContactCounts contact_counts() const = 0;
  /// Of the last step.
  virtual double present_overlap_ratio() const = 0;
  virtual const geometry::Neighbours& neighbours() const = 0;

  virtual std::vector<contact::ContactRow> list_contacts() = 0;
  /// The same without giving numbers.
  virtual std::vector<contact::ContactRow> contacts_as_they_are() const = 0;
  virtual std::vector<geometry::Vec3> force_positions() const = 0;
  virtual geometry::Vec3 force_point(std::size_t plane) const = 0;
  virtual dynamics::ForceAndMoment plane_reaction(std::size_t plane) const = 0;
  virtual dynamics::ForceAndMoment support_reaction(std::span<const geometry::NodeId> nodes,
                                                    const geometry::Vec3& about) const = 0;
  virtual double unbalanced_force_ratio() const = 0;
  virtual std::vector<dynamics::FacetTraction> facet_tractions() = 0;
  virtual dynamics::BondStress bond_stress(std::size_t bond) const = 0;
};

template <contact::ContactLaw Law>
class SimulationUnder final : public Simulation {
 public:
  SimulationUnder(dynamics::Scene scene, const dynamics::SimulationOptions& options,
                  const contact::PairProperties<Law>& properties)
      : simulation_(std::move(scene), options, properties) {}

  bool step_until(double end) override { return simulation_.step_until(end); }
  double time() const override { return simulation_.time(); }
  std::int64_t steps() const override { return simulation_.steps(); }
  double time_step() const override { return simulation_.time_step(); }
  void set_time_step(double dt) override { simulation_.set_time_step(dt); }

  const dynamics::Scene& scene() const override { return simulation_.scene(); }
  const dynamics::NodeState& state() const override { return simulation_.state(); }
  const dynamics::NodeProperties& properties() const override { return simulation_.properties(); }
  const geometry::Elements& elements() const override { return simulation_.elements(); }
  const std::vector<contact::Plane>& planes() const override { return simulation_.planes(); }
  const dynamics::BeamBonds& bonds() const override { return simulation_.bonds(); }
  const dynamics::SheetFacets& sheet_facets() const override { return simulation_.sheet_facets(); }
  const dynamics::AppliedLoads& loads() const override { return simulation_.loads(); }
  const dynamics::NodeForces& forces() const override { return simulation_.forces(); }
  const geometry::Vec3& gravity() const override { return simulation_.gravity(); }
  const geometry::Surface& surface() const override { return simulation_.surface(); }

  dynamics::Energy energy() const override { return simulation_.energy(); }
  void check_energy() override { simulation_.check_energy(); }
  dynamics::CriticalStep critical_step() const override { return simulation_.critical_step(); }
  dynamics::CriticalStep limit_of_step() const override {
    return simulation_.chooses_time_step() ? simulation_.present_critical_step()
                                           : simulation_.critical_step();
  }
  dynamics::StepCause critical_cause() const override { return simulation_.critical_cause(); }
  dynamics::ExactStep exact_critical_step() const override {
    return simulation_.exact_critical_step();
  }
  double motion_ratio() const override { return simulation_.motion_ratio(); }
  double largest_overlap_ratio() const override { return simulation_.largest_overlap_ratio(); }
  std::int64_t pass_throughs() const override { return simulation_.pass_throughs(); }
  std::size_t most_crossings() const override { return simulation_.most_crossings(); }

  contact::ContactCounts contact_counts() const override { return simulation_.contacts().counts(); }
  double present_overlap_ratio() const override {
    return simulation_.contacts().largest_overlap_ratio();
  }
  const geometry::Neighbours& neighbours() const override {
    return simulation_.contacts().neighbours();
  }

  std::vector<contact::ContactRow> list_contacts() override { return simulation_.list_contacts(); }
  std::vector<contact::ContactRow> contacts_as_they_are() const override {
    std::vector<contact::ContactRow> rows;
    simulation_.contacts().for_each_row(
        simulation_.force_positions(),
        [&](const contact::ContactRow& row) { rows.push_back(row); });
    return rows;
  }
  std::vector<geometry::Vec3> force_positions() const override {
    return simulation_.force_positions();
  }
  geometry::Vec3 force_point(std::size_t plane) const override {
    return simulation_.force_point(plane);
  }
  dynamics::ForceAndMoment plane_reaction(std::size_t plane) const override {
    return simulation_.plane_reaction(plane);
  }
  dynamics::ForceAndMoment support_reaction(std::span<const geometry::NodeId> nodes,
                                            const geometry::Vec3& about) const override {
    return simulation_.support_reaction(nodes, about);
  }
  double unbalanced_force_ratio() const override { return simulation_.unbalanced_force_ratio(); }
  std::vector<dynamics::FacetTraction> facet_tractions() override {
    return simulation_.facet_tractions();
  }
  dynamics::BondStress bond_stress(std::size_t bond) const override {
    return simulation_.bond_stress(bond);
  }

 private:
  dynamics::Simulation<Law> simulation_;
};

}  // namespace plekton::apps

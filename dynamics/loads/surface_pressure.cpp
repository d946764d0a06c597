// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/surface_pressure.hpp"

#include "geometry/base/elementary.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plekton::dynamics {
namespace {

using geometry::Positions;
using Corners = std::array<NodeId, 3>;

/// Six times the volume (m³) between a facet and a point.
double six_volumes(const Corners& corners, const Vec3& point, Positions x) noexcept {
  const Vec3 a = x[index_of(corners[0])] - point;
  const Vec3 b = x[index_of(corners[1])] - point;
  const Vec3 c = x[index_of(corners[2])] - point;
  return a.dot(b.cross(c));
}

std::optional<TimeTable> table_of(const std::optional<PressureByVolume>& pressure) {
  if (!pressure) return std::nullopt;
  std::vector<TimeTable::Row> rows;
  for (const auto& [volume, value] : pressure->rows) rows.push_back({volume, value});
  return TimeTable(std::move(rows));
}

std::vector<Corners> corners_of(const SurfacePressure& load,
                                std::span<const geometry::Facet> facets) {
  std::vector<Corners> corners;
  for (const geometry::FaceId facet : load.facets) corners.push_back(facets[index_of(facet)].nodes);
  return corners;
}

}  // namespace

double volume_under(std::span<const Corners> facets, Positions x) {
  double sum = 0.0;
  for (const Corners& corners : facets) sum += six_volumes(corners, x[index_of(facets[0][0])], x);
  return sum / 6.0;
}

Vec3 area_share(const Corners& facet, Positions x) noexcept {
  const Vec3& origin = x[index_of(facet[0])];
  return (x[index_of(facet[1])] - origin).cross(x[index_of(facet[2])] - origin) / 6.0;
}

PressedSurface::PressedSurface(const SurfacePressure& load, std::span<const geometry::Facet> facets,
                               const NodeState& at_start)
    : load_(load),
      is_by_volume_(load.by_volume.has_value()),
      by_volume_(table_of(load.by_volume)),
      members_(corners_of(load, facets)),
      nodes_(members_.nodes()),
      shares_(load.facets.size()) {
  if (follows_volume()) volume_ = volume_under(members_.groups(), at_start.position);
  start_volume_ = load_.start_volume.value_or(volume_);
  pressure_ = pressure_at(load_.factor.start(), volume_);
}

void PressedSurface::follow(const geometry::SurfaceChange& change) {
  std::vector<geometry::FaceId> facets;
  std::vector<Corners> corners;
  for (const geometry::FaceId facet : load_.facets) {
    const auto left = change.now(geometry::Feature(facet));
    if (!left) continue;
    facets.push_back(geometry::FaceId{left->id});
    corners.push_back(change.after().nodes_of(facets.back()));
  }
  const bool is_torn = facets.size() < load_.facets.size();
  load_.facets = std::move(facets);
  if (!is_torn) return;
  if (load_.facets.empty()) pressure_ = 0.0;
  if (follows_volume()) {
    load_ = SurfacePressure{};
    by_volume_.reset();
    corners.clear();
    pressure_ = 0.0;
  }
  members_ = NodeMembers<3>(std::move(corners));
  nodes_ = LoadedNodes(members_.nodes());
  shares_.resize(load_.facets.size());
}

/// Pa
double PressedSurface::pressure_at(double time, double volume) const {
  if (by_volume_) return load_.factor.at(time) * by_volume_->at(volume);
  const double pressure = load_.factor.at(time) * load_.pressure;
  if (!load_.gas) return pressure;
  const double outside = load_.gas->outside_pressure;
  return (outside + pressure) * elementary::pow(start_volume_ / volume, load_.gas->exponent) -
         outside;
}

/// Pa, over the outside: of the table at any time, or of now if the gas has been compressed.
double PressedSurface::largest_pressure() const noexcept {
  const double full = by_volume_ ? by_volume_->largest() : load_.pressure;
  return std::max(std::abs(load_.factor.largest() * full), std::abs(pressure_));
}

LoadedNodes& PressedSurface::act(const LoadStep& step, const NodeState& state,
                                 geometry::ThreadPool& pool) {
  if (shares_.empty()) return nodes_;  // all are gone
  const Positions x = state.position;
  const Vec3 origin = x[index_of(members_.nodes().front())];
  const double six = sum_(shares_.size(), pool, [&](std::size_t begin, std::size_t end, int) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      shares_[i] = area_share(members_.groups()[i], x);
      if (follows_volume()) sum += six_volumes(members_.groups()[i], origin, x);
    }
    return sum;
  });
  volume_ = six / 6.0;
  pressure_ = pressure_at(step.time, volume_);
  nodes_.set(pool, [&](std::size_t i) {
    Vec3 area = Vec3::Zero();
    for (const auto& member : members_.of(i)) area += shares_[member.group];
    return LoadedNodes::Force{pressure_ * area};
  });
  return nodes_;
}

double PressedSurface::gas_frequency_squared(Positions x, const NodeProperties& properties) const {
  if (!follows_volume()) return 0.0;
  double sum = 0.0;  // m⁴/kg
  for (std::size_t i = 0; i < members_.nodes().size(); ++i) {
    const std::size_t node = index_of(members_.nodes()[i]);
    if (holds_translation(properties.held[node])) continue;
    Vec3 area = Vec3::Zero();
    for (const auto& member : members_.of(i))
      area += area_share(members_.groups()[member.group], x);
    sum += area.squaredNorm() / properties.mass[node];
  }
  // A pressure that grows with the volume only makes the surface softer.
  if (by_volume_) return load_.factor.largest() * by_volume_->largest_slope() * sum;
  const double absolute = load_.gas->outside_pressure + largest_pressure();
  return load_.gas->exponent * absolute / volume_ * sum;
}

void PressedSurface::exchange(const geometry::StateArchive& archive) {
  archive("volume", volume_);
  archive("pressure", pressure_);
}

}  // namespace plekton::dynamics

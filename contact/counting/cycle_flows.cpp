// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/cycle_flows.hpp"

#include "geometry/base/pack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plekton::contact {
namespace {

/// Room for a number of entries; it only grows, by half at least.
std::span<double> room_for(std::vector<double>& room, std::size_t count) {
  if (room.size() < count) room.resize(std::max(count, room.size() + room.size() / 2));
  return {room.data(), count};
}

/// Eight sums side by side, whatever vectors the processor has: the same order everywhere.
double dot(std::span<const double> a, std::span<const double> b) noexcept {
  using Lanes = geometry::Pack<8>;
  const std::size_t whole = a.size() - a.size() % 8;
  Lanes lanes = 0.0;
  for (std::size_t i = 0; i < whole; i += 8)
    lanes = lanes + Lanes::load(a.data() + i) * Lanes::load(b.data() + i);
  std::array<double, 8> sums;
  lanes.store(sums.data());
  for (std::size_t i = whole; i < a.size(); ++i) sums[i - whole] += a[i] * b[i];
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

}  // namespace

void CycleFlows::build(std::uint32_t vertex_count, std::span<const Link> links,
                       std::span<const Filling> fillings) {
  vertex_count_ = vertex_count;
  all_links_.assign(links.begin(), links.end());
  is_planned_ = false;
  has_fillings_ = !fillings.empty();
  basis_.build(vertex_count, links, fillings);
}

std::size_t CycleFlows::find(const ComplexPart& part, std::uint32_t end,
                             std::span<const double> resistances) {
  hole_count_ = basis_.hole_count(part);
  flow_count_ = end == CycleBasis::kNone ? hole_count_ : basis_.shut_count(part, end);
  if (flow_count_ == 0) return 0;
  if (!is_planned_) elimination_.plan(vertex_count_, all_links_);
  is_planned_ = true;
  links_.clear();
  conductances_.clear();
  for (std::size_t i = 0; i < resistances.size(); ++i) {
    links_.push_back({all_links_[i].a, all_links_[i].b, resistances[i]});
    conductances_.push_back(1.0 / resistances[i]);
  }
  is_graph_ = !has_fillings_ && end == CycleBasis::kNone;
  if (is_graph_) {
    elimination_.eliminate(part.vertex_count, conductances_);
    return flow_count_;
  }
  find_currents(part, end);
  factor_products();
  find_flows(end == CycleBasis::kNone);
  return flow_count_;
}

/// A set of flows, neither orthogonal nor of length 1, and their products.
void CycleFlows::find_currents(const ComplexPart& part, std::uint32_t end) {
  elimination_.eliminate(part.vertex_count, conductances_);
  const std::size_t links = links_.size();
  const std::size_t joins = elimination_.join_count();
  const auto currents = room_for(currents_, hole_count_ * links);
  const auto differences = room_for(differences_, hole_count_ * joins);
  basis_.find_drops(part, end == CycleBasis::kNone ? part.filling_count : end, links_, currents,
                    room_for(shut_, hole_count_ * flow_count_));
  const auto products = room_for(factor_, hole_count_ * hole_count_);
  auto& weighed = rest_;
  for (std::size_t k = 0; k < hole_count_; ++k) {
    const auto drops = currents.subspan(k * links, links);
    const auto of_hole = differences.subspan(k * joins, joins);
    elimination_.relax(drops, of_hole);
    for (std::size_t i = 0; i < links; ++i) drops[i] *= conductances_[i];
    weighed.clear();
    for (std::size_t j = 0; j < joins; ++j) weighed.push_back(elimination_.weight(j) * of_hole[j]);
    for (std::size_t i = 0; i <= k; ++i)
      products[k * hole_count_ + i] = dot(weighed, differences.subspan(i * joins, joins));
  }
}

/// In units in which the diagonal is 1, so that holes may be of any sizes.
void CycleFlows::factor_products() {
  const std::size_t n = hole_count_;
  units_.clear();
  for (std::size_t k = 0; k < n; ++k) {
    double* const row = factor_.data() + k * n;
    units_.push_back(1.0 / std::sqrt(row[k]));
    for (std::size_t i = 0; i <= k; ++i) row[i] *= units_[k] * units_[i];
    for (std::size_t i = 0; i <= k; ++i) {
      const double* const other = factor_.data() + i * n;
      double rest = row[i];
      for (std::size_t j = 0; j < i; ++j) rest -= row[j] * other[j];
      // Flows that depend on each other but for rounding: no matter which of them.
      row[i] = i < k ? rest / other[i]
                     : std::sqrt(std::max(rest, std::numeric_limits<double>::epsilon()));
    }
  }
}

void CycleFlows::solve_lower(std::span<double> row) const noexcept {
  for (std::size_t k = 0; k < hole_count_; ++k) {
    const double* const factors = factor_.data() + k * hole_count_;
    double rest = row[k];
    for (std::size_t j = 0; j < k; ++j) rest -= factors[j] * row[j];
    row[k] = rest / factors[k];
  }
}

void CycleFlows::solve_upper(std::span<double> row) const noexcept {
  for (std::size_t k = hole_count_; k-- > 0;) {
    row[k] /= factor_[k * hole_count_ + k];
    for (std::size_t j = 0; j < k; ++j) row[j] -= factor_[k * hole_count_ + j] * row[k];
  }
}

/// Flows orthogonal to those that a step leaves have with a cycle that it fills the product that
/// the cycle has with them: with the factor L of the products and the sums s round such a cycle
/// their coefficients are L^-T of a combination of L^-1 s.
void CycleFlows::find_flows(bool all) {
  const std::size_t n = hole_count_;
  room_for(gone_, flow_count_ * n);
  room_for(flows_, flow_count_ * links_.size());
  for (std::size_t f = 0; f < flow_count_; ++f) {
    const auto mine = std::span(gone_).subspan(f * n, n);
    for (std::size_t k = 0; k < n; ++k)
      mine[k] = all ? (k == f ? 1.0 : 0.0) : units_[k] * shut_[k * flow_count_ + f];
    if (!all) {
      solve_lower(mine);
      for (int twice = 0; twice < 2; ++twice) {
        for (std::size_t i = 0; i < f; ++i) {
          const auto other = std::span(gone_).subspan(i * n, n);
          const double part = dot(mine, other);
          for (std::size_t k = 0; k < n; ++k) mine[k] -= part * other[k];
        }
        const double length = std::sqrt(dot(mine, mine));
        for (double& entry : mine) entry /= length;
      }
    }
    row_.assign(mine.begin(), mine.end());
    solve_upper(row_);
    std::fill_n(flow(f).begin(), links_.size(), 0.0);
    add_currents(row_, flow(f));
  }
}

/// @param coefficients  by hole, in units of its own
void CycleFlows::add_currents(std::span<const double> coefficients,
                              std::span<double> flow) const noexcept {
  for (std::size_t k = 0; k < hole_count_; ++k) {
    const double factor = units_[k] * coefficients[k];
    const auto of_hole = current(k);
    for (std::size_t i = 0; i < flow.size(); ++i) flow[i] += factor * of_hole[i];
  }
}

std::span<const double> CycleFlows::shares(std::span<const double> values) {
  shares_.assign(links_.size(), 0.0);
  if (is_graph_) {
    slopes_.resize(links_.size());
    elimination_.leave_out(values, shares_, slopes_);
    for (std::size_t i = 0; i < links_.size(); ++i) slopes_[i] *= -conductances_[i];
    return shares_;
  }
  for (std::size_t f = 0; f < flow_count_; ++f) {
    const auto mine = flow(f);
    for (std::size_t i = 0; i < links_.size(); ++i)
      shares_[i] += links_[i].resistance * mine[i] * mine[i];
  }
  return shares_;
}

double CycleFlows::sum_of_products(std::span<const double> a, std::span<const double> b,
                                   std::span<const double> values) const noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += links_[i].resistance * values[i] * a[i] * b[i];
  return sum;
}

/// What of value * flow goes round filled cycles: what is left when the part that has a potential
/// and the flows round holes are taken off. Left in rest_.
void CycleFlows::take_off_other_flows(std::span<const double> values,
                                      std::span<const double> flow) {
  // Most often the values on a cycle are about the same, and of a constant nothing is left.
  const double mean = sum_of_products(flow, flow, values);
  rest_.clear();
  for (std::size_t i = 0; i < links_.size(); ++i)
    rest_.push_back(links_[i].resistance * (values[i] - mean) * flow[i]);
  row_.clear();
  for (std::size_t k = 0; k < hole_count_; ++k) row_.push_back(units_[k] * dot(current(k), rest_));
  solve_lower(row_);
  solve_upper(row_);
  elimination_.relax(rest_, room_for(differences_, elimination_.join_count()));
  for (std::size_t i = 0; i < links_.size(); ++i) rest_[i] *= conductances_[i];
  for (double& coefficient : row_) coefficient = -coefficient;
  add_currents(row_, rest_);
}

/// Of flows i, with values v and weights R: the sums of R v i i change by that of dR (v i - 2 b) i,
/// where b is what of v i goes round filled cycles, as the flows give way by what goes round these;
/// and by that of -dR i i times the sums themselves, as their lengths stay 1.
std::span<const double> CycleFlows::slopes(std::span<const double> values) {
  if (is_graph_) return slopes_;
  slopes_.assign(links_.size(), 0.0);
  for (std::size_t f = 0; f < flow_count_; ++f) {
    const auto mine = flow(f);
    take_off_other_flows(values, mine);
    for (std::size_t i = 0; i < links_.size(); ++i)
      slopes_[i] += mine[i] * (values[i] * mine[i] - 2.0 * rest_[i]);
    for (std::size_t k = 0; k < flow_count_; ++k) {
      const auto other = flow(k);
      const double product = sum_of_products(mine, other, values);
      for (std::size_t i = 0; i < links_.size(); ++i) slopes_[i] -= product * mine[i] * other[i];
    }
  }
  return slopes_;
}

}  // namespace plekton::contact

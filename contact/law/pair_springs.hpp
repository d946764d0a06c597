// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plekton::contact {

/// The springs of one contact of a pair of bodies by the gap (m, negative when overlapping), for
/// code that does not know the law. Refers to the parameters of the pair, which must live as long.
class PairSprings {
 public:
  template <class Law>
  static PairSprings under(const typename Law::Parameters& parameters) noexcept {
    return {&parameters, &Functions<Law>::table};
  }

  /// N, elastic; 0 for a gap >= 0.
  double normal_force(double gap) const { return table_->normal_force(parameters_, gap); }
  /// N/m.
  double normal_stiffness(double gap) const { return table_->normal_stiffness(parameters_, gap); }
  /// N/m.
  double tangential_stiffness(double gap) const {
    return table_->tangential_stiffness(parameters_, gap);
  }

 private:
  using Function = double (*)(const void*, double);
  struct Table {
    Function normal_force;
    Function normal_stiffness;
    Function tangential_stiffness;
  };
  template <class Law>
  struct Functions {
    static const typename Law::Parameters& of(const void* parameters) noexcept {
      return *static_cast<const typename Law::Parameters*>(parameters);
    }
    static constexpr Table table{
        [](const void* p, double gap) -> double { return Law::elastic_normal_force(of(p), gap); },
        [](const void* p, double gap) -> double { return Law::normal_stiffness(of(p), gap); },
        [](const void* p, double gap) -> double { return Law::tangential_stiffness(of(p), gap); }};
  };
  PairSprings(const void* parameters, const Table* table) noexcept
      : parameters_(parameters), table_(table) {}

  const void* parameters_;
  const Table* table_;
};

}  // namespace plekton::contact

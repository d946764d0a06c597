// SPDX-License-Identifier: GPL-3.0-or-later
// The laws that come with the library, one row each.
#include "dynamics/simulation_definitions.hpp"

namespace plekton::dynamics {

template class Simulation<contact::LinearFrictional>;
template class Simulation<contact::AnyLaw>;

}  // namespace plekton::dynamics

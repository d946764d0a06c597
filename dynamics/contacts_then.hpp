// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "dynamics/model/scene.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/base/thread_pool.hpp"

namespace plekton::dynamics {

/// Calls look() with the contacts as they would be found where nodes and planes were some time ago,
/// or are, and leaves them as they are, whatever it throws. Takes about as long as a step and a
/// snapshot of the contacts.
/// @param scene  in its present state
/// @param ago    s, before now
void contacts_then(contact::Contacts& contacts, const Scene& scene, double ago,
                   geometry::ThreadPool& pool, geometry::FunctionRef<void()> look);

}  // namespace plekton::dynamics

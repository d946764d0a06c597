// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_model.hpp"
#include "dynamics/model/scene.hpp"

namespace plekton::dynamics {

/// What contacts have to know of a scene, to be made.
/// @param scene         checked; it and the surface outlive what is returned
/// @param asked_skin    m; 0: chosen
/// @param self_contact  whether a structure may touch itself
contact::ContactScene contact_scene(const Scene& scene, const geometry::Surface& surface,
                                    double asked_skin, bool self_contact);

/// Whether a scene may ever have a contact.
bool may_touch(const Scene& scene, const geometry::Surface& surface, bool self_contact) noexcept;

}  // namespace plekton::dynamics

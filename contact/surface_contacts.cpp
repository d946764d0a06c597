// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_contacts.hpp"

namespace plekton::contact {

template class SurfaceContacts<LinearFrictional>;
template class SurfaceContacts<AnyLaw>;

}  // namespace plekton::contact

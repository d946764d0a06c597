// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/plane_contacts.hpp"

namespace plekton::contact {

template class PlaneContacts<LinearFrictional>;
template class PlaneContacts<AnyLaw>;

}  // namespace plekton::contact

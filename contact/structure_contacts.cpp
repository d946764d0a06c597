// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/structure_contacts.hpp"

namespace plekton::contact {

template class StructureContacts<LinearFrictional>;
template class StructureContacts<AnyLaw>;

}  // namespace plekton::contact

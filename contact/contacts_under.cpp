// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/contacts_under.hpp"

namespace plekton::contact {

template class ContactsUnder<LinearFrictional>;
template class ContactsUnder<AnyLaw>;

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/ball_contacts.hpp"

namespace plekton::contact {

template class BallContacts<LinearFrictional>;
template class BallContacts<AnyLaw>;

}  // namespace plekton::contact

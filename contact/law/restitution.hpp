// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plekton::contact {

/// Restitution of two bodies with a spring and a dashpot between them that never pull, so that the
/// contact ends when the force is zero, somewhat before the overlap is.
///
/// The damping ratio is xi = c / (2 sqrt(m k)), with the reduced mass m and the present stiffness
/// k = dF/d(overlap): constant for a linear spring; for Hertz' contact c goes with the fourth root
/// of the overlap, and the restitution does not depend on the speed. Tsuji, Tanaka & Ishida, Powder
/// Technology 71 (1992) 239-250; Schwager & Poeschel, Granular Matter 9 (2007) 465-469 for the end
/// of the contact.
enum class SpringKind { linear, hertz };

/// Ratio of the speeds after and before an impact, by integrating it (1e-9).
/// @param damping_ratio  xi >= 0
double restitution(SpringKind kind, double damping_ratio);

/// The damping ratio for which restitution() is as wanted.
/// @param wanted  in (0, 1]; below the restitution of a ratio of 1000, that ratio
double damping_ratio(SpringKind kind, double wanted);

}  // namespace plekton::contact

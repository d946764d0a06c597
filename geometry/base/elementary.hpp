// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The elementary functions, with the same bits on every processor.
///
/// Those of a C library differ in the last bit from processor to processor: it has several of each,
/// with and without fused multiply-add, and chooses as a program starts. A difference in the last
/// bit of one angle is another trajectory. These use only +, -, *, / and square roots of doubles,
/// which IEEE 754 rounds in one way. Whatever runs in a step or decides a state takes them from
/// here, never from cmath; a test of the tree checks it.
///
/// Results are the nearest double but for about one argument in ten thousand, and there the other
/// neighbour: within 0.501 ulp where the result is a normal number. A call takes 50 to 250 ns.
/// What cmath says of zeros, infinities and what is not a number holds, but where noted.
namespace plekton::elementary {

/// @param x  rad. Not a number from 2^40 on, which is 2e11 turns.
double sin(double x) noexcept;
double cos(double x) noexcept;
double tan(double x) noexcept;

/// rad
double asin(double x) noexcept;
double atan(double x) noexcept;
double atan2(double y, double x) noexcept;

double exp(double x) noexcept;
/// To the base e.
double log(double x) noexcept;
/// x to the power of y. Not a number for a negative x, whatever y.
double pow(double x, double y) noexcept;

/// sqrt(x² + y²), also where the squares overflow or vanish.
double hypot(double x, double y) noexcept;

}  // namespace plekton::elementary

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// What plekton-bench-kernels measures, a file for each subject. Each function lists the benchmarks
/// of its file; names are subject/kernel/inputs.
namespace plekton::benchmarks {

void add_closest_points();
void add_pairs();
void add_signs();
void add_contact_law();
void add_beams();
void add_broad_phase();
void add_patches();
void add_wrapped_balls();
void add_leapfrog();

}  // namespace plekton::benchmarks

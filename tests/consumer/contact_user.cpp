// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/version.hpp"

int main() { return plekton::kVersion.empty() ? 1 : 0; }

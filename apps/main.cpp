// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/command_line.hpp"

int main(int argc, char** argv) {
  return plekton::apps::run_program(argc, argv);
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include <exception>
#include <iostream>

#include "trueflank/app/command_line.h"
#include "trueflank/app/terminal.h"

int main(int argc, char** argv) {
  trueflank::app::install_interrupt_handlers();
  try {
    return trueflank::app::run_command_line(argc, argv);
  } catch (const std::bad_alloc&) {
    std::cerr << "trueflank: out of memory; a larger --tolerance-um needs less\n";
    return 3;
  } catch (const std::exception& error) {
    std::cerr << "trueflank: internal error, please report it: " << error.what() << "\n";
    return 3;
  }
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <string_view>

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--version") {
    std::cout << "trueflank " TRUEFLANK_VERSION "\n";
    return 0;
  }
  std::cerr << "usage: trueflank --version\n";
  return 2;
}

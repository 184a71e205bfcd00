// SPDX-License-Identifier: Apache-2.0
// The tetrakis program.
#include "tools/command_line.hpp"

int main(int argc, char** argv) {
  return tetrakis::tools::runCommandLine(argc, argv);
}

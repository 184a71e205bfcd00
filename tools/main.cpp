// SPDX-License-Identifier: Apache-2.0
// The tetrakis program.
#include "tools/command_line.hpp"
#include "tools/temporary.hpp"

int main(int argc, char** argv) {
  tetrakis::tools::cleanUpOnSignals();
  return tetrakis::tools::runCommandLine(argc, argv);
}

// SPDX-License-Identifier: Apache-2.0
// The tetrakis program.
#include "tools/commands/command_line.hpp"
#include "tools/files/temporary.hpp"

int main(int argc, char** argv) {
  tetrakis::tools::cleanUpOnSignals();
  return tetrakis::tools::runCommandLine(argc, argv);
}

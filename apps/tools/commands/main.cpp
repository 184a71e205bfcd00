// SPDX-License-Identifier: Apache-2.0
// The tetrakis program.
#include "apps/tools/commands/command_line.hpp"
#include "apps/tools/files/temporary.hpp"

int main(int argc, char** argv) {
  tetrakis::tools::cleanUpOnSignals();
  return tetrakis::tools::runCommandLine(argc, argv);
}

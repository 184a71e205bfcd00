// SPDX-License-Identifier: Apache-2.0
// The tetrakis program.
#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "tools/commands/command_line.hpp"
#include "tools/files/temporary.hpp"

namespace {

/// Planes and the states of regions go back to the system as soon as they are freed: without being
/// told, glibc soon keeps blocks of up to 32 MiB, in pieces that none of the next ones may fit.
void returnFreedMemory() {
#ifdef __GLIBC__
  constexpr int kLeastBytes = 128 << 10;
  mallopt(M_MMAP_THRESHOLD, kLeastBytes);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  returnFreedMemory();
  tetrakis::tools::cleanUpOnSignals();
  return tetrakis::tools::runCommandLine(argc, argv);
}

// SPDX-License-Identifier: Apache-2.0
// runCommandLine() is the whole command line as one function, so that tests need no process.
#pragma once

namespace tetrakis::tools {

/// Parses the arguments, runs the verb and returns the exit code. Data go to standard output,
/// everything else to standard error.
int runCommandLine(int argc, const char* const* argv);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// runProgram() runs an external program and reports its failure.
#pragma once

#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Runs a program that PATH finds, without a shell, and waits for its end. words: its name and its
/// arguments. log: a file that takes what it prints. TKS_UNSUPPORTED: there is no such program;
/// TKS_IO with its last line if it ends with an exit status other than 0.
Status runProgram(const std::vector<std::string>& words, const std::string& log);

}  // namespace tetrakis::tools

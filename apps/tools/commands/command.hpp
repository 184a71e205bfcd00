// SPDX-License-Identifier: Apache-2.0
// The functions here are the verbs of the command line. Each adds the options of a verb to the
// parser and, when the verb is chosen, puts the work to do into `action`. docs/CLI.md says what
// verbs promise.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// What the parser found out: the work to do, and the options that all verbs share.
struct CommandLine {
  std::function<Status()> action;
  bool quiet = false;       ///< -q: no progress bar, no notes
  uint64_t max_memory = 0;  ///< --max-memory; 0: the default (memory_limit.hpp)
};

void addEncode(CLI::App& app, CommandLine& line);
void addDecode(CLI::App& app, CommandLine& line);
void addTiles(CLI::App& app, CommandLine& line);
void addTruncate(CLI::App& app, CommandLine& line);
void addInfo(CLI::App& app, CommandLine& line);
void addCompare(CLI::App& app, CommandLine& line);
void addVerify(CLI::App& app, CommandLine& line);
void addPlan(CLI::App& app, CommandLine& line);
void addCombine(CLI::App& app, CommandLine& line);
void addReorder(CLI::App& app, CommandLine& line);
void addMosaic(CLI::App& app, CommandLine& line);
void addProfile(CLI::App& app, CommandLine& line);
void addSynth(CLI::App& app, CommandLine& line);
void addView(CLI::App& app, CommandLine& line);
void addServe(CLI::App& app, CommandLine& line);
void addReceive(CLI::App& app, CommandLine& line);

}  // namespace tetrakis::tools

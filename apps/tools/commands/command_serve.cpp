// SPDX-License-Identifier: Apache-2.0
// tetrakis serve: hands out a sequence, which may grow, to receivers of any link and renderer.
#include <cstdio>
#include <memory>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/serve/sequence_server.hpp"

namespace tetrakis::tools {
namespace {

/// Answers are made by whichever thread has the connection, one at a time: an arena of memory for
/// each thread would keep what one of them took.
void shareMemory() {
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, 2);
#endif
}

Status serve(const ServeOptions& options) {
  shareMemory();
  const auto server = SequenceServer::open(options);
  if (!server.ok()) return server.status();
  std::printf("%s\n", (*server)->url().c_str());
  std::fflush(stdout);
  return (*server)->run();
}

}  // namespace

void addServe(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<ServeOptions>();
  CLI::App& verb = *app.add_subcommand("serve", "Serve a sequence to receivers, until interrupted");
  verb.add_option("IN", options->path, "Sequence (.tks)")->required()->type_name("");
  verb.add_option("--port", options->port, "Port (default: any free one)")
      ->check(silent(CLI::Range(1, 65535)))
      ->type_name("N");
  verb.add_option("--address", options->address,
                  "Address to listen at (127.0.0.1: this machine alone; 0.0.0.0: everybody)")
      ->type_name("IP");
  verb.add_flag("--live", options->live, "Follow the file as it grows");
  verb.add_option("--origin", options->origins,
                  "Let pages of this origin in, as https://example.org; * is any. Those of this "
                  "machine are in any case")
      ->type_name("ORIGIN");
  options->tell = [](const std::string& text) { tellLine("tetrakis: " + text); };
  verb.callback([options, &line] { line.action = [options] { return serve(*options); }; });
}

}  // namespace tetrakis::tools

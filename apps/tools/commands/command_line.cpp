// SPDX-License-Identifier: Apache-2.0
// The tetrakis command line: parses, runs one verb, and turns its Status into a sentence on
// standard error and an exit code (docs/CLI.md).
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/memory_limit.hpp"

namespace tetrakis::tools {
namespace {

constexpr const char* kEveryVerb =
    "Every verb:\n"
    "  -q,--quiet                      No progress bar, no notes, no summary\n"
    "  --max-memory SIZE               Most memory to take (0, the default: 3/4 of what there "
    "is)\n\n";

constexpr const char* kHelpOfVerbs = "tetrakis help VERB shows the options of a verb.\n\n";

constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0  done\n"
    "  1  usage: the command makes no sense as given\n"
    "  2  a file cannot be read or written, or exists and -f is missing\n"
    "  3  corrupt input\n"
    "  4  truncated input (with --strict), or too short to hold the header\n"
    "  5  version, feature or system not supported\n"
    "  6  a limit would be exceeded\n"
    "  7  comparison or verification failed\n";

std::string versionText() {
  return "tetrakis " + std::to_string(TKS_VERSION_MAJOR) + "." + std::to_string(TKS_VERSION_MINOR) +
         "." + std::to_string(TKS_VERSION_PATCH);
}

void addVerbs(CLI::App& app, CommandLine& line) {
  app.name("tetrakis");
  app.require_subcommand(1);
  app.set_version_flag("--version", versionText());
  app.get_formatter()->column_width(34);
  app.footer(std::string(kEveryVerb) + kExitCodes);  // that of the verbs, which inherit it
  app.fallthrough();
  app.add_flag("-q,--quiet", line.quiet, "No progress bar, no notes (any verb)");
  addSize(app, "--max-memory", line.max_memory,
          "Most memory to take (any verb; 0, the default: 3/4 of what there is)");
  addEncode(app, line);
  addDecode(app, line);
  addTruncate(app, line);
  addInfo(app, line);
  addCompare(app, line);
  addVerify(app, line);
  addReorder(app, line);
  addCombine(app, line);
  addPlan(app, line);
  addMosaic(app, line);
  addProfile(app, line);
  addSynth(app, line);
  addView(app, line);
  addServe(app, line);
  addReceive(app, line);
  addTiles(app, line);
  app.footer(std::string(kHelpOfVerbs) + kExitCodes);
}

/// `help VERB` is VERB --help, and `help` is --help.
std::vector<std::string> wordsOf(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty() || words[0] != "help") return words;
  words.erase(words.begin());
  words.push_back("--help");
  return words;
}

bool isVerb(const CLI::App& app, const std::string& name) {
  const std::vector<const CLI::App*> verbs =
      app.get_subcommands([](const CLI::App*) { return true; });
  return std::any_of(verbs.begin(), verbs.end(),
                     [&](const CLI::App* verb) { return verb->get_name() == name; });
}

/// The library's numbers are the exit codes; running out of memory is a limit of the machine.
int exitCode(tks_status code) {
  return code == TKS_NO_MEMORY ? TKS_LIMIT : code;
}

/// The library calls a limit by the name of its field.
std::string withNamesOfOptions(std::string sentence) {
  constexpr std::string_view kField = "(max_memory)", kOption = "(--max-memory)";
  const size_t at = sentence.find(kField);
  return at == std::string::npos ? sentence : sentence.replace(at, kField.size(), kOption);
}

int report(const Status& status) {
  if (status.ok()) return TKS_OK;
  tellLine("tetrakis: " + withNamesOfOptions(status.message()));
  return exitCode(status.code());
}

/// Third-party libraries may throw; nothing of theirs leaves the process as a crash.
Status run(const CommandLine& line) {
  try {
    return line.action();
  } catch (const std::bad_alloc&) {
    return Status(TKS_NO_MEMORY, "not enough memory for this input");
  } catch (const std::exception& error) {
    return Status(TKS_IO, std::string("unexpected failure: ") + error.what());
  }
}

}  // namespace

int runCommandLine(int argc, const char* const* argv) {
  CLI::App app("Progressive codec for textured terrain: one stream, cut anywhere.");
  CommandLine line;
  addVerbs(app, line);
  const std::vector<std::string> words = wordsOf(argc, argv);
  if (!words.empty() && !words[0].starts_with('-') && !isVerb(app, words[0]))
    return report(Status(TKS_USAGE, "there is no command '" + words[0] + "'; --help lists them"));
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::Success& asked_for_help) {
    return app.exit(asked_for_help);
  } catch (const CLI::RequiredError& error) {
    const std::vector<std::string> unknown = app.remaining(true);  // a misspelt option, perhaps
    return report(Status(TKS_USAGE, (unknown.empty() ? std::string(error.what())
                                                     : "there is no option '" + unknown[0] + "'") +
                                        "; --help shows the usage"));
  } catch (const CLI::ParseError& error) {
    return report(Status(TKS_USAGE, std::string(error.what()) + "; --help shows the usage"));
  }
  setMemoryLimit(line.max_memory);
  return report(run(line));
}

}  // namespace tetrakis::tools

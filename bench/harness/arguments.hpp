// SPDX-License-Identifier: Apache-2.0
// The command line of a bench. Only arguments.cpp knows CLI11, which is compiled whole wherever it
// is included.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/harness/comparison.hpp"

namespace CLI {
class App;
}

namespace tetrakis::bench {

/// What every option gives: its name, and one sentence for --help.
struct OptionText {
  const char *name, *help;
};

/// Declares options, then parses. Variables keep what they hold where an option is not given; they
/// must outlive parse().
class Arguments {
 public:
  explicit Arguments(const char* description);
  ~Arguments();
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;

  // Names without dashes are positions.
  void text(OptionText option, std::string& value);
  void texts(OptionText option, std::vector<std::string>& values);
  void required(OptionText option, std::vector<std::string>& values);
  void choices(OptionText option, std::vector<std::string>& values,
               const std::vector<std::string>& all);
  void number(OptionText option, std::optional<double>& value);
  void numbers(OptionText option, std::vector<double>& values);
  void positive(OptionText option, double& value);
  void positive(OptionText option, uint64_t& value);
  void within(OptionText option, uint32_t& value, uint32_t least, uint32_t most);
  void flag(OptionText option, bool& value);
  void unset(OptionText option, bool& value);

  void folders(std::vector<std::string>& folders, std::vector<std::string>& filters);
  void maxPixels(uint64_t& pixels);
  void runs(int& runs);
  void csv(std::string& path);
  /// options.window holds the defaults.
  void comparison(ComparisonOptions& options);

  /// An exit code if the program is to end: after --help, or with a message on stderr.
  std::optional<int> parse(int argc, const char* const* argv);

 private:
  std::unique_ptr<CLI::App> app_;
};

/// What main() returns; what failed is told on stderr.
int exitCode(const Status& status);

}  // namespace tetrakis::bench

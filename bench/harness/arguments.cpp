// SPDX-License-Identifier: Apache-2.0
#include "bench/harness/arguments.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/tools/files/positive.hpp"

namespace tetrakis::bench {

Arguments::Arguments(const char* description) : app_(std::make_unique<CLI::App>(description)) {}

Arguments::~Arguments() = default;

void Arguments::text(OptionText option, std::string& value) {
  app_->add_option(option.name, value, option.help)->capture_default_str();
}

void Arguments::texts(OptionText option, std::vector<std::string>& values) {
  app_->add_option(option.name, values, option.help)->delimiter(',');
}

void Arguments::required(OptionText option, std::vector<std::string>& values) {
  app_->add_option(option.name, values, option.help)->required()->check(CLI::ExistingPath);
}

void Arguments::choices(OptionText option, std::vector<std::string>& values,
                        const std::vector<std::string>& all) {
  app_->add_option(option.name, values, option.help)->delimiter(',')->check(CLI::IsMember(all));
}

void Arguments::number(OptionText option, std::optional<double>& value) {
  app_->add_option(option.name, value, option.help);
}

void Arguments::numbers(OptionText option, std::vector<double>& values) {
  app_->add_option(option.name, values, option.help)->delimiter(',');
}

void Arguments::positive(OptionText option, double& value) {
  app_->add_option(option.name, value, option.help)
      ->check(tools::positive())
      ->capture_default_str();
}

void Arguments::positive(OptionText option, uint64_t& value) {
  app_->add_option(option.name, value, option.help)
      ->check(tools::positive())
      ->capture_default_str();
}

void Arguments::within(OptionText option, uint32_t& value, uint32_t least, uint32_t most) {
  app_->add_option(option.name, value, option.help)
      ->check(CLI::Range(least, most))
      ->capture_default_str();
}

void Arguments::flag(OptionText option, bool& value) {
  app_->add_flag(option.name, value, option.help);
}

void Arguments::unset(OptionText option, bool& value) {
  app_->add_flag(std::string("!") + option.name, value, option.help);
}

void Arguments::folders(std::vector<std::string>& folders, std::vector<std::string>& filters) {
  required({"DIR", "Folders, searched recursively"}, folders);
  texts({"--files", "Only files whose path holds one of these texts"}, filters);
}

void Arguments::maxPixels(uint64_t& pixels) {
  positive({"--max-pixels", "Larger images are cut to their centre"}, pixels);
}

void Arguments::runs(int& runs) {
  app_->add_option("--runs", runs, "Runs that each median of times is taken of")
      ->check(tools::positive())
      ->capture_default_str();
}

void Arguments::csv(std::string& path) {
  text({"--csv", "Replace this bench's rows of a results file"}, path);
}

void Arguments::comparison(ComparisonOptions& options) {
  folders(options.folders, options.filters);
  positive({"--low", "Lower end of the window of rates, bits a pixel"}, options.window.low);
  positive({"--high", "Upper end of the window of rates, bits a pixel"}, options.window.high);
  csv(options.csv);
}

std::optional<int> Arguments::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app_->exit(error);
  }
  return std::nullopt;
}

int exitCode(const Status& status) {
  if (!status.ok()) std::fprintf(stderr, "%s\n", status.message().c_str());
  return status.code();
}

}  // namespace tetrakis::bench

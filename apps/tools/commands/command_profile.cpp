// SPDX-License-Identifier: Apache-2.0
// tetrakis profile: the terrain along a line, as the best polyline of few points.
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/output/json.hpp"
#include "apps/tools/profile/best_profile.hpp"
#include "apps/tools/profile/ground_line.hpp"

namespace tetrakis::tools {
namespace {

struct ProfileArguments {
  StreamSource source;
  std::string line;
  uint32_t points = 0;
  bool geographic = false, json = false;
};

/// Twelve digits: millimetres in any national grid, without the last bits of scaled samples.
std::string digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", value == 0 ? 0.0 : value);
  return text;
}

/// For people.
std::string fewDigits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

Json number(double value) {
  return std::strtod(digits(value).c_str(), nullptr);
}

const char* distanceUnit(const GroundLine& line) {
  return line.metres ? "m" : "samples";
}

const char* reasonOf(const GroundGap& gap) {
  return gap.outside ? "outside" : "void";
}

/// Calls with the piece, counted from 1, and a sample of it that the profile keeps.
template <class Visitor>
void forEachPoint(const GroundLine& line, const BestProfile& profile, Visitor&& visit) {
  for (size_t p = 0; p < line.pieces.size(); ++p)
    for (const uint32_t k : profile.points[p]) visit(p + 1, line.pieces[p][k]);
}

std::string csvOf(const GroundLine& line, const BestProfile& profile) {
  std::string text = "piece,distance,height,x,y\n";
  forEachPoint(line, profile, [&](size_t piece, const GroundSample& sample) {
    text += std::to_string(piece) + ',' + digits(sample.distance) + ',' + digits(sample.height) +
            ',' + digits(sample.at.x) + ',' + digits(sample.at.y) + '\n';
  });
  return text;
}

Json profileJson(const GroundLine& line, const BestProfile& profile, const tks_info& info) {
  Json points = Json::array(), gaps = Json::array();
  forEachPoint(line, profile, [&](size_t piece, const GroundSample& sample) {
    points.push_back({{"piece", piece},
                      {"distance", number(sample.distance)},
                      {"height", number(sample.height)},
                      {"x", number(sample.at.x)},
                      {"y", number(sample.at.y)}});
  });
  for (const GroundGap& gap : line.gaps)
    gaps.push_back({{"from", number(gap.from)}, {"to", number(gap.to)}, {"why", reasonOf(gap)}});
  return {{"length", number(line.length)},  {"distance_unit", distanceUnit(line)},
          {"unit", textOrNull(info.unit)},  {"samples", line.samples()},
          {"algorithm", profile.algorithm}, {"rmse", number(profile.rmse)},
          {"points", std::move(points)},    {"gaps", std::move(gaps)}};
}

/// All of them, if they are few.
std::string gapsNote(const std::vector<GroundGap>& gaps, const char* unit) {
  if (gaps.empty()) return "";
  constexpr size_t kTold = 5;
  std::string text = "the line has " + counted(gaps.size(), "gap", "gaps") + ": ";
  for (size_t i = 0; i < std::min(gaps.size(), kTold); ++i)
    text += (i > 0 ? ", " : "") + fewDigits(gaps[i].from) + " to " + fewDigits(gaps[i].to) + ' ' +
            unit + (gaps[i].outside ? " (outside the ground)" : " (void)");
  return gaps.size() > kTold ? text + ", …" : text;
}

std::string summary(const GroundLine& line, const BestProfile& profile, const tks_info& info) {
  size_t points = 0;
  for (const std::vector<uint32_t>& kept : profile.points) points += kept.size();
  const std::string unit = info.unit[0] != '\0' ? std::string(" ") + info.unit : "";
  return counted(points, "point", "points") + " for " +
         counted(line.samples(), "sample", "samples") + " along " + fewDigits(line.length) + ' ' +
         distanceUnit(line) + ", off by " + fewDigits(profile.rmse) + unit + " (RMSE, " +
         profile.algorithm + ")";
}

Status profile(const ProfileArguments& arguments, bool quiet) {
  if (arguments.points < 2) return Status(TKS_USAGE, "--points must be at least 2");
  Result<std::vector<LinePoint>> points = parseLine(arguments.line);
  if (!points.ok()) return points.status();
  Result<OpenStream> stream = openTerrain(arguments.source);
  if (!stream.ok()) return stream.status();
  Decoder& decoder = stream->decoder;
  decoder.setThreads(hardwareThreads());
  const Result<GroundPath> path =
      pathOver(decoder.info(), std::move(*points), arguments.geographic);
  if (!path.ok()) return path.status();
  const Result<GroundLine> line = groundUnder(*path, decoder);
  if (!line.ok()) return line.status();
  if (arguments.points < fewestPoints(*line))
    return Status(TKS_USAGE, "--points must be at least " + std::to_string(fewestPoints(*line)) +
                                 ": gaps leave " + std::to_string(line->pieces.size()) +
                                 " pieces of the line, and each keeps its ends");
  const BestProfile best = bestProfile(*line, arguments.points);
  tellNote(gapsNote(line->gaps, distanceUnit(*line)), quiet);
  tellNote(summary(*line, best, decoder.info()), quiet);
  return print(arguments.json ? dump(profileJson(*line, best, decoder.info()))
                              : csvOf(*line, best));
}

}  // namespace

void addProfile(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<ProfileArguments>();
  CLI::App& verb = *app.add_subcommand("profile", "Print the heights along a line, in few points");
  addSource(verb, arguments->source);
  addComponent(verb, arguments->source);
  verb.add_option("--line", arguments->line, "Where it runs, in columns and rows of the heights")
      ->required()
      ->type_name("\"X,Y X,Y …\"");
  verb.add_option("--points", arguments->points, "At most so many points, the best ones")
      ->required()
      ->type_name("N");
  verb.add_flag("--geo", arguments->geographic, "The line is in the coordinates of the CRS");
  verb.add_flag("--json", arguments->json, "JSON instead of CSV");
  verb.callback([arguments, &line] {
    line.action = [arguments, &line] { return profile(*arguments, line.quiet); };
  });
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// The verbs of the command line. Each adds its options to the parser and, when chosen, puts the
// work to do into `action`. What they promise: docs/CLI.md.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "base/status.hpp"
#include "tools/files/file_bytes.hpp"
#include "tools/files/positive.hpp"
#include "tools/files/stream.hpp"
#include "tools/files/units.hpp"
#include "tools/report/camera_choice.hpp"

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
void addReorder(CLI::App& app, CommandLine& line);
void addProfile(CLI::App& app, CommandLine& line);
void addSynth(CLI::App& app, CommandLine& line);
void addView(CLI::App& app, CommandLine& line);

/// A line on standard error, unless it is empty or -q is given.
inline void tellNote(const std::string& text, bool quiet) {
  if (!quiet && !text.empty()) std::fprintf(stderr, "note: %s\n", text.c_str());
}

/// What is to be said where heights count as metres beside the ground; "" if their unit is a
/// length.
inline std::string guessedUnitNote(const tks_info& info) {
  if (!info.has_heights) return "";
  if (*info.unit == '\0')
    return "the stream does not tell the unit of its heights, which counts as metres";
  if (metresPerUnit(info.unit)) return "";
  return "the unit of the heights, " + quoted(info.unit) + ", is no length and counts as metres";
}

/// What is to be said of a mesh that has more triangles than were asked for (0: any number); "" of
/// others.
inline std::string coarsestNote(uint32_t triangles, uint32_t asked) {
  if (asked == 0 || triangles <= asked) return "";
  return "the mesh has " + std::to_string(triangles) + " triangles: the coarsest one";
}

/// Without the description that CLI11 would append to the option's type.
inline CLI::Validator silent(CLI::Validator validator) {
  return validator.description("");
}

/// Text that is a T which `accepts` takes. fault: what is said behind the text of others.
template <class T>
CLI::Validator numberThat(bool (*accepts)(T), const std::string& fault) {
  return CLI::Validator(
      [accepts, fault](const std::string& text) {
        T value{};
        const bool taken = CLI::detail::lexical_cast(text, value) && accepts(value);
        return taken ? std::string() : "'" + text + "' " + fault;
      },
      "");
}

/// Any number; infinite ones and NaN are some.
inline CLI::Validator anyNumber() {
  return numberThat<double>([](double) { return true; }, "is not a number");
}

/// A number that is neither infinite nor NaN.
inline CLI::Validator finite() {
  return numberThat<double>([](double v) { return std::isfinite(v); }, "is not a finite number");
}

/// 0, 1, 2, … below 2^32.
inline CLI::Validator wholeNumber() {
  return numberThat<uint32_t>([](uint32_t) { return true; }, "is no whole number below 2^32");
}

/// An option that takes a SIZE with the suffixes k, M, G.
template <class T>
CLI::Option* addSize(CLI::App& app, const std::string& name, T& bytes, const std::string& help) {
  return app.add_option(name, bytes, help)
      ->transform(CLI::Validator(
          [](std::string& text) {
            const Result<uint64_t> size = parseSize(text);
            if (size.ok()) text = std::to_string(*size);
            return size.ok() ? std::string() : size.status().message();
          },
          ""))
      ->type_name("SIZE");
}

/// --bytes SIZE.
template <class T>
CLI::Option* addBytes(CLI::App& app, T& bytes, const std::string& help) {
  return addSize(app, "--bytes", bytes, help);
}

/// The name of preset cameras (ground/preset_cameras.hpp), judged before any file is read.
inline CLI::Validator presetView() {
  return silent(CLI::IsMember({"oblique", "low", "top", "orbit", "all", "any"}));
}

/// --cameras FILE.json or --view NAME.
inline void addCameraOptions(CLI::App& app, CameraChoice& choice) {
  CLI::Option* const file =
      app.add_option("--cameras", choice.file, "Cameras to look with")->type_name("FILE.json");
  app.add_option("--view", choice.view, "Preset cameras: oblique, low, top, orbit, all, any")
      ->check(presetView())
      ->type_name("NAME")
      ->excludes(file);
}

/// --triangles N.
inline CLI::Option* addTriangles(CLI::App& app, uint32_t& triangles, const std::string& help) {
  return app.add_option("--triangles", triangles, help)
      ->check(numberThat<uint32_t>([](uint32_t count) { return count > 0; },
                                   "is no number of triangles below 2^32; write for example 5000"))
      ->type_name("N");
}

/// As many threads as the machine has.
inline uint32_t hardwareThreads() {
  return std::max(1u, std::thread::hardware_concurrency());
}

/// --threads N.
inline void addThreads(CLI::App& app, uint32_t& threads) {
  app.add_option("--threads", threads, "Threads (default: all); the result never depends on it")
      ->check(silent(CLI::Range(1u, 1024u)))
      ->type_name("N");
}

inline void addForce(CLI::App& app, bool& force) {
  app.add_flag("-f,--force", force, "Overwrite files that exist");
}

/// The positional stream of a verb that reads one, with --bytes and --strict.
inline void addSource(CLI::App& app, StreamSource& source) {
  app.add_option("IN", source.path, "Stream (.tks) or any prefix of one; - is standard input")
      ->required()
      ->type_name("");
  addBytes(app, source.bytes, "Use no more than the first SIZE bytes: 65536, 64k, 1M");
  app.add_flag("--strict", source.strict, "Refuse a stream that ends early");
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// The functions here add options that several verbs have, and judge their texts before any file is
// read.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <thread>

#include "apps/tools/files/stream.hpp"
#include "apps/tools/files/units.hpp"
#include "apps/tools/report/camera_choice.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

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

/// The name of preset cameras (codec/ground/camera.hpp).
inline CLI::Validator presetView() {
  return silent(CLI::IsMember({"oblique", "low", "top", "orbit", "all", "any", "around"}));
}

/// --cameras FILE.json or --view NAME.
inline void addCameraOptions(CLI::App& app, CameraChoice& choice) {
  CLI::Option* const file =
      app.add_option("--cameras", choice.file, "Cameras to look with")->type_name("FILE.json");
  app.add_option("--view", choice.view,
                 "Preset cameras: oblique, low, top, orbit, all, any, around")
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

/// NAME=W, as often as one likes.
inline CLI::Option* addWeights(CLI::App& app, const std::string& option,
                               std::vector<std::string>& weights) {
  return app
      .add_option(option, weights,
                  "What errors of the components of a name count beside those of others (1)")
      ->type_name("NAME=W")
      ->expected(1)
      ->take_all();
}

/// --component NAME, as often as one likes.
inline void addComponent(CLI::App& app, StreamSource& source) {
  app.add_option("--component", source.components,
                 "Take this component, by its name or its number, in the place of the first of its "
                 "kind (may be repeated)")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
}

/// --frame N or --time SECONDS, of a sequence.
inline void addFrame(CLI::App& app, StreamSource& source) {
  CLI::Option* const frame =
      app.add_option("--frame", source.frame, "Of a sequence, the frame of this number, from 0 on")
          ->type_name("N");
  app.add_option("--time", source.seconds, "The last frame that is not after that")
      ->check(finite())
      ->type_name("SECONDS")
      ->excludes(frame);
}

}  // namespace tetrakis::tools

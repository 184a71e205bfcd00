// SPDX-License-Identifier: Apache-2.0
// EncodeArguments holds the arguments of `tetrakis encode`, and checkArguments() refuses arguments
// that contradict each other.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/tools/commands/options.hpp"

namespace tetrakis::tools {

/// Of frames that patterns of file names give.
struct SequenceArguments {
  double fps = 0, every = 0;  ///< frames a second, or seconds a frame; 0: unknown
  std::string epoch, calendar;
  uint32_t group = 0;      ///< frames that are coded together; 0: chosen
  uint64_t rate = 0;       ///< bytes a second; 0: another target
  uint64_t reference = 0;  ///< bytes a frame that later groups go on from; 0: none do
  uint32_t entry = 0;      ///< every how manyth group stands by itself; 0: chosen
  bool append = false;     ///< the frames follow those that the output has

  bool given() const {
    return append || fps > 0 || every > 0 || group > 0 || rate > 0 || reference > 0 || entry > 0 ||
           !epoch.empty() || !calendar.empty();
  }
};

struct EncodeArguments {
  std::string height, texture, output, report;
  std::vector<std::string> also, weights_of_also;  ///< NAME=IMAGE, NAME=WEIGHT
  uint64_t bytes = 0;
  double psnr = 0;
  std::string max_error;
  bool lossless = false;
  uint32_t depth = 0;  ///< of a cube; 0: chosen
  uint32_t triangles = 0, threads = hardwareThreads();
  std::string regions = "auto", weights = "psnr", engine = "modelled", domain = "auto",
              kind = "auto", sketch = "auto", maps = "all";
  double step = 0;
  std::optional<double> scale, offset, nodata;
  uint32_t white_level = 0;  ///< 0: found
  std::string spacing;
  std::optional<std::string> unit, vertical_datum, crs;
  CameraChoice cameras;
  bool index = false, windows = false, force = false;
  bool explain = false, json = false;
  SequenceArguments sequence;
};

void addArguments(CLI::App& verb, EncodeArguments& arguments);

/// --regions as tks_encode_options has it; the library refuses sides that it does not take.
Result<uint32_t> parseRegions(const std::string& text);

/// TKS_USAGE if they do not go together.
Status checkArguments(const EncodeArguments& arguments);

}  // namespace tetrakis::tools

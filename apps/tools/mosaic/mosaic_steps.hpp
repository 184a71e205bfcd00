// SPDX-License-Identifier: Apache-2.0
// The steps of a mosaic in the folder that its workers share, as the command line asks for them:
// plan, code, merge; join does all of them. Beside them stand status and verify.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/mosaic/work_folder.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// What is to be coded, and for which target: exactly one of bytes, psnr, max_error and lossless.
struct PlanRequest {
  std::vector<std::string> sources;
  std::string output, max_error;
  uint64_t bytes = 0;
  double psnr = 0, step = 0;
  bool lossless = false, force = false;
  uint32_t regions = 0, tile = 0;
  std::optional<double> nodata;
  std::optional<std::string> unit, crs, vertical_datum;
};

/// Plans a mosaic into the folder `work`. notes: of the source.
Status planMosaic(const PlanRequest& request, const std::string& work, Notes& notes);

/// Which tasks a worker runs: one tile ("G,X,Y"), or every N-th task ("I/N"), of all groups (-1) or
/// of one.
struct CodeRequest {
  std::string work = {}, tile = {}, part = {};
  int group = -1;
  uint32_t threads = 1;
};

/// Those tasks. TKS_USAGE: the texts mean none.
Result<std::vector<MosaicTask>> chosenTasks(const WorkFolder& folder, const CodeRequest& request);

/// Runs those that are not done. quiet: without a progress bar.
Status codeMosaic(const CodeRequest& request, bool quiet);

/// How the stream is laid out: "progressive", "windows" or "mixed", the last one with a preview of
/// so many bytes (0: of a tenth).
struct LayoutRequest {
  std::string layout = "mixed";
  uint64_t preview = 0;
};

struct MergeRequest {
  std::string work, output;
  LayoutRequest layout;
  bool force = false;
};

Status mergeMosaic(const MergeRequest& request);

/// A mosaic from its source to its stream, in a folder beside the output that goes away.
struct JoinRequest {
  PlanRequest plan;  ///< its output is the stream
  uint32_t threads = 1;
  LayoutRequest layout;
};
Status joinMosaic(const JoinRequest& request, Notes& notes, bool quiet);

/// Prints how many tasks are done; json: with the names of the others.
Status showMosaic(const std::string& work, bool json);

struct VerifyRequest {
  std::string work, stream, part;
};

/// Compares the samples of every tile, or of every N-th, with those that the stream decodes to.
/// TKS_MISMATCH: it breaks what it promises.
Status verifyMosaic(const VerifyRequest& request, bool quiet);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
#include "encoder/encode_stream.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

#include "base/parallel.hpp"
#include "codec/geometry/quantiser/voids.hpp"
#include "encoder/heights/bounded_heights.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/heights/exact_heights.hpp"
#include "encoder/heights/height_errors.hpp"
#include "encoder/heights/quantised_heights.hpp"
#include "encoder/heights/repeated_lines.hpp"
#include "encoder/selection/write_stream.hpp"
#include "encoder/target/meet_target.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "encoder/views/camera_checks.hpp"
#include "encoder/views/view_priorities.hpp"
#include "encoder/views/views.hpp"
#include "ratecontrol/target.hpp"

namespace tetrakis::inline encoder {

namespace {

using Quantised = std::shared_ptr<const QuantisedHeights>;
using Heights = std::shared_ptr<const CodedHeights>;
using Texture = std::shared_ptr<const CodedTexture>;

/// An error, in sample units, that leaves nothing but the exact steps: no coarser multiples of
/// these, and of floats no other step.
bool leavesExactSteps(const QuantisedHeights& heights, double error) {
  const bool any_step = heights.samples->sample == TKS_F32;
  return heights.steps.exact && !heights.restored() &&
         error < heights.steps.step / (any_step ? 2 : 1);
}

/// Codes the heights within the largest error, or exactly where that takes fewer bytes.
Heights codeWithinBound(const EncodeInputs& inputs, Quantised of) {
  const double error = inputs.options.max_error / std::abs(inputs.heights->scale);
  if (leavesExactSteps(*of, error)) {
    if (Heights exact = exactHeightsFor(inputs, error, UINT64_MAX)) return exact;
  }
  Heights bounded = codeBoundedHeights(inputs, std::move(of));
  const uint64_t bytes = bytesOf(bounded->tracks);
  Heights exact = exactHeightsFor(inputs, error, bytes);
  return exact && bytesOf(exact->tracks) < bytes ? exact : bounded;
}

/// Coding ends at half of the error that is to be reached: the account is not as exact as that, and
/// samples are rounded, which counts where few steps are left. Where that is not enough it goes on.
CodedHeights codeUntilReached(const EncodeInputs& inputs, const Quantised& of,
                              HeightTarget target) {
  const SampleRange range = rangeOf(*inputs.heights, of->steps.valid);
  const double wanted =
      worstMeanSquare(range.high - range.low, inputs.options.psnr) / inputs.heaviest();
  target.mean_square = wanted / (of->steps.step * of->steps.step);
  CoefficientOptions options = heightOptions(inputs);
  if (target.mean_square > 1 && !of->restored())
    options.enough = target.mean_square / 2 * of->counted();
  CodedHeights coded = codeHeights(of, target, options);
  if (coded.tracks.front().complete) return coded;
  const Codewords whole = codewordsOf(coded.tracks);
  if (sampleErrorsOf(coded, whole, options.threads).mean_square <= wanted) return coded;
  return codeHeights(of, target, heightOptions(inputs));
}

/// Codes the heights as the target asks for them.
Heights codeHeightsForTarget(const EncodeInputs& inputs, Quantised of) {
  if (inputs.options.max_error > 0) return codeWithinBound(inputs, std::move(of));
  if (inputs.options.lossless != 0) return codeLosslessHeights(inputs, of);
  HeightTarget target(of->restored() ? Purpose::kLossless : purposeOf(inputs));
  // What a texture leaves of a budget is not known yet; most of it is the texture's.
  constexpr uint64_t kShareBesideTexture = 4;
  if (inputs.budgeted())
    target.bytes = inputs.options.bytes / (inputs.image == nullptr ? 1 : kShareBesideTexture);
  if (inputs.options.psnr > 0)
    return std::make_shared<const CodedHeights>(codeUntilReached(inputs, of, target));
  return std::make_shared<const CodedHeights>(codeHeights(of, target, heightOptions(inputs)));
}

Texture codeTextureForTarget(const EncodeInputs& inputs,
                             const std::shared_ptr<const TextureSource>& of) {
  CodedTexture coded = codeTexture(inputs, of, purposeOf(inputs));
  if (inputs.options.psnr > 0) coded = codeFurtherIfNeeded(inputs, std::move(coded));
  return std::make_shared<const CodedTexture>(std::move(coded));
}

struct Components {
  Heights heights;  ///< null: there are none
  Texture texture;  ///< null: there is none
};

/// Codes both components, at the same time if there are threads. Nothing that is given is kept for
/// longer than it is needed.
Result<Components> codeComponents(const EncodeInputs& inputs, Quantised heights,
                                  const std::shared_ptr<const TextureSource>& texture) {
  Components coded;
  const auto code_heights = [&] {
    if (heights) coded.heights = codeHeightsForTarget(inputs, std::move(heights));
  };
  const auto code_texture = [&] {
    if (texture) coded.texture = codeTextureForTarget(inputs, texture);
  };
  if (inputs.options.threads > 1) {
    parallelFor(2, 2, [&](size_t i) { i == 0 ? code_texture() : code_heights(); });
  } else {
    code_heights();
    if (Status status = reportProgress(inputs.options, 0.4); !status.ok()) return status;
    code_texture();
  }
  if (Status status = reportProgress(inputs.options, 0.8); !status.ok()) return status;
  return coded;
}

Result<Components> quantiseAndCode(const EncodeInputs& inputs) {
  std::shared_ptr<const TextureSource> texture;
  if (inputs.image != nullptr) texture = quantiseTexture(*inputs.image);
  if (inputs.heights == nullptr) return codeComponents(inputs, nullptr, texture);
  Result<Quantised> heights = quantiseHeights(inputs);
  if (!heights.ok()) return heights.status();
  return codeComponents(inputs, *std::move(heights), texture);
}

Result<Selection> codeAndSelect(const EncodeInputs& inputs) {
  Result<Components> coded = quantiseAndCode(inputs);
  if (!coded.ok()) return coded.status();
  return meetTarget(inputs, std::move(coded->heights), std::move(coded->texture));
}

uint64_t bytesOfMaps(const Selection& selection) {
  const auto bytes = [](const PriorityHeader& map) {
    return map.none() ? size_t{0} : map.code.size() + 2;  // the size of tiles, and the length
  };
  return bytes(selection.heights->header.priorities) + bytes(selection.texture->header.priorities);
}

/// Whether the cameras see fewer errors in prefixes of a stream that has maps of priorities than
/// in those of one without, in the mean of half of the budget and all of it.
bool mapsPay(const EncodeInputs& inputs, const Selection& with, const Selection& without) {
  const uint64_t header = headerBytesOf(inputs, without), map = bytesOfMaps(with);
  const uint64_t room = inputs.options.bytes - std::min(inputs.options.bytes, header);
  std::vector<uint64_t> lengths, behind_map;
  for (const uint64_t length : {room / 2, room}) {
    lengths.push_back(length);
    behind_map.push_back(lengths.back() - std::min(lengths.back(), map));
  }
  const std::vector<double> mapped = errorsOfPrefixes(inputs, with, behind_map);
  const std::vector<double> plain = errorsOfPrefixes(inputs, without, lengths);
  constexpr double kNone = 1e-6;  // squared parts of 255
  double logarithms = 0;
  for (size_t i = 0; i < mapped.size(); ++i)
    logarithms += std::log(std::max(mapped[i], kNone) / std::max(plain[i], kNone));
  return logarithms < 0;
}

/// Codes with maps of priorities where these pay. Maps take too little of large budgets to be in
/// doubt (docs/EXPERIMENTS.md), and coding twice takes twice the time.
Result<Selection> selectWithMaps(const EncodeInputs& given, const ViewPriorities& priorities) {
  constexpr uint64_t kCertain = 16;
  Result<Selection> with = codeAndSelect(given.with(given.options, &priorities));
  if (!given.budgeted() || !with.ok() || !with->heights || !with->texture) return with;
  if (bytesOfMaps(*with) * kCertain <= given.options.bytes) return with;
  tks_encode_options options = given.options;
  options.progress = nullptr;  // it has been told of all this
  Result<Selection> without = codeAndSelect(given.with(options, nullptr));
  if (without.ok() && !mapsPay(given, *with, *without)) return without;
  return with;
}

Result<std::vector<uint8_t>> encodeLines(const EncodeInputs& inputs) {
  const ViewPriorities priorities = prioritiesOf(inputs);
  const Result<Selection> selection = selectWithMaps(inputs, priorities);
  if (!selection.ok()) return selection.status();
  if (Status status = reportProgress(inputs.options, 0.9); !status.ok()) return status;
  Result<std::vector<uint8_t>> stream = writeStream(inputs, *selection);
  if (Status status = reportProgress(inputs.options, 0.95); !status.ok()) return status;
  return stream;
}

/// The lines to code; none where all are. Beside a texture cameras look at the coded heights: two
/// lines have an area, one has none. A judge of pictures takes whole heights. A PSNR is that
/// of all samples, of which those of long runs count more: with voids nobody knows by how much.
/// Small budgets have no bytes for a long map.
CodedLines linesFor(const EncodeInputs& given) {
  const tks_encode_options& options = given.options;
  if (given.heights == nullptr || options.picture_error != nullptr) return {};
  CodedLines lines = findRepeatedLines(*given.heights, given.image == nullptr ? 1 : 2);
  if (lines.repeats.none()) return lines;
  const Result<std::vector<uint8_t>> valid = findVoids(*given.heights);
  const bool has_voids = !valid.ok() || !valid->empty();
  if (options.psnr > 0 && (has_voids || lines.heaviest > 1.1)) return {};
  constexpr uint64_t kMostOfBudget = 8;
  if (given.budgeted() && lines.repeats.code.size() > options.bytes / kMostOfBudget) return {};
  return lines;
}

}  // namespace

Result<std::vector<uint8_t>> encodeStream(const EncodeInputs& given) {
  assert(given.heights != nullptr || given.image != nullptr);
  if (Status status = reportProgress(given.options, 0); !status.ok()) return status;
  if (Status status = checkCameras(given); !status.ok()) return status;
  const CodedLines lines = linesFor(given);
  if (lines.repeats.none()) return encodeLines(given);
  const tks_heights coded = lines.of(*given.heights);
  return encodeLines({.heights = &coded,
                      .image = given.image,
                      .options = given.options,
                      .whole = given.heights,
                      .lines = &lines});
}

}  // namespace tetrakis::inline encoder

// SPDX-License-Identifier: Apache-2.0
#include "encoder/encode_stream.hpp"

#include <algorithm>
#include <cassert>
#include <memory>
#include <utility>

#include "base/parallel.hpp"
#include "base/watch.hpp"
#include "encoder/heights/quantised_heights.hpp"
#include "encoder/heights/ways/ways.hpp"
#include "encoder/selection/write_stream.hpp"
#include "encoder/targets/targets.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "encoder/views/pairs.hpp"
#include "encoder/views/view_inputs.hpp"

namespace tetrakis::inline encoder {

namespace {

// The part of the rest of a stage that all pieces of one work complete; most stages have several
// works.
constexpr double kOfTheRest = 0.25;
// Callers are told of progress no more often than this.
constexpr std::chrono::milliseconds kBetweenTellings(50);

}  // namespace

void ToldProgress::stage(double until) {
  assert(until >= 0 && until <= 1);
  const std::lock_guard lock(mutex_);
  done_ = until_;
  until_ = std::max(until_, until);
  tell();
}

void ToldProgress::pass(size_t pieces) {
  assert(pieces > 0);
  const std::lock_guard lock(mutex_);
  if (stopped_) throw Stopped();
  done_ += (until_ - done_) * kOfTheRest / static_cast<double>(pieces);
  if (std::chrono::steady_clock::now() - told_ >= kBetweenTellings) tell();
}

void ToldProgress::tell() {
  const Watched by_nothing(nullptr);  // who is told may call the library
  stopped_ = stopped_ || !tell_(done_);
  if (stopped_) throw Stopped();
  told_ = std::chrono::steady_clock::now();
}

namespace {

// The parts of all work that are done when each stage ends; the rest of the work proves the stream.
constexpr double kHeightsCoded = 0.4, kTextureCoded = 0.8, kSelected = 0.9, kWritten = 0.95;
/// Maps of priorities are in doubt where they take more than this part of the budget. A larger
/// number has more streams coded twice, with maps and without them; a smaller one keeps maps that
/// cost small budgets decibels.
constexpr uint64_t kCertain = 16;

/// Both components before they are coded; null: there is none.
struct Quantised {
  std::shared_ptr<const QuantisedHeights> heights;
  std::shared_ptr<const TextureSource> texture;
};

/// Both components as they are coded for the target; null: there is none.
struct Coded {
  std::shared_ptr<const CodedHeights> heights;
  std::shared_ptr<const CodedTexture> texture;
};

Result<Quantised> quantise(const EncodeInputs& inputs) {
  Quantised quantised;
  if (inputs.image != nullptr) quantised.texture = quantiseTexture(*inputs.image);
  if (inputs.heights == nullptr) return quantised;
  Result<std::shared_ptr<const QuantisedHeights>> heights = quantiseHeights(inputs);
  if (!heights.ok()) return heights.status();
  quantised.heights = *std::move(heights);
  return quantised;
}

/// Codes both components, at the same time if there are threads. Releases each input as soon as its
/// component is coded.
Result<Coded> code(const EncodeInputs& inputs, Quantised quantised) {
  Coded coded;
  const auto code_heights = [&] {
    if (quantised.heights)
      coded.heights = codeHeightsForTarget(inputs, std::move(quantised.heights));
  };
  const auto code_texture = [&] {
    if (quantised.texture)
      coded.texture = std::make_shared<const CodedTexture>(
          codeTextureForTarget(inputs, std::move(quantised.texture)));
  };
  if (inputs.options.threads > 1) {
    beginStage(kTextureCoded);
    parallelFor(2, 2, [&](size_t i) { i == 0 ? code_texture() : code_heights(); });
  } else {
    beginStage(kHeightsCoded);
    code_heights();
    beginStage(kTextureCoded);
    code_texture();
  }
  return coded;
}

/// Quantises and codes both components, and selects the packets that the target needs.
Result<Selection> codeForTarget(const EncodeInputs& inputs) {
  Result<Quantised> quantised = quantise(inputs);
  if (!quantised.ok()) return quantised.status();
  Result<Coded> coded = code(inputs, *std::move(quantised));
  if (!coded.ok()) return coded.status();
  beginStage(kSelected);
  return meetTarget(inputs, std::move(coded->heights), std::move(coded->texture));
}

/// Samples that come first: beside a texture those that cameras look at, of heights alone those
/// that cover much ground. A PSNR and a largest error count all samples alike.
Priorities prioritiesOf(const EncodeInputs& inputs) {
  const bool alike = inputs.options.psnr > 0 || inputs.options.max_error > 0;
  if (alike || inputs.heights == nullptr) return {};
  if (inputs.image != nullptr) return viewPriorities(inputs);
  return {areaPriorities(inputs), {}};
}

/// Maps of priorities may take so large a part of the budget that they do not pay. Of a larger
/// budget they take too little to be in doubt (docs/EXPERIMENTS.md), and coding twice takes twice
/// the time.
bool mapsAreInDoubt(const EncodeInputs& inputs, const Selection& with) {
  return inputs.budgeted() && with.heights && with.texture &&
         bytesOfMaps(with) * kCertain > inputs.options.bytes;
}

/// The same as codeForTarget(), with the maps of priorities, unless those for cameras do not pay.
Result<Selection> codeWithPriorities(const EncodeInputs& inputs) {
  const Priorities priorities = prioritiesOf(inputs);
  Result<Selection> with = codeForTarget(inputs.with(inputs.options, &priorities));
  if (!with.ok() || !mapsAreInDoubt(inputs, *with)) return with;
  Result<Selection> without = codeForTarget(inputs.with(inputs.options, nullptr));
  if (!without.ok()) return with;
  const bool pay = mapsPay(inputs, *with, *without);
  noteOthers(inputs, pay ? *with : *without, pay ? *without : *with);
  return pay ? with : without;
}

}  // namespace

Result<std::vector<uint8_t>> encodeStream(const EncodeInputs& given) {
  assert(given.heights != nullptr || given.image != nullptr);
  if (Status status = checkCameras(given); !status.ok()) return status;
  const CodedLines height_lines = heightLines(given), texel_lines = texelLines(given);
  tks_heights coded_heights = {};
  tks_image coded_image = {};
  const EncodeInputs inputs =
      given.ofLines(height_lines, coded_heights).ofLines(texel_lines, coded_image);
  const Result<Selection> selection = codeWithPriorities(inputs);
  if (!selection.ok()) return selection.status();
  beginStage(kWritten);
  return writeStream(inputs, *selection);
}

}  // namespace tetrakis::inline encoder

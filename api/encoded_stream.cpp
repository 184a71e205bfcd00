// SPDX-License-Identifier: Apache-2.0
#include "api/encoded_stream.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "base/samples.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "encoder/plans/plan.hpp"

namespace tetrakis::inline api {

void giveBytes(std::span<const uint8_t> bytes, tks_buffer& out) {
  out.data = static_cast<uint8_t*>(std::malloc(bytes.size()));
  if (out.data == nullptr) throw std::bad_alloc();
  std::memcpy(out.data, bytes.data(), bytes.size());
  out.size = bytes.size();
}

}  // namespace tetrakis::inline api

void tks_free_buffer(tks_buffer* buffer) {
  if (buffer == nullptr) return;
  std::free(buffer->data);
  *buffer = {nullptr, 0};
}

namespace tetrakis::inline api {

namespace {

Status broken(const std::string& what) {
  return {TKS_MISMATCH,
          "The encoder could not keep its promise: " + what + "; please report this fault."};
}

/// Whether a call has done its work. That memory is exhausted says nothing of the promise.
bool works(tks_status status) {
  if (status == TKS_NO_MEMORY) throw std::bad_alloc();
  return status == TKS_OK;
}

template <class T>
bool sameBits(T a, T b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Checks whether decoded heights keep what was promised of them.
class HeightPromise {
 public:
  HeightPromise(const tks_heights& heights, bool lossless, double max_error)
      : heights_(heights), lossless_(lossless), max_error_(max_error) {}

  template <class T>
  bool keeps(T truth, T decoded, bool valid) const {
    if (!valid) return isVoid(decoded);
    if (lossless_) return sameBits(truth, decoded);
    const double error = std::abs(static_cast<double>(truth) - static_cast<double>(decoded));
    return error * std::abs(heights_.scale) <= max_error_ && !isVoid(decoded);
  }

 private:
  template <class T>
  bool isVoid(T sample) const {
    // As findVoids() does: a nodata value that an integer type cannot hold meets no sample.
    const auto value = static_cast<double>(sample);
    const double nodata = std::is_floating_point_v<T>
                              ? static_cast<double>(static_cast<float>(heights_.nodata))
                              : heights_.nodata;
    return std::isnan(value) || (heights_.has_nodata && value == nodata);
  }

  const tks_heights& heights_;
  bool lossless_;
  double max_error_;
};

Status proveHeights(tks_decoder* decoder, const tks_heights& heights,
                    const HeightPromise& promise) {
  const Result<std::vector<uint8_t>> valid = findVoids(heights);
  if (!valid.ok()) return valid.status();
  return withSampleType(heights.sample, [&](auto type) -> Status {
    using T = decltype(type);
    std::vector<T> decoded(size_t{heights.width} * heights.height);
    if (!works(tks_decode_heights(decoder, decoded.data(), decoded.size() * sizeof(T))))
      return broken(tks_message(decoder));
    const auto* truth = static_cast<const T*>(heights.data);
    for (size_t i = 0; i < decoded.size(); ++i) {
      if (promise.keeps(truth[i], decoded[i], valid->empty() || (*valid)[i])) continue;
      return broken("the height in column " + std::to_string(i % heights.width) + ", row " +
                    std::to_string(i / heights.width) + " does not come back");
    }
    return {};
  });
}

Status proveTexture(tks_decoder* decoder, const tks_image& image) {
  std::vector<uint8_t> decoded(size_t{image.width} * image.height * image.channels *
                               tks_sample_bytes(image.sample));
  if (!works(tks_decode_texture(decoder, decoded.data(), decoded.size())))
    return broken(tks_message(decoder));
  if (std::memcmp(decoded.data(), image.data, decoded.size()) == 0) return {};
  return broken("a texel does not come back");
}

}  // namespace

tks_limits unlimited() {
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_samples = limits.max_texels = limits.max_memory = std::numeric_limits<uint64_t>::max();
  return limits;
}

Status prove(std::span<const uint8_t> stream, const StreamSource& source,
             const tks_encode_options& options) {
  const auto& [heights, images, references] = source;
  if (options.bytes != 0 && stream.size() > options.bytes)
    return broken("the stream takes more than its budget");
  const tks_limits limits = unlimited();
  const Result<OwnedDecoder> decoder = openBehind(stream, &limits, references);
  if (!decoder.ok()) return broken("the stream does not open");
  tks_decoder* const opened = decoder->get();
  tks_set_threads(opened, options.threads);
  tks_info info = {};
  info.size = sizeof info;
  if (!works(tks_get_info(opened, &info))) return broken("the stream says nothing of itself");
  const bool lossless = info.lossless != 0;
  if (options.lossless != 0 && !lossless) return broken("the stream is not lossless");
  const bool heights_promise = lossless || options.max_error > 0;
  for (uint32_t t = 0; t < std::max(heights.size(), images.size()); ++t) {
    if (!works(tks_set_frame(opened, t))) return broken("the stream lacks a frame");
    Status status;
    if (!heights.empty() && heights_promise)
      status =
          proveHeights(opened, heights[t], HeightPromise(heights[t], lossless, options.max_error));
    if (status.ok() && !images.empty() && lossless) status = proveTexture(opened, images[t]);
    if (!status.ok()) return status;
  }
  return {};
}

namespace {

// The numbers of the C interface are those of the encoder's enumerations.
static_assert(static_cast<int>(Verdict::kWorseInBudget) == TKS_VERDICT_WORSE_IN_BUDGET);
static_assert(static_cast<int>(Residual::Kind::kExact) == TKS_RESIDUAL_EXACT);
static_assert(static_cast<int>(Coding::kWavelet) == TKS_BASE_WAVELET);

/// The words of a plan, which outlive the struct that refers to them.
struct Words {
  std::string filters, layers;

  explicit Words(const Plan& plan) : filters(filterWords(plan)), layers(layerWords(plan)) {}
};

/// unit: of errors that the encoder has in samples.
tks_weighed_plan toldPlan(const WeighedPlan& weighed, const Words& words, double unit) {
  const Plan& plan = weighed.plan;
  const double step = unit * plan.step;
  tks_weighed_plan told = {};
  told.size = sizeof told;
  told.verdict = static_cast<tks_verdict>(weighed.verdict);
  told.base = static_cast<tks_base>(plan.base);
  told.residual = static_cast<tks_residual>(plan.residual.kind);
  told.step = plan.step;
  told.table_values = plan.table_values;
  told.fractions = plan.fractions ? 1 : 0;
  told.filters = words.filters.c_str();
  told.predictor = predictorWords(plan);
  told.layers = words.layers.c_str();
  told.cut = plan.cut ? *plan.cut * step : -1;
  told.within = plan.residual.within * step;
  told.expected_bytes = weighed.expected.value_or(-1);
  if (!weighed.coded) return told;
  told.coded = 1;
  told.coded_bytes = weighed.coded->bytes;
  told.needed_bytes = weighed.coded->needed;
  told.header_bytes = weighed.coded->in_header;
  told.rmse = weighed.coded->rmse * unit;
  return told;
}

void tell(const ComponentNotes& notes, bool is_texture, double unit,
          const tks_encode_options& options) {
  for (const WeighedPlan& weighed : notes.plans()) {
    const Words words(weighed.plan);
    tks_weighed_plan told = toldPlan(weighed, words, unit);
    told.is_texture = is_texture ? 1 : 0;
    options.explain(options.explain_user, &told);
  }
}

}  // namespace

void explain(const PlanNotes& notes, double scale, const tks_encode_options& options) {
  tell(notes.heights, false, std::abs(scale), options);
  tell(notes.texture, true, 1, options);
}

}  // namespace tetrakis::inline api

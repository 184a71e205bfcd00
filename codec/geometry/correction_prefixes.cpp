// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/heights_encoder.hpp"

#include <cassert>
#include <utility>

#include "base/samples.hpp"
#include "bitstream/coder/growing_decoder.hpp"
#include "bitstream/coder/range_decoder.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"
#include "codec/geometry/corrections/corrections_decoder.hpp"
#include "codec/geometry/corrections/exact_corrections.hpp"
#include "codec/geometry/facets/facet_coder.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/plane_corrections.hpp"
#include "codec/geometry/relative/relative_pass.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline geometry {

namespace {

/// Finds which bytes decide each sample. It runs the passes of decoders, and corrects nothing.
class WatchedCorrections {
 public:
  WatchedCorrections(const DecodedGeometry& geometry, const GeometryHeader& header,
                     const GeometryLayers& layers, std::span<const uint8_t> codeword)
      : geometry_(geometry),
        header_(header),
        layers_(layers),
        codeword_(codeword),
        plane_(geometry.heights, geometry.extent(), geometry.valid) {}

  DecidedPlaces run() {
    switch (layers_.corrections) {
      case CorrectionKind::kNone:
        break;
      case CorrectionKind::kSteps:
        layers_.correction_step > 1
            ? ofHints(activityHints(geometry_.significant, geometry_.extent()))
            : ofExactSteps();
        break;
      case CorrectionKind::kSamples:
        ofHints(sampleHints(geometry_.heights, geometry_.fraction_bits, header_));
        break;
      case CorrectionKind::kRelative:
        ofRelative();
        break;
      case CorrectionKind::kFacets:
        ofFacets();
        break;
    }
    return std::move(decided_);
  }

 private:
  /// Notes the bytes so far when a pass asks for a sample.
  template <class Value>
  auto noting(const auto& reader) {
    return [&](size_t sample) {
      decided_.next(sample, reader.decoder().bytes());
      return Value{};
    };
  }
  void end(const auto& reader) {
    assert(!reader.stopped());
    decided_.end(reader.decoder().bytes());
  }

  void ofHints(const std::vector<uint8_t>& hints) {
    DecisionDecoding<GrowingDecoder> reader(codeword_);
    codeCorrections({hints, geometry_.extent(), geometry_.valid}, reader, noting<int32_t>(reader),
                    [](size_t, std::span<const int32_t>) {});
    end(reader);
  }
  void ofExactSteps() {
    DecisionDecoding<GrowingDecoder> reader(codeword_);
    codeExactSteps(plane_, geometry_.fraction_bits, reader, noting<int32_t>(reader),
                   [](size_t, std::span<const int32_t>) {});
    end(reader);
  }
  void ofRelative() {
    DecisionDecoding<GrowingDecoder> reader(codeword_);
    withSampleType(static_cast<tks_sample>(header_.sample), [&](auto type) {
      using T = decltype(type);
      codeRelativeRows<T>({header_, layers_.relative, plane_, geometry_.fraction_bits}, reader,
                          noting<T>(reader), [](size_t, T) {});
    });
    end(reader);
  }
  void ofFacets() {
    DecisionDecoding<GrowingDecoder> reader(codeword_);
    codeFacets({header_, FacetUnit(layers_.facet_unit), plane_, geometry_.fraction_bits}, reader,
               noting<float>(reader), [](size_t, float) {});
    end(reader);
  }

  const DecodedGeometry& geometry_;
  const GeometryHeader& header_;
  const GeometryLayers& layers_;
  std::span<const uint8_t> codeword_;
  PlaneView<const int32_t> plane_;
  DecidedPlaces decided_;
};

class CorrectionPrefixes {
 public:
  CorrectionPrefixes(const GeometryHeader& header, const GeometryLayers& layers,
                     std::span<const uint8_t> track) {
    TakenLayers taken = takeApart({track}, header, layers);
    const std::span<const uint8_t> codeword = taken.corrections.front();
    const DecodedHeights before =
        decodeUncorrected(header, layers, {track.first(track.size() - codeword.size())});
    decided_ = WatchedCorrections(before.geometry, header, layers, codeword).run();
    whole_ = corrected(before, taken, {});
    taken.corrections.front() = {};
    blank_ = corrected(before, taken, {});
    shown_ = blank_;
  }

  const DecodedHeights& after(uint64_t bytes) {
    decided_.showAfter(
        bytes, [&] { shown_ = blank_; },
        [&](size_t sample) {
          shown_.geometry.heights[sample] = whole_.geometry.heights[sample];
          if (!shown_.corrections.empty()) shown_.corrections[sample] = whole_.corrections[sample];
        });
    return shown_;
  }

 private:
  DecidedPlaces decided_;         ///< the samples
  DecodedHeights blank_, whole_;  ///< behind none and all of the corrections
  DecodedHeights shown_;
};

}  // namespace

std::function<DecodedHeights(uint64_t bytes)> prefixesOfCorrections(
    const GeometryHeader& header, const GeometryLayers& layers, std::span<const uint8_t> track) {
  return [&header, &layers, track,
          prefixes = std::shared_ptr<CorrectionPrefixes>()](uint64_t bytes) mutable {
    if (!prefixes) prefixes = std::make_shared<CorrectionPrefixes>(header, layers, track);
    return prefixes->after(bytes);
  };
}

}  // namespace tetrakis::inline geometry

// SPDX-License-Identifier: Apache-2.0
// decodeTexture() takes any prefix of the tracks of a texture and returns the texels of a view, as
// the texture's header says: from wavelet coefficients behind a mask and an overlay (TexturePlan,
// takeOpening()), from a drawing, or from stored samples.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/plane.hpp"
#include "base/samples.hpp"
#include "base/view.hpp"
#include "bitstream/stream/packet.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "codec/frames/frame_planes.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/region_decoder.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/drawn/drawn_decoder.hpp"

namespace tetrakis::inline texture {

// TexturePlan lists the bands in which an image is coded: the subbands of every colour plane. Each
// plane hints at the magnitudes of the next. Encoder and decoder share this plan.

class TexturePlan {
 public:
  /// coded: the texels that the coefficients make. norms: those of an
  /// earlier plan.
  TexturePlan(const TextureHeader& header, const SharedBits& coded,
              const std::optional<SynthesisNorms>& norms = {});

  const PlaneLayout& layout() const { return layout_; }
  /// The regions of the tracks. A track holds the same part of every colour plane.
  const std::vector<Region>& regions() const { return regions_; }
  std::vector<BandPart> parts(size_t region) const { return layout_.parts(regions_[region]); }
  /// Returns the bands of a track. Those of colour plane c begin at parts.size() * c, and follow
  /// each other in the order of the parts of the region.
  std::vector<BandPlan> bands(std::span<const BandPart> parts) const;

 private:
  struct PlaneBands {
    int priority;
    uint32_t models;
  };
  PlaneLayout layout_;
  std::vector<Region> regions_;
  std::vector<PlaneBands> planes_;  ///< of each colour plane
  BandWeights weights_;
};

/// What a texture in frames says of its planes.
FrameLayout frameLayoutOf(const TextureHeader& header);

/// Returns the colour transform that a header describes.
ColourTransform colourOf(const TextureHeader& header);

// takeOpening() decodes the layers that lie before the coefficients of a texture: the mask of a
// cut-out, then an overlay.

struct TextureOpening {
  SharedBits seen;  ///< texels whose alpha is not 0; null: not a cut-out
  DrawnOverlay overlay;
  SharedBits coded;   ///< texels whose coefficients count; null: all
  SharedBits lifted;  ///< texels that have coefficients: those, with liftedSamples() if bridged

  /// Draws what a view of the whole image shows of the overlay over the texels of that view.
  void paint(Extent whole, const View& view, Texels& texels) const;
};

/// What one call of takeOpening() leaves to the next, of the same track.
struct OpeningMemory {
  std::shared_ptr<const TextureOpening> whole;  ///< once it is
  /// Of encoders, which have all of an overlay: what its first bytes show.
  std::function<DrawnOverlay(uint64_t bytes)> overlay = {};
};

/// Decodes what a track opens with, or a prefix of it, and takes it off the codeword. memory: null:
/// there is none.
std::shared_ptr<const TextureOpening> takeOpening(const TextureHeader& header,
                                                  OpeningMemory* memory,
                                                  std::span<const uint8_t>& codeword);

// decodeStoredTexture() reads the texels of a view from a texture whose samples are stored, because
// coding them would take more bytes.

/// Returns the texels that a view shows. codeword: any prefix of the track of a texture with
/// header.stored. Safe on any bytes. A sample that has no byte yet is half of the largest.
Texels decodeStoredTexture(const TextureHeader& header, std::span<const uint8_t> codeword,
                           const View& view);

// decodeTexture() decodes prefixes of the tracks of a texture to the texels of a view. It computes
// with integers only.

/// What one call of decodeTexture() leaves to the next, whose tracks begin with the same bytes. It
/// is empty before the first call.
struct TextureMemory {
  OpeningMemory opening;
  TrackMemory tracks;  ///< once the opening is whole: what exists of them follows from it
  /// Of encoders, which have all of a drawing: what its first bytes show.
  std::function<Texels(uint64_t bytes)> drawing = {};
  /// Of encoders that look at many prefixes of small textures: the colour planes, most of which a
  /// few more bytes leave as they are; empty: they are not kept.
  std::vector<SynthesisMemory> planes = {};
  KeptFrames frames = {};  ///< of a texture in frames: all frames of the last view

  uint64_t bytes() const;
};

/// Decodes what a view shows; in a window the time follows its size if the image has regions.
/// The part of the coded lines that is decoded for a view of them.
View decodedView(const TextureHeader& header, const View& view);

/// codewords: any prefix of each track, one for each of regionsOf(). Safe on any bytes and on any
/// header that readHeader() accepts. The memory is that of earlier calls with the same header, for
/// views of which it keeps all levels, or with the same view.
Texels decodeTexture(const TextureHeader& header, const Codewords& codewords, const View& view = {},
                     const DecodeContext<TextureMemory>& context = {});

/// The last frame of a texture in frames, as the next group goes on from it.
FrameReference lastFrame(const TextureHeader& header, const Codewords& codewords,
                         const DecodeContext<TextureMemory>& context = {});

}  // namespace tetrakis::inline texture

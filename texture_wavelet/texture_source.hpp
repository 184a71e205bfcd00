// SPDX-License-Identifier: Apache-2.0
// TextureSource holds an image to encode and the masks that follow from it alone, because an image
// is often coded several times. showsBetter() compares two attempts, and a PassedTexture notes one
// that lost. Encoder only.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/forest.hpp"
#include "base/samples.hpp"
#include "bitstream/stream/encoded_texture.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/priority_map.hpp"
#include "texture_wavelet/mask/mask.hpp"

namespace tetrakis::inline texture {

// A PassedTexture is an attempt to code a texture, or the estimate of one, that another attempt has
// won over. encodeTexture() lists them for callers who want to know what was weighed; passOver()
// and passOverExpected() do nothing where the list is null.

enum class PassedFor : uint8_t {
  kExpectedLonger,  ///< an estimate says that it takes more bytes: it was not coded
  kLonger,          ///< it takes as many bytes as the whole of another one, or more
  kShowsWorse       ///< what its prefixes show counts for more than its bytes (showsBetter())
};

struct PassedTexture {
  TextureHeader header;  ///< without filters and tables if it was not coded
  PassedFor reason = PassedFor::kShowsWorse;
  uint64_t bytes = 0;  ///< of its tracks
  double squares = 0;  ///< the squared error that these leave; 0 of an estimate
};

using PassedTextures = std::vector<PassedTexture>;

PassedTexture passedOf(const EncodedTexture& encoded);

/// Lists an attempt over which another one has won, with the reason that their bytes give.
void passOver(PassedTextures* list, PassedTexture lost, const EncodedTexture& winner);

/// Lists a way to code the texture that would take so many bytes: with its samples stored, or else
/// by wavelet.
void passOverExpected(PassedTextures* list, bool stored, uint64_t bytes);

// TextureSource holds an image and what follows from it alone, such as the mask of a cut-out.
// TextureOptions says how to code it. An image is often coded several times before the best way is
// known, so TextureSource finds its masks only once.

struct TextureSource {
  /// Any image is a source.
  TextureSource(Texels image, bool goes_round = false, SharedForest of = {})
      : texels(std::move(image)),
        cutout(of == nullptr ? cutoutOf(texels) : std::vector<uint8_t>()),
        softly_seen(softlySeen(texels)),
        ring(goes_round),
        forest(std::move(of)) {}

  /// Marks the texels that have colours. hidden: those that a cut-out does not show have none.
  Mask coloured(bool hidden) const { return hidden ? Mask(cutout) : Mask(); }

  /// Marks the texels whose colours count in errors: lossy ones are free where alpha is 0.
  Mask counted(Purpose purpose) const {
    if (purpose == Purpose::kLossless) return {};
    return Mask(cutout.empty() ? softly_seen : cutout);
  }

  /// Channels that are colour planes: all but the alpha of a cut-out.
  uint32_t colours() const { return texels.channels - (cutout.empty() ? 0 : 1); }

  Texels texels;
  std::vector<uint8_t> cutout;       ///< cutoutOf(texels)
  std::vector<uint8_t> softly_seen;  ///< softlySeen(texels)
  bool ring;                         ///< WaveletHeader::ring
  SharedForest forest;               ///< WaveletHeader::forest; has neither mask nor overlay
};

struct TextureOptions {
  uint64_t limit = UINT64_MAX;  ///< bytes worth coding, of all tracks together
  int region_log2 = 0;          ///< bitstream/track/track.hpp; 0: one track
  uint32_t threads = 1;         ///< nothing depends on them
  bool windows = false;         ///< withShortReach()
  bool visual = false;          ///< what is seen comes first, not what is off most
  uint64_t room = UINT64_MAX;   ///< bytes that will be sent at most, if there is a budget
  double mean_square = 0;       ///< error that a lossy texture is to reach, if there is a target
  bool tables = true;           ///< of values: lossless textures may have them
  const PriorityMap* priorities = nullptr;  ///< what comes earlier; null: nothing
  /// Takes the attempts that are passed over; null: nobody asked for them.
  PassedTextures* passed = nullptr;
};

// showsBetter() decides from the accounts of two encodings of an image, without decoding them,
// which of them is better.

/// Bytes of all tracks, and of the tables in the header.
uint64_t bytesOf(const EncodedTexture& encoded);

/// Whether a shows the image better than b where they will be cut: in fewer bytes if there is an
/// error aimed at, or if both are whole, else by less error in as many bytes. What shorter prefixes
/// show counts as well, least where somebody asks for an error. samples: that count.
bool showsBetter(const EncodedTexture& a, const EncodedTexture& b, const TextureOptions& options,
                 uint64_t samples);

}  // namespace tetrakis::inline texture

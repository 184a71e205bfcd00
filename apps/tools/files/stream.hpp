// SPDX-License-Identifier: Apache-2.0
// openStream() reads streams (.tks) for the verbs, and decodeHeights() and decodeImage() decode
// them to the types that files are written from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "base/plane.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/sequence.hpp"

namespace tetrakis::tools {

/// Which stream to open, and how much of it.
struct StreamSource {
  std::string path;               ///< "-": standard input
  std::optional<uint64_t> bytes;  ///< cut after that many; nothing: all of it
  bool strict = false;            ///< refuse a file that ends early or breaks the syntax anywhere
  std::optional<uint64_t> frame = {};  ///< of a sequence, or a group of one; nothing: the first
  std::optional<double> seconds = {};  ///< of a sequence: behind its epoch, in the place of that
  /// Names or numbers of components to take for the heights and the texture, of one stream.
  std::vector<std::string> components = {};
};

/// Where a stream lies that is a group of a sequence.
struct SequencePlace {
  uint64_t frames = 0, groups = 0;                    ///< of the sequence, as far as it is there
  uint64_t bytes = 0;                                 ///< of the sequence, as far as it is there
  uint64_t frame = 0;                                 ///< that is shown
  int64_t time = 0;                                   ///< of it, in ticks
  uint64_t tick_numerator = 0, tick_denominator = 0;  ///< seconds in a tick; 0: unknown
  std::string epoch, calendar;
  tks_group group = {};
};

/// Seconds behind the epoch, by a clock whose ticks are known.
double secondsOf(int64_t ticks, uint64_t tick_numerator, uint64_t tick_denominator);

/// A stream in memory and its decoder. Move only.
struct OpenStream {
  std::vector<std::byte> bytes;         ///< of a sequence those of the stream that holds the frame
  std::optional<Sequence> groups = {};  ///< of a sequence, which then owns the decoder
  Decoder decoder;
  std::optional<SequencePlace> sequence = {};
};

/// The same bytes under the type that the library takes.
std::span<const uint8_t> octets(std::span<const std::byte> bytes);

/// Limits of decoders of every size that the format holds, within the memory of this process
/// (memory_limit.hpp).
tks_limits limitsOfTools();

/// A decoder with these limits.
Result<Decoder> openDecoder(std::span<const uint8_t> bytes);

/// Another decoder of the stream, which takes the same components and shows the same frame. Of a
/// sequence there is none, whose frames may go on from other groups.
Result<Decoder> openAgain(const OpenStream& stream);

/// Whether the bytes begin as a sequence does, and not as a stream.
bool isSequence(std::span<const std::byte> bytes);

/// Reads, checks (strict), cuts and opens. Of a sequence it opens the group of a frame. A cut
/// that leaves no whole header gives TKS_TRUNCATED.
Result<OpenStream> openStream(const StreamSource& source);

/// Shows another frame of an open stream, or of the sequence that it belongs to: of that its bytes
/// and its place stay those of the frame before.
Status showFrame(OpenStream& stream, uint64_t frame);

/// Whether a stream holds an object: heights over a base mesh, or triangles as they are.
inline bool isObject(const tks_info& info) {
  return info.base_mesh.position_bits > 0 || info.object_triangles > 0;
}

/// The first bytes of a stream, or of a sequence, that openStream() opens: of a sequence, so many
/// whole groups and a part of the next one.
Result<std::vector<std::byte>> readCut(const StreamSource& source);

/// openStream() for what takes heights over ground: TKS_USAGE if the stream holds an object.
Result<OpenStream> openTerrain(const StreamSource& source);

/// Columns and rows of heights as files hold them: those of the grid that a cube was made of.
Extent shownHeights(const tks_info& info);

/// Decoded heights with the metadata of the stream, of a window of samples or all of them. Of
/// heights on a cube that were made of a grid they are the grid's. copies:
/// what the caller makes of them, in bytes, which has to fit beside them. TKS_USAGE if the stream
/// has none, or not that window; TKS_LIMIT.
Result<HeightFile> decodeHeights(Decoder& decoder, const std::optional<tks_window>& window = {},
                                 uint64_t copies = 0);

/// Decoded texture, of a window of texels or all of it. Likewise.
Result<ImageFile> decodeImage(Decoder& decoder, const std::optional<tks_window>& window = {},
                              uint64_t copies = 0);

/// Bytes of what these return.
uint64_t heightsBytes(const tks_info& info, const std::optional<tks_window>& window = {});
uint64_t imageBytes(const tks_info& info, const std::optional<tks_window>& window = {});

}  // namespace tetrakis::tools

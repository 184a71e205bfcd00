// SPDX-License-Identifier: Apache-2.0
// The reference decoder: a second decoder, slow and plain, written from docs/FORMAT.md alone. It
// shares no code with the library, so that a stream on which both agree means what the text says.
// "FORMAT n" in its comments names the section that a function implements.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tetrakis::reference {

/// What the bytes are. Everything but kDone comes without samples.
enum class Outcome {
  kDone,
  kTruncated,    ///< the header is not complete
  kCorrupt,      ///< breaks the syntax of the header or of a packet head
  kUnsupported,  ///< another version or profile
  kTooLarge      ///< a component of more samples or texels than the caller takes
};

/// Samples, or texels, that a component may have unless the caller says otherwise.
inline constexpr uint64_t kMaxSamples = uint64_t{1} << 22;

/// Mip levels (FORMAT 7.1) of the two components, 0 the whole. One beyond the coarsest is that one.
struct Levels {
  int heights = 0, texture = 0;
};

/// FORMAT 2: the numbers of components that were asked for in the place of the first of their kind.
struct Choice {
  std::optional<size_t> heights, texture;
};

/// Samples are rows from the top, channels interleaved, little endian, of the type in the header.
/// A component that the stream does not announce stays empty.
struct Decoded {
  Outcome outcome = Outcome::kDone;
  std::optional<std::vector<uint8_t>> heights;
  std::optional<std::vector<uint8_t>> texture;
};

/// Decodes the first bytes of a stream: all of them, or any prefix. Safe on any input.
Decoded decode(std::span<const uint8_t> prefix, uint64_t maxSamples = kMaxSamples,
               Levels levels = {}, const Choice& choice = {});

/// FORMAT 14.
struct DecodedGroup {
  uint64_t firstFrame = 0;
  std::vector<int64_t> times;  ///< of each frame, in ticks
  Decoded frames;              ///< one behind the other
};
struct DecodedSequence {
  Outcome outcome = Outcome::kDone;  ///< of the heads: those before the first that is wrong count
  std::vector<DecodedGroup> groups;  ///< whose streams have begun
};
DecodedSequence decodeSequence(std::span<const uint8_t> prefix, uint64_t maxSamples = kMaxSamples,
                               Levels levels = {});

/// FORMAT 11, "Objects".
using Vector = std::array<int64_t, 3>;
struct BasePoint {
  Vector place, normal;
};

/// What the heights of a stream lie over that has a base mesh.
struct Object {
  int bits = 0;
  double cell = 1;
  std::array<double, 3> origin = {};
  std::vector<Vector> corners;    ///< four a patch
  std::vector<BasePoint> points;  ///< of all samples of the raster
};

/// Nothing where there is no base mesh, or the stream does not decode.
std::optional<Object> decodeObject(std::span<const uint8_t> prefix,
                                   uint64_t maxSamples = kMaxSamples);

/// FORMAT 11, "Triangles".
struct Triangles {
  bool sound = true;  ///< else the codeword is corrupt, and nothing is there
  std::vector<std::array<double, 3>> places;     ///< of each corner, three a triangle
  std::vector<std::array<double, 2>> texcoords;  ///< likewise; none: there are none
};

/// Nothing where there is no triangle mesh, or the stream does not decode.
std::optional<Triangles> decodeTriangles(std::span<const uint8_t> prefix,
                                         uint64_t maxSamples = kMaxSamples);

/// Where a sample of that height lies.
std::array<double, 3> placeOf(const Object& object, size_t sample, double height);

}  // namespace tetrakis::reference

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
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// Which stream to open, and how much of it.
struct StreamSource {
  std::string path;               ///< "-": standard input
  std::optional<uint64_t> bytes;  ///< cut after that many; nothing: all of it
  bool strict = false;            ///< refuse a file that ends early or breaks the syntax anywhere
};

/// A stream in memory and its decoder. Move only.
struct OpenStream {
  std::vector<std::byte> bytes;
  Decoder decoder;
};

/// The same bytes under the type that the library takes.
std::span<const uint8_t> octets(std::span<const std::byte> bytes);

/// A decoder of every size that the format holds, within the memory of this process
/// (memory_limit.hpp).
Result<Decoder> openDecoder(std::span<const uint8_t> bytes);

/// Reads, checks (strict), cuts and opens. A cut that leaves no whole header gives TKS_TRUNCATED.
Result<OpenStream> openStream(const StreamSource& source);

/// Whether a stream holds an object: heights over a base mesh, or triangles as they are.
inline bool isObject(const tks_info& info) {
  return info.base_mesh.position_bits > 0 || info.object_triangles > 0;
}

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

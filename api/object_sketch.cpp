// SPDX-License-Identifier: Apache-2.0
// Nothing of an object is seen before its header is there, and a fine base, or triangles, may make
// up most of the stream. withSketch() then begins the header with a stream of a few bytes, of the
// same object over a coarse base.
#include <algorithm>
#include <optional>
#include <utility>

#include "api/object_inputs.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline api {
namespace {

/// A header of more bytes than this, and than this part of its stream, comes late.
constexpr uint64_t kLateBytes = 4096;
constexpr uint64_t kLatePart = 16;

/// A sketch takes this part of the stream: a larger one shows more for as long as the header is on
/// its way, and takes more off all that comes then.
constexpr uint64_t kSketchPart = 32;
constexpr uint64_t kFewest = 1000;
constexpr uint64_t kMost = 32768;

/// The bytes that a sketch takes beside its own: kind and length of its part, and more digits of
/// the body's length.
constexpr uint64_t kAround = 8;

uint64_t bytesOfSketch(const GivenObject& given, const std::vector<uint8_t>& stream) {
  if (given.mesh.sketch_bytes == TKS_NO_SKETCH) return 0;
  if (given.mesh.sketch_bytes > 0) return given.mesh.sketch_bytes;
  const uint64_t header = *headerBytes(stream), part = stream.size() / kSketchPart;
  const bool is_late = header > std::max<uint64_t>(kLateBytes, stream.size() / kLatePart);
  return is_late && part >= kFewest ? std::min(part, kMost) : 0;
}

Result<CodedObject> encodedWithin(GivenObject& given, uint64_t bytes, tks_object_kind kind) {
  const tks_encode_options before = given.options;
  given.options.bytes = bytes;
  given.options.psnr = given.options.max_error = 0;
  Result<CodedObject> coded =
      kind == TKS_OBJECT_TRIANGLES ? encodeTriangles(given) : encodeResampled(given);
  given.options = before;
  return coded;
}

std::vector<uint8_t> behind(const std::vector<uint8_t>& sketch,
                            const std::vector<uint8_t>& stream) {
  Result<ParsedHeader> parsed = readHeader(stream);
  parsed->header.sketch.assign(sketch.begin(), sketch.end());
  std::vector<uint8_t> sketched = writeHeader(parsed->header);
  sketched.insert(sketched.end(), stream.begin() + static_cast<ptrdiff_t>(parsed->bytes),
                  stream.end());
  return sketched;
}

}  // namespace

Result<CodedObject> withSketch(GivenObject& given, CodedObject whole) {
  const uint64_t wanted = bytesOfSketch(given, whole.stream), budget = given.options.bytes;
  if (wanted == 0) return whole;
  const bool is_asked_for = given.mesh.sketch_bytes > 0;
  if (budget > 0 && wanted + kAround >= budget)
    return misusedObject("The sketch leaves no bytes to the stream.");
  Result<CodedObject> sketch = encodedWithin(given, wanted, TKS_OBJECT_RESAMPLED);
  if (!sketch.ok()) return is_asked_for ? sketch : whole;
  const uint64_t taken = sketch->stream.size() + kAround;
  if (budget > 0 && whole.stream.size() + taken > budget) {
    Result<CodedObject> shorter = encodedWithin(given, budget - taken, whole.kind);
    if (!shorter.ok()) return is_asked_for ? shorter : whole;
    whole = *std::move(shorter);
  }
  whole.stream = behind(sketch->stream, whole.stream);
  whole.sketch_bytes = sketch->stream.size();
  if (budget > 0 && whole.stream.size() > budget)
    return Status(TKS_MISMATCH, "The stream of the object is longer than its budget.");
  if (!readHeader(whole.stream).ok()) return misusedObject("The header takes too many bytes.");
  return whole;
}

}  // namespace tetrakis::inline api

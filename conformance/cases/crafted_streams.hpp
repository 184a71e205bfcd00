// SPDX-License-Identifier: Apache-2.0
// The functions here build crafted vectors, which no encoder would write, from headers with any
// fields and from codewords of noise.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header.hpp"
#include "conformance/cases/vector_cases.hpp"

namespace tetrakis::conformance {

using Bytes = std::vector<uint8_t>;

/// Bytes that decide something everywhere. The first `ones` are FF, the very end of the range; but
/// the fourth is FE, since four of FF decide nothing (docs/FORMAT.md, section 4).
inline Bytes noise(size_t size, uint32_t seed, size_t ones = 0) {
  Bytes bytes(size, 255);
  if (ones > 3) bytes[3] = 254;
  for (size_t i = ones; i < size; ++i)
    bytes[i] = static_cast<uint8_t>(samples::hash(static_cast<uint32_t>(i), seed, 41) >> 24);
  return bytes;
}

inline void append(Bytes& to, const Bytes& bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

inline Bytes varint(uint64_t value) {
  FieldWriter writer;
  writer.put(value);
  return writer.bytes;
}

/// The header, and one packet that holds all of a component's first codeword.
/// codewords: of the first tracks of the only component, each of which is one packet.
inline Bytes streamOf(StreamHeader header, const std::vector<Bytes>& codewords) {
  const size_t component = header.geometry ? 0 : 1;
  Bytes payload;
  for (size_t track = 0; track < codewords.size(); ++track) {
    if (codewords[track].empty()) continue;
    append(payload, varint(uint64_t{codewords[track].size()} << 2));
    if (trackCounts(header)[component].named) append(payload, varint(track));
    payload.push_back(0);
    append(payload, codewords[track]);
  }
  header.payload_bytes = payload.size();
  Bytes stream = writeHeader(header);
  append(stream, payload);
  return stream;
}

inline Bytes streamOf(const StreamHeader& header, const Bytes& codeword) {
  return streamOf(header, std::vector<Bytes>{codeword});
}

inline VectorCase crafted(const std::string& name, const std::string& purpose, Bytes stream) {
  VectorCase vector_case;
  vector_case.name = name;
  vector_case.purpose = purpose;
  vector_case.stream = std::move(stream);
  return vector_case;
}

inline StreamHeader heightsHeader(uint32_t width, uint32_t height, tks_sample sample, int planes) {
  StreamHeader header;
  GeometryHeader& g = header.geometry.emplace();
  g.width = width;
  g.height = height;
  g.sample = static_cast<uint8_t>(sample);
  g.planes = static_cast<uint8_t>(planes);
  g.wavelet.filters = {3, 1, 2};
  return header;
}

inline StreamHeader textureHeader(uint32_t width, uint32_t height, uint32_t channels,
                                  tks_sample sample, int planes) {
  StreamHeader header;
  TextureHeader& t = header.texture.emplace();
  t.width = width;
  t.height = height;
  t.channels = static_cast<uint8_t>(channels);
  t.sample = static_cast<uint8_t>(sample);
  t.planes = static_cast<uint8_t>(planes);
  t.wavelet.filters = {2, 2, 2};
  t.centre = {100, 130, 90, 128};
  return header;
}

}  // namespace tetrakis::conformance

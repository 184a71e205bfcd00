// SPDX-License-Identifier: Apache-2.0
// TIFF 6.0, sections 3 (packing), 18 and 19 (sample formats); floats of 16 and 24 bits: Adobe
// Photoshop TIFF Technical Note 3.
#include "apps/tools/files/pictures/tiff_samples.hpp"

#include <tiffio.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace tetrakis::tools {
namespace {

/// Numbers of `bits` bits, highest first, without gaps.
template <class T>
void unpackBits(const std::byte* packed, int bits, std::span<std::byte> samples) {
  const uint64_t mask = (uint64_t{1} << bits) - 1;
  uint64_t pending = 0;
  int held = 0;
  for (size_t at = 0; at < samples.size(); at += sizeof(T)) {
    for (; held < bits; held += 8) pending = pending << 8 | std::to_integer<uint64_t>(*packed++);
    held -= bits;
    const auto value = static_cast<T>(pending >> held & mask);
    std::memcpy(&samples[at], &value, sizeof value);
  }
}

/// Three bytes of a float in the order of the host.
uint32_t triple(const std::byte* packed) {
  const auto at = [packed](size_t i) { return std::to_integer<uint32_t>(packed[i]); };
  if constexpr (std::endian::native == std::endian::little) return at(0) | at(1) << 8 | at(2) << 16;
  return at(0) << 16 | at(1) << 8 | at(2);
}

/// Those whose bytes have been turned around.
void unpackTurned(const std::byte* packed, std::span<std::byte> samples) {
  for (size_t at = 0; at < samples.size(); at += sizeof(uint32_t), packed += 3) {
    const uint32_t value = std::to_integer<uint32_t>(packed[0]) |
                           std::to_integer<uint32_t>(packed[1]) << 8 |
                           std::to_integer<uint32_t>(packed[2]) << 16;
    std::memcpy(&samples[at], &value, sizeof value);
  }
}

/// Fields of a small float: sign, exponent, mantissa from the top.
struct SmallFloat {
  int exponent_bits, mantissa_bits;
};
constexpr SmallFloat kHalf{5, 10}, kTriple{7, 16};

/// Exact: a float has a wider exponent and mantissa. NaNs keep their bits.
float widened(uint32_t bits, SmallFloat kind) {
  constexpr int kFloatMantissa = 23;
  const uint32_t mantissa = bits & ((1U << kind.mantissa_bits) - 1);
  const uint32_t most = (1U << kind.exponent_bits) - 1;
  const uint32_t exponent = bits >> kind.mantissa_bits & most;
  const uint32_t sign = bits >> (kind.mantissa_bits + kind.exponent_bits) & 1U;
  if (exponent == most) {
    const uint32_t special =
        sign << 31 | 0x7F800000U | mantissa << (kFloatMantissa - kind.mantissa_bits);
    return std::bit_cast<float>(special);
  }
  const int bias = static_cast<int>(most >> 1);
  const uint32_t significand = exponent == 0 ? mantissa : mantissa | 1U << kind.mantissa_bits;
  const int power = static_cast<int>(std::max(exponent, 1U)) - bias - kind.mantissa_bits;
  const float size = std::ldexp(static_cast<float>(significand), power);
  return sign ? -size : size;
}

void unpackFloats(std::span<const std::byte> packed, SmallFloat kind,
                  std::span<std::byte> samples) {
  const size_t bytes = (1 + kind.exponent_bits + kind.mantissa_bits) / 8;
  for (size_t at = 0, from = 0; at < samples.size(); at += sizeof(float), from += bytes) {
    uint16_t half = 0;
    std::memcpy(&half, &packed[from], sizeof half);
    const float value = widened(bytes == 2 ? half : triple(&packed[from]), kind);
    std::memcpy(&samples[at], &value, sizeof value);
  }
}

template <class T>
void fill(double value, std::span<std::byte> samples) {
  using Limits = std::numeric_limits<T>;
  T sample = 0;
  if constexpr (Limits::is_integer) {
    if (!std::isnan(value))
      sample = static_cast<T>(std::round(
          std::clamp<double>(value, static_cast<double>(Limits::lowest()), Limits::max())));
  } else {
    sample = static_cast<T>(
        std::isfinite(value) ? std::clamp<double>(value, Limits::lowest(), Limits::max()) : value);
  }
  for (size_t at = 0; at < samples.size(); at += sizeof sample)
    std::memcpy(&samples[at], &sample, sizeof sample);
}

}  // namespace

PictureSample typeOf(TiffSample stored) {
  const uint16_t bits = stored.bits;
  switch (stored.format) {
    case SAMPLEFORMAT_UINT:
    case SAMPLEFORMAT_VOID:
      if (bits < 1 || bits > 32) break;
      return bits <= 8    ? PictureSample::kU8
             : bits <= 16 ? PictureSample::kU16
                          : PictureSample::kU32;
    case SAMPLEFORMAT_INT:
      if (bits == 8) return PictureSample::kI8;
      if (bits == 16) return PictureSample::kI16;
      if (bits == 32) return PictureSample::kI32;
      break;
    case SAMPLEFORMAT_IEEEFP:
      if (bits == 16 || bits == 24 || bits == 32) return PictureSample::kFloat;
      if (bits == 64) return PictureSample::kDouble;
      break;
    default:
      break;
  }
  return PictureSample::kOther;
}

void unpackRow(std::span<const std::byte> packed, TiffSample stored, std::span<std::byte> samples) {
  const PictureSample type = typeOf(stored);
  const size_t bits = stored.bits;
  if (bits == 8 * sizeOf(type)) {
    std::copy_n(packed.begin(), samples.size(), samples.begin());
  } else if (type == PictureSample::kFloat) {
    unpackFloats(packed, bits == 16 ? kHalf : kTriple, samples);
  } else if (bits == 24 && stored.swapped) {
    unpackTurned(packed.data(), samples);
  } else if (type == PictureSample::kU8) {
    unpackBits<uint8_t>(packed.data(), stored.bits, samples);
  } else if (type == PictureSample::kU16) {
    unpackBits<uint16_t>(packed.data(), stored.bits, samples);
  } else {
    unpackBits<uint32_t>(packed.data(), stored.bits, samples);
  }
}

void fillSamples(double value, PictureSample type, std::span<std::byte> samples) {
  switch (type) {
    case PictureSample::kU8:
      return fill<uint8_t>(value, samples);
    case PictureSample::kI8:
      return fill<int8_t>(value, samples);
    case PictureSample::kU16:
      return fill<uint16_t>(value, samples);
    case PictureSample::kI16:
      return fill<int16_t>(value, samples);
    case PictureSample::kU32:
      return fill<uint32_t>(value, samples);
    case PictureSample::kI32:
      return fill<int32_t>(value, samples);
    case PictureSample::kFloat:
      return fill<float>(value, samples);
    default:
      return fill<double>(value, samples);
  }
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// Structs of callers compiled against an older or newer tetrakis.h: every size works as documented,
// and nothing is read or written beyond it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <vector>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

constexpr size_t kBeyond = 64;
constexpr std::byte kCanary{0xa5};

/// A struct of `size` bytes in memory of its own (sanitizers see what is read behind it), filled
/// with the first bytes of `full`, then with `rest`.
template <class T>
class Sized {
 public:
  Sized(const T& full, size_t size, std::byte rest = std::byte{0}) : bytes_(size, rest) {
    std::memcpy(bytes_.data(), &full, std::min(size, sizeof(T)));
    if (size >= sizeof(size_t)) std::memcpy(bytes_.data(), &size, sizeof size);
  }
  T* get() { return reinterpret_cast<T*>(bytes_.data()); }

 private:
  std::vector<std::byte> bytes_;
};

/// The bytes that a library sees of a struct of this size: whole granules of its alignment.
template <class T>
size_t seenBytes(size_t size) {
  return std::min(size, sizeof(T)) / alignof(T) * alignof(T);
}

/// What a library sees of a struct that is cut: the bytes that it sees, then zeros.
template <class T>
T cut(T full, size_t size) {
  const size_t known = seenBytes<T>(size);
  std::memset(reinterpret_cast<std::byte*>(&full) + known, 0, sizeof(T) - known);
  full.size = sizeof(T);
  return full;
}

class StructSizes : public testing::Test {
 protected:
  StructSizes() {
    for (size_t i = 0; i < samples_.size(); ++i) samples_[i] = static_cast<uint8_t>(i * i / 7);
    const double transform[] = {399960, 10, 0, 5300040, 0, -10};
    heights_ = {sizeof heights_,
                18,
                6,
                TKS_U8,
                samples_.data(),
                0.5,
                3,
                1,
                30,
                31,
                "m",
                "EGM",
                "x",
                1,
                9,
                {},
                1,
                TKS_REGISTRATION_POINT,
                "bare earth",
                "1024=1",
                nullptr,
                0,
                TKS_DOMAIN_CYLINDER,
                60,
                -60,
                {},
                0,
                0,
                {}};
    image_ = {sizeof image_,
              9,
              5,
              2,
              TKS_U8,
              samples_.data(),
              {},
              1,
              TKS_REGISTRATION_AREA,
              "y",
              "1024=2",
              1,
              255,
              nullptr,
              0,
              TKS_DOMAIN_CYLINDER,
              {}};
    std::copy(std::begin(transform), std::end(transform), heights_.geotransform);
    std::copy(std::begin(transform), std::end(transform), image_.geotransform);
    options_.size = sizeof options_;
    options_.lossless = 1;
    options_.index = 1;
    options_.regions = 16;
    options_.weights = TKS_WEIGHTS_VISUAL;
  }

  struct Outcome {
    tks_status status;
    Bytes bytes;
    bool operator==(const Outcome&) const = default;
    friend std::ostream& operator<<(std::ostream& out, const Outcome& outcome) {
      return out << "status " << outcome.status << ", " << outcome.bytes.size() << " bytes";
    }
  };
  static Outcome encode(const tks_heights* heights, const tks_image* image,
                        const tks_encode_options* options) {
    tks_buffer buffer = {};
    const tks_status status = tks_encode(heights, image, options, &buffer, nullptr, 0);
    Outcome outcome{status, Bytes(buffer.data, buffer.data + buffer.size)};
    tks_free_buffer(&buffer);
    return outcome;
  }

  /// A struct below the first version is refused; others count as far as they are seen.
  template <class T, class Encode>
  static void encodeEverySize(const T& full, size_t first_version, Encode encodeOne) {
    Outcome wanted{TKS_USAGE, {}};
    for (size_t size = sizeof(size_t); size <= sizeof full + kBeyond; ++size) {
      SCOPED_TRACE(size);
      if (size == first_version || (size > first_version && seenBytes<T>(size) == size)) {
        const T known = cut(full, size);
        wanted = encodeOne(&known);
        EXPECT_EQ(wanted.status, TKS_OK);
      }
      EXPECT_EQ(encodeOne(Sized<T>(full, size).get()), wanted);
    }
  }

  std::vector<uint8_t> samples_ = std::vector<uint8_t>(18 * 6);
  tks_heights heights_;
  tks_image image_;
  tks_encode_options options_ = {};
};

TEST_F(StructSizes, HeightsOfEverySize) {
  encodeEverySize(heights_, offsetof(tks_heights, step),
                  [&](const tks_heights* heights) { return encode(heights, nullptr, &options_); });
}

TEST_F(StructSizes, OptionsOfEverySize) {
  encodeEverySize(options_, offsetof(tks_encode_options, threads),
                  [&](const tks_encode_options* o) { return encode(&heights_, &image_, o); });
}

TEST_F(StructSizes, ImagesOfEverySize) {
  encodeEverySize(image_, offsetof(tks_image, geotransform),
                  [&](const tks_image* image) { return encode(nullptr, image, &options_); });
}

TEST_F(StructSizes, FieldsThatAreUnknownMustBeZero) {
  Sized<tks_heights> heights(heights_, sizeof heights_ + 8, kCanary);
  Sized<tks_image> image(image_, sizeof image_ + 8, kCanary);
  Sized<tks_encode_options> options(options_, sizeof options_ + 8, kCanary);
  EXPECT_EQ(encode(heights.get(), nullptr, &options_).status, TKS_UNSUPPORTED);
  EXPECT_EQ(encode(nullptr, image.get(), &options_).status, TKS_UNSUPPORTED);
  EXPECT_EQ(encode(&heights_, nullptr, options.get()).status, TKS_UNSUPPORTED);
}

TEST_F(StructSizes, SizesThatNobodySetAreRefused) {
  heights_.size = ~size_t{0} / 3;
  EXPECT_EQ(encode(&heights_, nullptr, &options_).status, TKS_USAGE);
}

TEST_F(StructSizes, LimitsOfEverySize) {
  const Bytes bytes = encode(&heights_, &image_, &options_).bytes;
  const tks_limits tight = {sizeof(tks_limits), 0, 1, 0};
  for (size_t size = 0; size <= sizeof tight + kBeyond; ++size) {
    // Below sizeof(size_t) the size itself is what is stated, in memory that holds it.
    Sized<tks_limits> sized(tight, std::max(size, sizeof(size_t)));
    sized.get()->size = size;
    tks_decoder* decoder = nullptr;
    const tks_status status =
        tks_open(bytes.data(), bytes.size(), sized.get(), &decoder, nullptr, 0);
    tks_close(decoder);
    const bool reaches = size >= offsetof(tks_limits, max_memory);
    EXPECT_EQ(status, size < sizeof(size_t) ? TKS_USAGE : reaches ? TKS_LIMIT : TKS_OK) << size;
  }
}

TEST_F(StructSizes, InfoOfEverySize) {
  const Bytes bytes = encode(&heights_, &image_, &options_).bytes;
  Stream stream(bytes);
  tks_info whole = {};
  whole.size = sizeof whole;
  ASSERT_EQ(tks_get_info(stream.get(), &whole), TKS_OK);
  for (size_t size = 0; size <= sizeof whole + kBeyond; ++size) {
    std::vector<std::byte> memory(sizeof whole + 2 * kBeyond, kCanary);
    std::memcpy(memory.data(), &size, sizeof size);
    std::vector<std::byte> expected = memory;
    if (size >= offsetof(tks_info, header_bytes)) {
      std::fill_n(expected.begin(), size, std::byte{0});
      std::memcpy(expected.data(), &whole, std::min(size, sizeof whole));
      std::memcpy(expected.data(), &size, sizeof size);
    }
    const tks_status status =
        tks_get_info(stream.get(), reinterpret_cast<tks_info*>(memory.data()));
    EXPECT_EQ(status, size < offsetof(tks_info, header_bytes) ? TKS_USAGE : TKS_OK) << size;
    EXPECT_EQ(memory, expected) << size;
  }
}

}  // namespace
}  // namespace tetrakis::test

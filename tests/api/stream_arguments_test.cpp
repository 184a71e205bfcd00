// SPDX-License-Identifier: Apache-2.0
// Wrong arguments get TKS_USAGE with a sentence, limits TKS_LIMIT before anything is allocated, and
// a failure leaves the outputs alone.
#include <functional>
#include <limits>

#include "conformance/samples/header_seal.hpp"
#include "tests/support/peak_memory.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// A call that works, to be spoilt in one place.
struct Call {
  tks_heights heights;
  tks_image image;
  tks_encode_options options = lossless();
};

class Arguments : public ::testing::Test {
 protected:
  Raster surface_ = make({Pattern::kRidges, 9, 8, 1, TKS_I16});
  Raster picture_ = make({Pattern::kRidges, 10, 7, 3, TKS_U8});

  tks_status encodeWith(const std::function<void(Call&)>& spoil) {
    Call call{surface_.heights(), picture_.image()};
    spoil(call);
    tks_buffer buffer = {};
    char message[256] = "";
    const tks_status status =
        tks_encode(&call.heights, &call.image, &call.options, &buffer, message, sizeof message);
    EXPECT_EQ(status == TKS_OK, message[0] == '\0') << message;
    EXPECT_EQ(status == TKS_OK, buffer.data != nullptr);
    tks_free_buffer(&buffer);
    return status;
  }
};

TEST_F(Arguments, UnspoiltCallWorks) {
  EXPECT_EQ(encodeWith([](Call&) {}), TKS_OK);
}

TEST_F(Arguments, Heights) {
  const std::function<void(Call&)> spoils[] = {
      [](Call& c) { c.heights.size = 3; },
      [](Call& c) { c.heights.width = 0; },
      [](Call& c) { c.heights.height = 0; },
      [](Call& c) { c.heights.sample = static_cast<tks_sample>(7); },
      [](Call& c) { c.heights.sample = static_cast<tks_sample>(-1); },
      [](Call& c) { c.heights.sample = static_cast<tks_sample>(1 << 30); },
      [](Call& c) { c.heights.registration = static_cast<tks_registration>(-1); },
      [](Call& c) { c.heights.data = nullptr; },
      [](Call& c) { c.heights.scale = 0; },
      [](Call& c) { c.heights.scale = kNan; },
      [](Call& c) { c.heights.offset = kInfinity; },
      [](Call& c) { c.heights.step = -1; },
      [](Call& c) { c.heights.step = kNan; },
      [](Call& c) { c.heights.spacing_x = -30; },
      [](Call& c) { c.heights.spacing_y = kNan; },
      [](Call& c) { c.heights.first_latitude = 181; },
      [](Call& c) { c.heights.last_latitude = kNan; },
  };
  for (size_t i = 0; i < std::size(spoils); ++i) {
    EXPECT_EQ(encodeWith(spoils[i]), TKS_USAGE) << "case " << i;
  }
}

TEST_F(Arguments, Image) {
  const std::function<void(Call&)> spoils[] = {
      [](Call& c) { c.image.size = 0; },         [](Call& c) { c.image.width = 0; },
      [](Call& c) { c.image.channels = 0; },     [](Call& c) { c.image.channels = 5; },
      [](Call& c) { c.image.sample = TKS_F32; }, [](Call& c) { c.image.data = nullptr; },
  };
  for (size_t i = 0; i < std::size(spoils); ++i) {
    EXPECT_EQ(encodeWith(spoils[i]), TKS_USAGE) << "case " << i;
  }
}

TEST_F(Arguments, Options) {
  const std::function<void(Call&)> spoils[] = {
      [](Call& c) { c.options.size = 1; },
      [](Call& c) { c.options.lossless = 0; },
      [](Call& c) { c.options.bytes = 5000; },
      [](Call& c) { c.options.psnr = 40; },
      [](Call& c) { c.options.max_error = 2; },
      [](Call& c) { c.options.lossless = 0, c.options.psnr = -40; },
      [](Call& c) { c.options.lossless = 0, c.options.psnr = kNan; },
      [](Call& c) { c.options.lossless = 0, c.options.max_error = -1; },
      [](Call& c) { c.options.lossless = 0, c.options.max_error = kInfinity; },
      [](Call& c) { c.options.lossless = 0, c.options.bytes = 5; },
      [](Call& c) { c.options.camera_count = 1; },
      [](Call& c) { c.options.weights = static_cast<tks_weights>(-1); },
      [](Call& c) { c.options.weights = static_cast<tks_weights>(2); },
      [](Call& c) { c.options.index = 3; },
      [](Call& c) { c.options.progress = [](void*, double) { return 1; }; },
  };
  for (size_t i = 0; i < std::size(spoils); ++i) {
    EXPECT_EQ(encodeWith(spoils[i]), TKS_USAGE) << "case " << i;
  }
}

TEST_F(Arguments, NothingToEncodeOrNowhereToPutIt) {
  const tks_heights heights = surface_.heights();
  const tks_encode_options options = lossless();
  tks_buffer buffer = {};
  EXPECT_EQ(tks_encode(nullptr, nullptr, &options, &buffer, nullptr, 0), TKS_USAGE);
  EXPECT_EQ(tks_encode(&heights, nullptr, nullptr, &buffer, nullptr, 0), TKS_USAGE);
  char message[100] = "";
  EXPECT_EQ(tks_encode(&heights, nullptr, &options, nullptr, message, sizeof message), TKS_USAGE);
  EXPECT_STREQ(message, "The output is missing.");
  EXPECT_EQ(buffer.data, nullptr);
}

TEST_F(Arguments, TargetsAreFinite) {
  const tks_heights heights = surface_.heights();
  for (double tks_encode_options::*target :
       {&tks_encode_options::psnr, &tks_encode_options::max_error}) {
    for (const double value : {kInfinity, -1.0}) {
      tks_encode_options options = lossless();
      options.lossless = 0;
      options.*target = value;
      tks_buffer buffer = {};
      char message[100] = "";
      EXPECT_EQ(tks_encode(&heights, nullptr, &options, &buffer, message, sizeof message),
                TKS_USAGE);
      EXPECT_STREQ(message, "The quality target must be a positive and finite number.");
    }
  }
}

/// The message is cut to the caller's room and always ends with a zero.
TEST_F(Arguments, MessageFitsItsBuffer) {
  const tks_encode_options options = lossless();
  for (size_t room = 1; room < 40; ++room) {
    tks_buffer buffer = {};
    std::vector<char> message(room + 1, '#');
    EXPECT_EQ(tks_encode(nullptr, nullptr, &options, &buffer, message.data(), room), TKS_USAGE);
    EXPECT_EQ(message[room], '#');
    EXPECT_LT(std::string(message.data()).size(), room);
  }
}

TEST_F(Arguments, Decoding) {
  const Bytes bytes = encode(&surface_, nullptr, lossless());
  Stream stream(bytes);
  std::vector<std::byte> out(stream.heightsBytes() + 1);
  EXPECT_EQ(tks_decode_heights(stream.get(), out.data(), stream.heightsBytes() - 1), TKS_USAGE);
  EXPECT_EQ(tks_decode_heights(stream.get(), out.data(), stream.heightsBytes() + 1), TKS_USAGE);
  EXPECT_EQ(tks_decode_heights(stream.get(), nullptr, stream.heightsBytes()), TKS_USAGE);
  EXPECT_STREQ(tks_message(stream.get()), "The output is missing.");
  EXPECT_EQ(tks_decode_texture(stream.get(), out.data(), 0), TKS_USAGE) << "there is none";
  EXPECT_STRNE(tks_message(stream.get()), "");
  EXPECT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_CODED, 0, nullptr), TKS_USAGE);
  EXPECT_STREQ(tks_message(stream.get()), "The output is missing.");
  EXPECT_EQ(tks_decode_mesh(nullptr, TKS_MESH_CODED, 0, nullptr), TKS_USAGE);
  tks_info info = {};
  EXPECT_EQ(tks_get_info(stream.get(), &info), TKS_USAGE) << "size is not set";
  tks_decoder* decoder = nullptr;
  EXPECT_EQ(tks_open(nullptr, 100, nullptr, &decoder, nullptr, 0), TKS_USAGE);
  EXPECT_EQ(tks_open(bytes.data(), bytes.size(), nullptr, nullptr, nullptr, 0), TKS_USAGE);
  char message[100] = "";
  EXPECT_EQ(tks_open(nullptr, 100, nullptr, &decoder, message, sizeof message), TKS_USAGE);
  EXPECT_STREQ(message, "The bytes of the stream are missing.");
  EXPECT_EQ(tks_open(bytes.data(), bytes.size(), nullptr, nullptr, message, sizeof message),
            TKS_USAGE);
  EXPECT_STREQ(message, "The output is missing.");
}

TEST_F(Arguments, TextureStreamHasNoSurface) {
  const Bytes bytes = encode(nullptr, &picture_, lossless());
  Stream stream(bytes);
  std::byte out[4];
  tks_mesh mesh = {};
  EXPECT_EQ(stream.info().width, 0u);
  EXPECT_EQ(tks_decode_heights(stream.get(), out, 0), TKS_USAGE);
  EXPECT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_CODED, 0, &mesh), TKS_USAGE);
}

TEST_F(Arguments, LimitsRefuseAtTheDoor) {
  const Bytes bytes = encode(&surface_, &picture_, lossless());
  const auto openWith = [&](uint64_t tks_limits::*field, uint64_t value) {
    tks_limits limits = {};
    limits.size = sizeof limits;
    limits.*field = value;
    return Stream(bytes, &limits).status();
  };
  EXPECT_EQ(openWith(&tks_limits::max_samples, 71), TKS_LIMIT);
  EXPECT_EQ(openWith(&tks_limits::max_samples, 72), TKS_OK);
  EXPECT_EQ(openWith(&tks_limits::max_texels, 69), TKS_LIMIT);
  EXPECT_EQ(openWith(&tks_limits::max_texels, 70), TKS_OK);
  EXPECT_EQ(openWith(&tks_limits::max_memory, 64), TKS_LIMIT);
  EXPECT_EQ(openWith(&tks_limits::max_memory, 1 << 16), TKS_OK) << "not for decoding, yet";
}

/// Whatever sizes a header declares, opening it uses no memory for them: the limits refuse first.
TEST_F(Arguments, OpeningAllocatesNothingThatHeadersDeclare) {
  const Raster surface = make({Pattern::kFlat, 300, 200, 1, TKS_I16});
  const Raster picture = make({Pattern::kFlat, 200, 300, 3, TKS_U8});
  const Bytes bytes = encode(&surface, &picture, lossless());
  const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_samples = limits.max_texels = 1 << 20;
  const size_t before = peakMemory();
  size_t refused = 0;
  for (size_t at = 6; at < header; ++at) {
    for (const int value : {0x00, 0x7f, 0x80, 0xff}) {
      for (uint8_t level = 0; level < 12; ++level) {
        Bytes damaged = bytes;
        damaged[at] = static_cast<uint8_t>(value);
        damaged[6] = level;
        sealHeader(damaged);
        refused += Stream(damaged, &limits).status() == TKS_LIMIT;
        refused += Stream(damaged).status() == TKS_LIMIT;
      }
    }
  }
  EXPECT_GT(refused, 0u) << "some of these declare more than the limits";
  EXPECT_LT(peakMemory() - before, size_t{32} << 20);
}

}  // namespace
}  // namespace tetrakis::test

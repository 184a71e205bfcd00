// SPDX-License-Identifier: Apache-2.0
// Bad meshes become objects or are refused with a sentence, and take no more time than others do.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include "tests/support/bad_meshes.hpp"
#include "tests/support/coded_object.hpp"

namespace tetrakis::test {
namespace {

/// Of 8 x 8 texels, of which none is like its neighbours.
struct SmallImage {
  std::vector<uint8_t> texels;
  tks_image image{};

  SmallImage() {
    constexpr uint32_t kSide = 8;
    for (uint32_t i = 0; i < 3 * kSide * kSide; ++i)
      texels.push_back(static_cast<uint8_t>(i * 167));
    image.size = sizeof image;
    image.width = image.height = kSide;
    image.channels = 3;
    image.sample = TKS_U8;
    image.data = texels.data();
  }
};

tks_encode_options toPsnr(double psnr) {
  tks_encode_options options{};
  options.size = sizeof options;
  options.psnr = psnr;
  return options;
}

tks_encode_options within(double error) {
  tks_encode_options options{};
  options.size = sizeof options;
  options.max_error = error;
  return options;
}

void expectMeshes(const Bytes& stream, const std::string& name) {
  const OpenedStream decoder = opened(stream, stream.size());
  ASSERT_NE(decoder, nullptr) << name;
  tks_info info{};
  info.size = sizeof info;
  ASSERT_EQ(tks_get_info(decoder.get(), &info), TKS_OK) << name;
  for (const uint32_t most :
       {std::max(info.object_triangles, 1u), 1 + info.object_triangles / 3, 0u}) {
    const DecodedMesh mesh = decodedMesh(decoder.get(), TKS_MESH_BUDGET, most);
    EXPECT_GT(mesh.triangles.size(), 0u) << name;
    for (const auto& point : mesh.points)
      for (const double value : point) ASSERT_TRUE(std::isfinite(value)) << name;
  }
}

/// One sentence: a capital letter, one full stop, at the end.
void expectSentence(const std::string& text, const std::string& name) {
  ASSERT_FALSE(text.empty()) << name;
  EXPECT_TRUE(std::isupper(static_cast<unsigned char>(text.front()))) << name << ": " << text;
  EXPECT_EQ(text.back(), '.') << name << ": " << text;
}

void expectCodedOrRefused(const made::BadMesh& bad, tks_object_kind kind,
                          const tks_encode_options& options) {
  constexpr double kMostSeconds = 60;
  const SmallImage small;
  const GivenMesh given(bad.mesh);
  tks_triangle_mesh mesh = given.given();
  mesh.kind = kind;
  const bool textured = !bad.texcoords.empty() && options.bytes > 0;
  if (textured) mesh.texcoords = bad.texcoords.data();
  tks_buffer buffer{};
  std::array<char, 300> message{};
  const std::clock_t start = std::clock();
  const tks_status status = tks_encode_object(&mesh, textured ? &small.image : nullptr, &options,
                                              nullptr, &buffer, message.data(), message.size());
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, kMostSeconds) << bad.name;
  if (status == TKS_OK)
    expectMeshes(Bytes(buffer.data, buffer.data + buffer.size), bad.name);
  else
    expectSentence(message.data(), bad.name);
  tks_free_buffer(&buffer);
}

class BadMeshes : public testing::TestWithParam<uint32_t> {};

TEST_P(BadMeshes, AreCodedOrRefusedWithASentence) {
  for (const made::BadMesh& bad : made::badMeshes(GetParam())) {
    expectCodedOrRefused(bad, TKS_OBJECT_AUTO, budget(3000));
    expectCodedOrRefused(bad, TKS_OBJECT_RESAMPLED, toPsnr(40));
    expectCodedOrRefused(bad, TKS_OBJECT_TRIANGLES, within(0.01));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, BadMeshes, testing::Values(1u));

}  // namespace
}  // namespace tetrakis::test

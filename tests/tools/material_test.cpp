// SPDX-License-Identifier: Apache-2.0
// What streams say of a material: there and back, and any other bytes.
#include "apps/tools/files/meshes/material.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace tetrakis::tools {
namespace {

void expectUsual(const std::string& text) {
  const Material material = materialOf(text);
  const MaterialFactors& factors = material.factors;
  EXPECT_EQ(factors.metallic, 1) << text;
  EXPECT_EQ(factors.roughness, 1) << text;
  EXPECT_EQ(factors.emissive, (std::array<double, 3>{0, 0, 0})) << text;
  EXPECT_EQ(factors.normal_scale, 1) << text;
  EXPECT_EQ(factors.occlusion_strength, 1) << text;
  EXPECT_FALSE(factors.is_double_sided) << text;
}

TEST(Materials, ComeBack) {
  const Material given{{0.2F, 0.7F, {1, 0.5, 0}, -2, 0.25, true}, true};
  const Material read = materialOf(materialText(given));
  EXPECT_FLOAT_EQ(static_cast<float>(read.factors.metallic), 0.2F);
  EXPECT_FLOAT_EQ(static_cast<float>(read.factors.roughness), 0.7F);
  EXPECT_EQ(read.factors.emissive, given.factors.emissive);
  EXPECT_EQ(read.factors.normal_scale, -2);
  EXPECT_EQ(read.factors.occlusion_strength, 0.25);
  EXPECT_TRUE(read.factors.is_double_sided);
  EXPECT_TRUE(read.occlusion_is_red);
}

TEST(Materials, SayNothingOfWhatIsUsual) {
  EXPECT_EQ(materialText({}), "");
  Material metal;
  metal.factors.metallic = 0.2F;
  EXPECT_EQ(materialText(metal), R"({"pbrMetallicRoughness":{"metallicFactor":0.2}})");
}

TEST(Materials, OtherTextsAreUsual) {
  for (const char* text : {"", "null", "[]", "{", "3", R"({"pbrMetallicRoughness":3})",
                           R"({"pbrMetallicRoughness":[1]})",
                           R"({"pbrMetallicRoughness":{"metallicFactor":7,"roughnessFactor":"0"}})",
                           R"({"emissiveFactor":{"0":1}})", R"({"emissiveFactor":[-1,2,null]})",
                           R"({"doubleSided":1})", R"({"normalTexture":{"scale":1e300}})",
                           R"({"occlusionTexture":{"strength":-1}})"})
    expectUsual(text);
  expectUsual(std::string(60000, '['));
  expectUsual("{\"a\":\"" + std::string(1 << 17, 'x') + "\"}");
}

TEST(Materials, AnyBytesAreRead) {
  std::mt19937 random(7);
  const std::string text = materialText({{0.5, 0.5, {1, 1, 1}, 2, 0.5, true}, false});
  for (int trial = 0; trial < 500; ++trial) {
    std::string changed = text;
    changed[random() % changed.size()] = static_cast<char>(random());
    const Material material = materialOf(changed);
    EXPECT_GE(material.factors.metallic, 0);
    EXPECT_LE(material.factors.metallic, 1);
  }
}

}  // namespace
}  // namespace tetrakis::tools

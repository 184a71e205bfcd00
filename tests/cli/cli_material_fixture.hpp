// SPDX-License-Identifier: Apache-2.0
// Models with maps of a material, made by code, and what GLBs hold of theirs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/files/pictures/png.hpp"
#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {

using nlohmann::json;
using tools::ImageFile;
using tools::MapKind;

/// A GLB, taken apart.
struct GlbParts {
  json document;
  std::string binary;
};

class MaterialTest : public CliTest {
 protected:
  /// A texel of a picture is value(x, y, channel), with x and y from 0 to 1.
  template <class Value>
  static ImageFile painted(uint32_t width, uint32_t height, uint32_t channels, Value value) {
    ImageFile image{width, height, channels, TKS_U8, {}};
    for (uint32_t row = 0; row < height; ++row)
      for (uint32_t column = 0; column < width; ++column)
        for (uint32_t channel = 0; channel < channels; ++channel)
          image.data.push_back(static_cast<std::byte>(std::lround(std::clamp<double>(
              value((column + 0.5) / width, (row + 0.5) / height, channel), 0, 255))));
    return image;
  }
  static ImageFile colours() {
    return painted(64, 64, 3, [](double x, double y, uint32_t channel) {
      return 120 + 80 * std::sin(9 * x + channel) + 40 * std::cos(31 * y);
    });
  }
  static ImageFile normals(uint32_t width = 64, uint32_t height = 32) {
    return painted(width, height, 3, [](double x, double y, uint32_t channel) {
      const double u = 0.4 * std::sin(20 * x), v = 0.4 * std::cos(17 * y);
      const double length = std::hypot(u, v, 1);
      return 127.5 * (1 + (channel == 0 ? u : channel == 1 ? v : 1) / length);
    });
  }
  /// Red is white, or holds occlusion that goes down by so much.
  static ImageFile surfaces(double occlusion = 0) {
    return painted(32, 32, 3, [occlusion](double x, double y, uint32_t channel) {
      return channel == 0 ? 255 - occlusion * x * y : channel == 1 ? 60 + 150 * y : 255 * (x > 0.5);
    });
  }
  static ImageFile shades() {
    return painted(48, 16, 1, [](double x, double y, uint32_t) { return 255 - 120 * x * y; });
  }
  static ImageFile lights() {
    return painted(16, 16, 3, [](double x, double y, uint32_t channel) {
      return std::hypot(x - 0.5, y - 0.5) < 0.3 ? 240.0 - 90 * channel : 0;
    });
  }

  /// A sheet with a hill, whose texture covers it once.
  static tools::MeshFile sheet() {
    constexpr uint32_t kSide = 9;
    tools::MeshFile mesh;
    for (uint32_t row = 0; row < kSide; ++row) {
      for (uint32_t column = 0; column < kSide; ++column) {
        const float x = float(column) / (kSide - 1), z = float(row) / (kSide - 1);
        mesh.positions.insert(mesh.positions.end(), {x, x * (1 - x) * z * (1 - z), z});
        mesh.texcoords.insert(mesh.texcoords.end(), {x, z});
        if (row == 0 || column == 0) continue;
        const uint32_t d = row * kSide + column, c = d - 1, b = d - kSide, a = b - 1;
        mesh.triangles.insert(mesh.triangles.end(), {a, c, b, b, c, d});
      }
    }
    return mesh;
  }

  /// Of every map, with factors that are none of the usual ones.
  void makeModel(const std::string& name) {
    const std::array<ImageFile, 5> images = {colours(), normals(), surfaces(), shades(), lights()};
    tools::MeshFile mesh = sheet();
    mesh.texture = &images[0];
    for (size_t kind = 0; kind < tools::kMapKinds; ++kind)
      mesh.maps.images[kind] = &images[kind + 1];
    mesh.maps.material.factors = {0.25, 0.75, {1, 0.5, 0.125}, 0.5, 0.875, true};
    writeModel(name, mesh);
  }
  void writeModel(const std::string& name, const tools::MeshFile& mesh) {
    const tools::MeshOptions exact{tools::MeshCompression::kNone, tools::MeshTexture::kPng};
    const bool is_glb = name.ends_with(".glb");
    const Status written = writeMesh(path(name), mesh, "", is_glb ? exact : tools::MeshOptions());
    ASSERT_TRUE(written.ok()) << written.message();
  }

  GlbParts glb(const std::string& name) const {
    const std::string bytes = content(name);
    uint32_t length = 0;
    if (bytes.size() < 28) return {};
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return {json::parse(bytes.substr(20, length), nullptr, false), bytes.substr(28 + length)};
  }
  /// Writes it again, with another document.
  void writeGlb(const std::string& name, const GlbParts& parts) const {
    std::string text = parts.document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto number = [](size_t value) {
      const auto word = static_cast<uint32_t>(value);
      return std::string(reinterpret_cast<const char*>(&word), sizeof word);
    };
    write(name, "glTF" + number(2) + number(28 + text.size() + parts.binary.size()) +
                    number(text.size()) + "JSON" + text + number(parts.binary.size()) +
                    std::string("BIN\0", 4) + parts.binary);
  }
  /// The numbers of an attribute of the mesh.
  static std::vector<float> floatsOf(const GlbParts& parts, const char* attribute) {
    const json& document = parts.document;
    const size_t number = document["meshes"][0]["primitives"][0]["attributes"][attribute];
    const json &accessor = document["accessors"][number],
               &view = document["bufferViews"][accessor["bufferView"].get<size_t>()];
    const size_t numbers = accessor["type"] == "VEC3" ? 3 : 2;
    std::vector<float> floats(numbers * accessor["count"].get<size_t>());
    const size_t offset = view.value("byteOffset", 0) + accessor.value("byteOffset", 0);
    std::memcpy(floats.data(), parts.binary.data() + offset, floats.size() * sizeof(float));
    return floats;
  }
  static json materialOf(const GlbParts& parts) { return parts.document["materials"][0]; }

  /// The picture that a slot of a material names: {"index": texture}.
  ImageFile pictureOf(const GlbParts& parts, const json& slot) const {
    const json& document = parts.document;
    const size_t image = document["textures"][slot["index"].get<size_t>()]["source"];
    const json& view =
        document["bufferViews"][document["images"][image]["bufferView"].get<size_t>()];
    write("picture", parts.binary.substr(view["byteOffset"], view["byteLength"]));
    const auto picture = tools::readImage(path("picture"));
    EXPECT_TRUE(picture.ok()) << picture.status().message();
    return picture.ok() ? *picture : ImageFile();
  }

  /// Of channels from `first` on; grey stands for each of three.
  static double rmse(const ImageFile& a, const ImageFile& b, uint32_t first = 0) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    double squares = 0, count = 0;
    const auto at = [](const ImageFile& image, size_t texel, uint32_t channel) {
      const uint32_t own = image.channels < 3 ? 0 : channel;
      return std::to_integer<int>(image.data[texel * image.channels + own]);
    };
    for (size_t texel = 0; texel < size_t{a.width} * a.height && a.width == b.width; ++texel)
      for (uint32_t channel = first; channel < 3; ++channel, ++count)
        squares += std::pow(at(a, texel, channel) - at(b, texel, channel), 2);
    return count > 0 ? std::sqrt(squares / count) : HUGE_VAL;
  }

  json info(const std::string& arguments) {
    return json::parse(cli("info --json " + arguments).out, nullptr, false);
  }
  /// Names of the components of a stream to their bytes.
  std::map<std::string, uint64_t> componentsOf(const std::string& stream) {
    std::map<std::string, uint64_t> bytes;
    const json told = info(stream);
    if (!told.contains("components")) return bytes;
    for (const json& one : told["components"])
      bytes[one["name"].is_null() ? "" : one["name"].get<std::string>()] = one["bytes"];
    return bytes;
  }
};

}  // namespace tetrakis::test

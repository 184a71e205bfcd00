// SPDX-License-Identifier: Apache-2.0
// A texture that graphics processors take compressed: KTX2 with ETC1S (KHR_texture_basisu). Its
// encoder is in no Debian package, so that a program has to be there: ktx of Khronos's KTX-Software
// (4.3 or later), or basisu of Basis Universal.
#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/meshes/mesh_writers.hpp"
#include "apps/tools/files/pictures/png.hpp"
#include "apps/tools/files/run_program.hpp"
#include "apps/tools/files/temporary.hpp"

namespace tetrakis::tools {
namespace {

constexpr const char* kQuality = "255";  ///< the best that ETC1S has
constexpr uint32_t kBlock = 4;

/// Where the middle of a resampled texel lies among the texels of one side.
struct Between {
  uint32_t low, high;
  float weight;  ///< of the high one
};

Between between(uint32_t i, uint32_t from, uint32_t to) {
  const float at =
      (static_cast<float>(i) + 0.5F) * static_cast<float>(from) / static_cast<float>(to) - 0.5F;
  const float inside = std::clamp(at, 0.0F, static_cast<float>(from - 1));
  const auto low = static_cast<uint32_t>(inside);
  return {low, std::min(low + 1, from - 1), inside - static_cast<float>(low)};
}

/// Bilinearly, to sides that are multiples of 4: KHR_texture_basisu allows no others. Coordinates
/// of textures count sides, so that they stay.
ImageFile inBlocks(const ImageFile& image) {
  const auto rounded = [](uint32_t side) { return (side + kBlock - 1) / kBlock * kBlock; };
  ImageFile out{rounded(image.width), rounded(image.height), image.channels, TKS_U8, {}};
  out.data.reserve(size_t{out.width} * out.height * out.channels);
  const auto texel = [&](uint32_t x, uint32_t y, uint32_t channel) {
    return static_cast<float>(image.data[(size_t{y} * image.width + x) * image.channels + channel]);
  };
  for (uint32_t y = 0; y < out.height; ++y) {
    const Between row = between(y, image.height, out.height);
    for (uint32_t x = 0; x < out.width; ++x) {
      const Between column = between(x, image.width, out.width);
      for (uint32_t c = 0; c < out.channels; ++c) {
        const auto mixed = [&](uint32_t line) {
          const float low = texel(column.low, line, c), high = texel(column.high, line, c);
          return low + column.weight * (high - low);
        };
        const float low = mixed(row.low), high = mixed(row.high);
        out.data.push_back(static_cast<std::byte>(low + row.weight * (high - low) + 0.5F));
      }
    }
  }
  return out;
}

/// By the first of the programs that is there.
Status runEncoder(const ImageFile& image, const std::filesystem::path& folder) {
  const std::string png = folder / "texture.png", ktx2 = folder / "texture.ktx2";
  const char* const format = image.channels == 4 ? "R8G8B8A8_SRGB" : "R8G8B8_SRGB";
  const std::array<std::vector<std::string>, 2> commands = {{
      {"ktx", "create", "--format", format, "--encode", "basis-lz", "--qlevel", kQuality,
       "--generate-mipmap", png, ktx2},
      {"basisu", "-ktx2", "-q", kQuality, "-mipmap", "-output_file", ktx2, png},
  }};
  for (const std::vector<std::string>& command : commands) {
    Status status = runProgram(command, folder / "log");
    if (status.code() != TKS_UNSUPPORTED) return status;
  }
  return {TKS_UNSUPPORTED,
          "a KTX2 needs a program that makes it: install ktx (KTX-Software) or basisu, or write "
          "--mesh-texture webp"};
}

bool isKtx2(const std::vector<std::byte>& bytes) {
  constexpr std::array<unsigned char, 12> kMagic = {0xAB, 'K',  'T',  'X',  ' ',  '2',
                                                    '0',  0xBB, 0x0D, 0x0A, 0x1A, 0x0A};
  return bytes.size() > kMagic.size() &&
         std::equal(kMagic.begin(), kMagic.end(), bytes.begin(),
                    [](unsigned char a, std::byte b) { return std::byte{a} == b; });
}

}  // namespace

Result<std::vector<std::byte>> encodeKtx2(const ImageFile& image) {
  std::error_code no_folder;
  const Result<Temporary> folder =
      Temporary::makeFolder(std::filesystem::temp_directory_path(no_folder));
  if (!folder.ok()) return folder.status();
  const bool fits = image.width % kBlock == 0 && image.height % kBlock == 0;
  const Result<std::vector<std::byte>> png = encodePng(fits ? image : inBlocks(image));
  if (!png.ok()) return png.status();
  const std::filesystem::path& path = folder->path();
  if (Status status = writeBytes(path / "texture.png", *png); !status.ok()) return status;
  if (Status status = runEncoder(image, path); !status.ok()) return status;
  Result<std::vector<std::byte>> ktx2 = readBytes(path / "texture.ktx2");
  if (ktx2.ok() && !isKtx2(*ktx2)) return Status(TKS_IO, "the program made no KTX2 of the texture");
  return ktx2;
}

}  // namespace tetrakis::tools

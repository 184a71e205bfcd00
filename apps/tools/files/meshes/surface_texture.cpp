// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/meshes/surface_texture.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <filesystem>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/meshes/mesh_writers.hpp"
#include "apps/tools/files/temporary.hpp"

namespace tetrakis::tools {
namespace {

namespace fs = std::filesystem;

/// "%20" and the like in addresses of glTF.
std::string withoutEscapes(const std::string& text) {
  constexpr size_t kDigits = 2;
  constexpr int kHexadecimal = 16;
  std::string plain;
  for (size_t i = 0; i < text.size(); ++i) {
    unsigned char code = 0;
    const char* const digits = text.data() + i + 1;
    if (text[i] == '%' && i + kDigits < text.size() &&
        std::from_chars(digits, digits + kDigits, code, kHexadecimal).ptr == digits + kDigits) {
      plain += static_cast<char>(code);
      i += kDigits;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

/// An existing file; "": there is none.
std::string fileNamed(std::string name, const fs::path& folder) {
  std::replace(name.begin(), name.end(), '\\', '/');
  for (const std::string& form : {name, withoutEscapes(name)}) {
    for (const fs::path& path : {folder / form, folder / fs::path(form).filename()}) {
      std::error_code ignored;
      if (fs::is_regular_file(path, ignored)) return path.string();
    }
  }
  return {};
}

/// A picture called like the mesh; "": there is none.
std::string fileBeside(const fs::path& mesh) {
  for (const char* const extension : {".png", ".jpg", ".jpeg"}) {
    std::error_code ignored;
    const fs::path path = fs::path(mesh).replace_extension(extension);
    if (fs::is_regular_file(path, ignored)) return path.string();
  }
  return {};
}

ImageFile inShownColours(ImageFile image) {
  if (image.hasFurtherColour()) image = withoutFurtherColour(image);
  if (image.sample != TKS_U8) image = reducedTo8Bits(image);
  return image.channels < 3 ? greyInColour(image) : image;
}

/// What the largest value of a texture of fewer than 16 bits is, if it is known.
bool isOfBits(uint32_t white_level) {
  constexpr int kFewest = 9, kMost = 16;
  const int bits = std::bit_width(white_level);
  return bits >= kFewest && bits < kMost && white_level + 1 == uint32_t{1} << bits;
}

/// What is read of a file; `shown`: how the remark calls it.
using Reader = FoundTexture(Result<ImageFile> image, const std::string& shown);

FoundTexture asColours(Result<ImageFile> image, const std::string& shown) {
  if (!image.ok()) return {{}, shown + " is not read: " + image.status().message()};
  image->place = {};
  return {inShownColours(std::move(*image)), {}};
}

FoundTexture asValues(Result<ImageFile> image, const std::string& shown) {
  if (image.ok() && !isOfBits(image->white_level)) image->white_level = 0;
  return asColours(std::move(image), shown);
}

FoundTexture readEmbedded(const std::vector<std::byte>& bytes, const std::string& shown,
                          Reader reader) {
  const Result<Temporary> file = Temporary::makeFile();
  if (!file.ok()) return {{}, file.status().message()};
  const std::string path = file->path().string();
  if (const Status status = writeBytes(path, bytes); !status.ok()) return {{}, status.message()};
  return reader(readImage(path), shown);
}

FoundTexture readNamed(const ImportedTexture& texture, const std::string& mesh_path,
                       const std::string& shown, Reader reader) {
  const std::string path = fileNamed(texture.path, fs::path(mesh_path).parent_path());
  if (path.empty()) return {{}, shown + " " + quoted(texture.path) + " is not there"};
  return reader(readImage(path), shown);
}

}  // namespace

FoundTexture readMap(const ImportedTexture& map, const std::string& mesh_path,
                     const std::string& shown) {
  return map.file.empty() ? readNamed(map, mesh_path, shown, asValues)
                          : readEmbedded(map.file, shown, asValues);
}

FoundTexture readTexture(const ImportedTexture& texture, const std::string& mesh_path) {
  return texture.file.empty() ? readNamed(texture, mesh_path, "its texture", asColours)
                              : readEmbedded(texture.file, "the embedded texture", asColours);
}

FoundTexture findTexture(const MeshImport& mesh, const std::string& mesh_path) {
  if (!mesh.texture.path.empty() || !mesh.texture.file.empty())
    return readTexture(mesh.texture, mesh_path);
  const std::string path = fileBeside(mesh_path);
  if (path.empty()) return {};
  FoundTexture found = asColours(readImage(path), "the picture beside it");
  if (found.image) found.remark = quoted(path) + " is taken as its texture";
  return found;
}

}  // namespace tetrakis::tools

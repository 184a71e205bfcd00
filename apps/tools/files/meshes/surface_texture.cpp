// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/meshes/surface_texture.hpp"

#include <algorithm>
#include <array>
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

/// shown: how the remark calls the file.
FoundTexture readTexture(const std::string& path, const std::string& shown) {
  Result<ImageFile> image = readImage(path);
  if (!image.ok()) return {{}, shown + " is not read: " + image.status().message()};
  image->place = {};
  return {inShownColours(std::move(*image)), {}};
}

FoundTexture readEmbedded(const std::vector<std::byte>& bytes) {
  const Result<Temporary> file = Temporary::makeFile();
  if (!file.ok()) return {{}, file.status().message()};
  const std::string path = file->path().string();
  if (const Status status = writeBytes(path, bytes); !status.ok()) return {{}, status.message()};
  return readTexture(path, "the embedded texture");
}

}  // namespace

FoundTexture findTexture(const MeshImport& mesh, const std::string& mesh_path) {
  if (!mesh.texture_file.empty()) return readEmbedded(mesh.texture_file);
  const fs::path folder = fs::path(mesh_path).parent_path();
  if (!mesh.texture_path.empty()) {
    const std::string path = fileNamed(mesh.texture_path, folder);
    return path.empty()
               ? FoundTexture{{}, "its texture " + quoted(mesh.texture_path) + " is not there"}
               : readTexture(path, "its texture");
  }
  const std::string path = fileBeside(mesh_path);
  if (path.empty()) return {};
  FoundTexture found = readTexture(path, "the picture beside it");
  if (found.image) found.remark = quoted(path) + " is taken as its texture";
  return found;
}

}  // namespace tetrakis::tools

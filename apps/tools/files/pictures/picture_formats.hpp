// SPDX-License-Identifier: Apache-2.0
// PictureFormats is the part of OpenImageIO that the tools use. OpenImageIO brings some 260
// libraries, which take longer to load than most streams to decode; so it is a module of its own
// (openimageio.cpp), loaded for pictures that are neither a PNG nor a plain TIFF.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// kOther: none that heights or textures have.
enum class PictureSample { kU8, kI8, kU16, kI16, kU32, kI32, kHalf, kFloat, kDouble, kOther };

/// In bytes; 8 for kOther.
size_t sizeOf(PictureSample sample);

struct PictureShape {
  int width = 0, height = 0, channels = 0;
  PictureSample sample = PictureSample::kOther;
  int depth = 1;  ///< of volumes
  size_t samples() const { return size_t{1} * width * height * depth * channels; }
};

/// An open picture file. Attributes have OpenImageIO's names.
class PictureReader {
 public:
  virtual ~PictureReader() = default;
  virtual PictureShape shape() const = 0;
  /// OpenImageIO's name of the format.
  virtual std::string format() const = 0;
  virtual bool has(const char* attribute) const = 0;
  /// 0 and "" where the file lacks the attribute.
  virtual int number(const char* attribute) const = 0;
  virtual std::string text(const char* attribute) const = 0;
  /// Fills `samples`, interleaved, converted to `type`. Fails with OpenImageIO's reason.
  virtual Status read(PictureSample type, std::span<std::byte> samples) = 0;
};

struct PictureToWrite {
  PictureShape shape;
  std::span<const std::byte> samples;
  std::string compression{};  ///< in OpenImageIO's words; "": the format's own choice
};

/// All formats. Errors are OpenImageIO's reasons; memory that runs out is thrown.
class PictureFormats {
 public:
  virtual ~PictureFormats() = default;
  /// By the reader of this format, whatever the file is called.
  virtual Result<std::unique_ptr<PictureReader>> open(const std::string& path,
                                                      const std::string& format) const = 0;
  /// Whether there is a page or frame behind the first.
  virtual bool hasSecond(const std::string& path) const = 0;
  /// The name of the format that files with this extension get; "": none is written.
  virtual std::string named(const std::string& extension) const = 0;
  virtual Result<std::vector<std::byte>> encode(const std::string& format,
                                                const PictureToWrite& picture) const = 0;
  virtual Status write(const std::string& path, const std::string& format,
                       const PictureToWrite& picture) const = 0;
  /// The orientation tag of EXIF data as it stands there; 1 where there is none.
  virtual int orientation(std::span<const std::byte> exif) const = 0;
  virtual std::string base64(std::span<const std::byte> bytes) const = 0;
};

/// Loads the module at the first call. TKS_IO if it cannot be loaded.
Result<const PictureFormats*> pictureFormats();

}  // namespace tetrakis::tools

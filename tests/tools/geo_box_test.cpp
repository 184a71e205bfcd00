// SPDX-License-Identifier: Apache-2.0
// The place of JPEG 2000 files, in a box of their own, and boxes that are damaged.
#include <string_view>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/files.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/tiny_tiff.hpp"

namespace tetrakis::tools {
namespace {

using test::ScratchFolder;
using test::TinyTiff;

constexpr std::string_view kGeoJp2(
    "\xb1\x4b\xf8\xbd\x08\x3d\x4b\x43\xa5\xae\x8c\xd7\xd5\xa6\xce\x03", 16);

std::vector<std::byte> boxOf(std::string_view type, std::string_view head,
                             const std::vector<std::byte>& content) {
  const size_t length = 4 + type.size() + head.size() + content.size();
  std::vector<std::byte> box;
  for (const int shift : {24, 16, 8, 0}) box.push_back(static_cast<std::byte>(length >> shift));
  for (const std::string_view text : {type, head})
    for (const char c : text) box.push_back(static_cast<std::byte>(c));
  box.insert(box.end(), content.begin(), content.end());
  return box;
}

/// One pixel in UTM zone 33 north, 2 m wide.
std::vector<std::byte> tags() {
  TinyTiff tiff(1, 1, 1, 8, {0});
  tiff.doubles(33550, {2, 2, 0});
  tiff.doubles(33922, {0, 0, 0, 500100, 4999900, 0});
  tiff.shorts(34735, {1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32633});
  const auto bytes = tiff.bytes();
  return {reinterpret_cast<const std::byte*>(bytes.data()),
          reinterpret_cast<const std::byte*>(bytes.data() + bytes.size())};
}

class GeoBoxes : public ScratchFolder {
 protected:
  void SetUp() override {
    ScratchFolder::SetUp();
    ImageFile image{40, 40, 1, TKS_U16, std::vector<std::byte>(3200)};
    ASSERT_TRUE(writeImage(path("plain.jp2"), image).ok());
    plain_ = *readBytes(path("plain.jp2"));
  }

  /// Behind the box of the codestream.
  std::string with(const std::vector<std::byte>& box) {
    std::vector<std::byte> bytes = plain_;
    bytes.insert(bytes.end(), box.begin(), box.end());
    EXPECT_TRUE(writeBytes(path("boxed.jp2"), bytes).ok());
    return path("boxed.jp2");
  }

  std::vector<std::byte> plain_;
};

TEST_F(GeoBoxes, TellThePlaceOfTexturesAndHeights) {
  const std::string file = with(boxOf("uuid", kGeoJp2, tags()));
  const GeoTransform transform{500100, 2, 0, 4999900, 0, -2};
  std::string note;
  const auto image = readImage(file, &note);
  ASSERT_TRUE(image.ok()) << image.status().message();
  EXPECT_EQ(image->place.geotransform, transform);
  EXPECT_EQ(image->place.crs, "EPSG:32633");
  EXPECT_EQ(note.find("place"), std::string::npos) << note;
  const auto heights = readHeights(file);
  ASSERT_TRUE(heights.ok()) << heights.status().message();
  EXPECT_EQ(heights->geotransform, transform);
  EXPECT_EQ(heights->crs, "EPSG:32633");
  EXPECT_EQ(heights->spacing_x, 2);
}

/// A box of another kind before it, and one with a length of 64 bits.
TEST_F(GeoBoxes, AreFoundAmongOthers) {
  std::vector<std::byte> boxes = boxOf("uuid", "0123456789abcdef", tags());
  const std::vector<std::byte> box = boxOf("uuid", kGeoJp2, tags());
  const size_t length = box.size() + 8;
  for (const int byte : {0, 0, 0, 1}) boxes.push_back(static_cast<std::byte>(byte));
  boxes.insert(boxes.end(), box.begin() + 4, box.begin() + 8);
  for (int shift = 56; shift >= 0; shift -= 8)
    boxes.push_back(static_cast<std::byte>(length >> shift));
  boxes.insert(boxes.end(), box.begin() + 8, box.end());
  const auto image = readImage(with(boxes));
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(image->place.crs, "EPSG:32633");
}

/// What is cut off or damaged places nothing wrongly without a word, and hurts no picture.
TEST_F(GeoBoxes, ThatAreDamagedHurtNoPicture) {
  const std::vector<std::byte> box = boxOf("uuid", kGeoJp2, tags());
  for (size_t length = 0; length < box.size(); length += 3) {
    const auto image = readImage(with({box.begin(), box.begin() + static_cast<ptrdiff_t>(length)}));
    ASSERT_TRUE(image.ok()) << length << ": " << image.status().message();
    EXPECT_FALSE(image->place.geotransform);
  }
  for (size_t at = 0; at < box.size(); ++at) {
    std::vector<std::byte> damaged = box;
    damaged[at] ^= std::byte{0xff};
    const auto image = readImage(with(damaged));
    ASSERT_TRUE(image.ok()) << at << ": " << image.status().message();
  }
}

TEST_F(GeoBoxes, InGmlAreToldOf) {
  std::string note;
  const auto image = readImage(with(boxOf("asoc", "....gml.data", {})), &note);
  ASSERT_TRUE(image.ok());
  EXPECT_NE(note.find("place in GML"), std::string::npos) << note;
}

}  // namespace
}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/meshes/texture_pages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "apps/tools/files/meshes/surface_file.hpp"
#include "apps/tools/files/meshes/surface_texture.hpp"

namespace tetrakis::tools {
namespace {

constexpr size_t kChannels = 3;
/// A texture that repeats more often on one triangle is cut off there.
constexpr double kMostRepeats = 8;
/// Texels around a page that repeat its border, so that pages do not mix where they are filtered.
constexpr uint32_t kGutter = 4;
/// Of all pages, 400 MB.
constexpr uint64_t kMostTexels = uint64_t{1} << 27;

using Coordinates = std::array<double, 2>;  ///< in repetitions of a texture, v from the top

/// The image of a look, and where it lies.
struct Page {
  ImageFile image;
  std::array<uint32_t, 2> repeats{1, 1};
  uint32_t gutter = kGutter;
  std::array<uint32_t, 2> place{0, 0};  ///< of its first texel behind the gutter

  uint32_t width() const { return image.width * repeats[0]; }
  uint32_t height() const { return image.height * repeats[1]; }
  uint64_t texels() const {
    return uint64_t{width() + 2 * gutter} * (uint64_t{height()} + 2 * gutter);
  }
};

/// Triangles of one look, by their numbers.
using Members = std::vector<std::vector<size_t>>;

Members membersOf(const MeshImport& mesh) {
  Members members(mesh.looks.size());
  size_t triangle = 0;
  for (const LookRun& run : mesh.runs)
    for (; triangle < run.end; ++triangle) members[run.look].push_back(triangle);
  return members;
}

/// Of the corners of a triangle, in the repetition of the texture in which it begins.
std::array<Coordinates, 3> placed(const MeshImport& mesh, size_t triangle) {
  std::array<Coordinates, 3> corners{};
  if (mesh.texcoords.empty()) return corners;
  for (size_t k = 0; k < 3; ++k) {
    const auto& [u, v] = mesh.texcoords[3 * triangle + k];
    corners[k] = {u, 1 - double{v}};
  }
  for (size_t axis = 0; axis < 2; ++axis) {
    const auto [least, most] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    const double first = least >= 0 && most <= 1 ? 0 : std::floor(least);
    for (Coordinates& corner : corners)
      corner[axis] = std::clamp(corner[axis] - first, 0.0, kMostRepeats);
  }
  return corners;
}

std::array<uint32_t, 2> repeatsOf(const MeshImport& mesh, const std::vector<size_t>& members) {
  Coordinates most{1, 1};
  for (const size_t triangle : members) {
    for (const Coordinates& corner : placed(mesh, triangle))
      for (size_t axis = 0; axis < 2; ++axis) most[axis] = std::max(most[axis], corner[axis]);
  }
  return {static_cast<uint32_t>(std::ceil(most[0])), static_cast<uint32_t>(std::ceil(most[1]))};
}

/// The look as a mesh of its own has it, which says what is shown of it.
SurfaceFile alone(const MeshImport& mesh, size_t look) {
  SurfaceFile surface;
  surface.base_colour = mesh.looks[look].colour;
  surface.y_is_up = mesh.facts.y_is_up;
  return surface;
}

// Colours at corners take a cell of 2 x 2 texels for each triangle, whose corners are the centres
// of three of them. The fourth goes on from these as far as values reach, so that what lies between
// four texels is what lies between three corners, unless the colours of a triangle differ much.

uint32_t cellsInARow(size_t triangles) {
  return static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(triangles))));
}

/// The values that show a colour at a corner, as glTF has it in light and others in values.
std::array<double, 3> shownAt(const MeshImport& mesh, size_t corner, const LookFacts& look) {
  std::array<double, 3> values{};
  for (size_t channel = 0; channel < 3; ++channel) {
    const double value = mesh.corner_colours[corner][channel] * look.colour[channel];
    values[channel] = mesh.facts.y_is_up ? valueOf(std::max(0.0, value)) : value;
  }
  return values;
}

void fillTexel(ImageFile& image, uint32_t x, uint32_t y, const std::array<double, 3>& values) {
  constexpr double kWhite = 255;
  std::byte* const texel = image.data.data() + kChannels * (size_t{y} * image.width + x);
  for (size_t channel = 0; channel < kChannels; ++channel)
    texel[channel] =
        static_cast<std::byte>(std::lround(kWhite * std::clamp(values[channel], 0.0, 1.0)));
}

ImageFile cellsOf(const MeshImport& mesh, const std::vector<size_t>& members,
                  const LookFacts& look) {
  const uint32_t across = cellsInARow(members.size()),
                 down = static_cast<uint32_t>((members.size() + across - 1) / across);
  ImageFile image{2 * across, 2 * down, kChannels, TKS_U8, {}};
  image.data.resize(kChannels * image.width * image.height);
  for (size_t i = 0; i < members.size(); ++i) {
    const auto x = static_cast<uint32_t>(2 * (i % across)),
               y = static_cast<uint32_t>(2 * (i / across));
    const auto a = shownAt(mesh, 3 * members[i], look), b = shownAt(mesh, 3 * members[i] + 1, look),
               c = shownAt(mesh, 3 * members[i] + 2, look);
    fillTexel(image, x, y, a);
    fillTexel(image, x + 1, y, b);
    fillTexel(image, x, y + 1, c);
    fillTexel(image, x + 1, y + 1, {b[0] + c[0] - a[0], b[1] + c[1] - a[1], b[2] + c[2] - a[2]});
  }
  return image;
}

Page pageOf(const MeshImport& mesh, const std::string& mesh_path, size_t look,
            const std::vector<size_t>& members, std::vector<std::string>& remarks) {
  SurfaceFile surface = alone(mesh, look);
  if (mesh.looks[look].at_corners != 0)
    return {cellsOf(mesh, members, mesh.looks[look]), {1, 1}, 0};
  const ImportedTexture& texture = mesh.look_textures[look];
  if (texture.path.empty() && texture.file.empty()) return {plainTexture(surface)};
  FoundTexture found = readTexture(texture, mesh_path);
  if (!found.image) {
    remarks.push_back(found.remark);
    return {plainTexture(surface)};
  }
  surface.texture = std::move(found.image);
  return {shownTexture(surface), repeatsOf(mesh, members)};
}

/// Puts pages side by side in shelves, the highest ones first. Returns the size of all.
std::array<uint32_t, 2> shelve(std::vector<Page>& pages) {
  std::vector<Page*> order;
  uint64_t area = 0;
  uint32_t width = 1;
  for (Page& page : pages) {
    order.push_back(&page);
    area += page.texels();
    width = std::max(width, page.width() + 2 * page.gutter);
  }
  width = std::max(width, static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(area)))));
  std::stable_sort(order.begin(), order.end(),
                   [](const Page* a, const Page* b) { return a->height() > b->height(); });
  uint32_t x = 0, y = 0, shelf = 0;
  for (Page* const page : order) {
    const uint32_t across = page->width() + 2 * page->gutter;
    if (x + across > width) {
      y += shelf;
      x = shelf = 0;
    }
    page->place = {x + page->gutter, y + page->gutter};
    x += across;
    shelf = std::max(shelf, page->height() + 2 * page->gutter);
  }
  return {width, y + shelf};
}

/// Leaves out a page's repetitions, or else its texture.
void shorten(const MeshImport& mesh, size_t look, Page& page, std::vector<std::string>& remarks) {
  if (page.repeats != std::array<uint32_t, 2>{1, 1}) {
    page.repeats = {1, 1};
    return;
  }
  remarks.push_back("a texture of " + std::to_string(page.image.width) + " x " +
                    std::to_string(page.image.height) +
                    " is left out, because all together have too many texels");
  page = {plainTexture(alone(mesh, look))};
}

/// Shelves of all pages, with the largest ones shortened until they fit. Narrow pages beside wide
/// ones leave much of an image empty. One texel for each look stays in any case.
std::array<uint32_t, 2> fit(const MeshImport& mesh, std::vector<Page>& pages,
                            std::vector<std::string>& remarks) {
  const auto is_smaller = [](const Page& a, const Page& b) {
    const auto key = [](const Page& page) {
      return std::pair(std::max(page.width(), page.height()), page.texels());
    };
    return key(a) < key(b);
  };
  while (true) {
    const std::array<uint32_t, 2> size = shelve(pages);
    if (uint64_t{size[0]} * size[1] <= kMostTexels) return size;
    const auto largest = std::max_element(pages.begin(), pages.end(), is_smaller);
    if (largest->width() == 1 && largest->height() == 1) return size;
    shorten(mesh, static_cast<size_t>(largest - pages.begin()), *largest, remarks);
  }
}

void draw(const Page& page, ImageFile& all) {
  const auto gutter = static_cast<int64_t>(page.gutter), width = int64_t{page.width()},
             height = int64_t{page.height()};
  for (int64_t y = -gutter; y < height + gutter; ++y) {
    const int64_t row = std::clamp<int64_t>(y, 0, height - 1) % page.image.height;
    for (int64_t x = -gutter; x < width + gutter; ++x) {
      const int64_t column = std::clamp<int64_t>(x, 0, width - 1) % page.image.width;
      const auto from = static_cast<size_t>(row * page.image.width + column) * kChannels,
                 to = static_cast<size_t>((page.place[1] + y) * all.width + page.place[0] + x) *
                      kChannels;
      std::copy_n(page.image.data.begin() + static_cast<ptrdiff_t>(from), kChannels,
                  all.data.begin() + static_cast<ptrdiff_t>(to));
    }
  }
}

/// The corners of triangle `number` of a look, in texels of its page.
std::array<Coordinates, 3> texelsOf(const MeshImport& mesh, const Page& page, const LookFacts& look,
                                    size_t triangle, size_t number) {
  if (look.at_corners != 0 && page.gutter == 0) {
    const uint32_t across = page.image.width / 2;
    const double x = 2. * static_cast<double>(number % across) + 0.5,
                 y = 2. * static_cast<double>(number / across) + 0.5;
    return {{{x, y}, {x + 1, y}, {x, y + 1}}};
  }
  std::array<Coordinates, 3> corners = placed(mesh, triangle);
  for (Coordinates& corner : corners) {
    corner = {std::min<double>(corner[0], page.repeats[0]) * page.image.width,
              std::min<double>(corner[1], page.repeats[1]) * page.image.height};
  }
  return corners;
}

std::string joined(const MeshImport& mesh) {
  const auto textures = std::count_if(
      mesh.look_textures.begin(), mesh.look_textures.end(),
      [](const ImportedTexture& one) { return !one.path.empty() || !one.file.empty(); });
  if (!mesh.corner_colours.empty()) return "colours at corners become a texture";
  return textures > 1 ? std::to_string(textures) + " textures become one"
                      : "the colours of its parts become a texture";
}

}  // namespace

TexturePages pageTextures(const MeshImport& mesh, const std::string& mesh_path) {
  TexturePages result;
  result.remarks.push_back(joined(mesh));
  const Members members = membersOf(mesh);
  std::vector<Page> pages;
  uint64_t texels = 0;  // since the pages have fitted
  for (size_t look = 0; look < mesh.looks.size(); ++look) {
    pages.push_back(pageOf(mesh, mesh_path, look, members[look], result.remarks));
    texels += pages.back().texels();
    if (texels <= kMostTexels) continue;
    fit(mesh, pages, result.remarks);
    texels = 0;
  }
  const auto [width, height] = fit(mesh, pages, result.remarks);
  result.image = {width, height, kChannels, TKS_U8, {}};
  result.image.data.resize(kChannels * width * height);  // at most 400 MB, or 81 texels a look
  for (const Page& page : pages) draw(page, result.image);
  result.texcoords.resize(3 * mesh.triangles.size());
  for (size_t look = 0; look < pages.size(); ++look) {
    for (size_t i = 0; i < members[look].size(); ++i) {
      const size_t triangle = members[look][i];
      const auto corners = texelsOf(mesh, pages[look], mesh.looks[look], triangle, i);
      for (size_t k = 0; k < 3; ++k)
        result.texcoords[3 * triangle + k] = {
            static_cast<float>((pages[look].place[0] + corners[k][0]) / width),
            static_cast<float>((pages[look].place[1] + corners[k][1]) / height)};
    }
  }
  return result;
}

}  // namespace tetrakis::tools

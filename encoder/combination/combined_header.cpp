// SPDX-License-Identifier: Apache-2.0
#include "encoder/combination/combined_header.hpp"

#include <string>
#include <utility>

#include "bitstream/stream/component_list.hpp"

namespace tetrakis::inline combination {
namespace {

/// The fields of a component behind its domain, as a list of components has them.
std::string fieldsOf(StreamHeader& header, const ListedComponent& one) {
  FieldWriter fields;
  visitKnown(fields, header, one);
  return {fields.bytes.begin(), fields.bytes.end()};
}

/// Of a texture with the reference system of the heights beside it only its transform is said.
void shareReference(const StreamHeader& header, Placement& place, std::string& crs) {
  const bool same =
      place.geo_keys == header.georeference.heights.geo_keys && crs == header.metadata.crs;
  if (!same || !place.has_transform || !header.geometry) return;
  place.geo_keys.clear();
  crs.clear();
}

/// The header of a combined stream, while components join its list.
class JoinedHeader {
 public:
  explicit JoinedHeader(bool promises) : promises_(promises) {}

  /// Takes the first part as it is, and of others their components.
  Status take(const CombinedPart& part) {
    const bool is_first = out_.numbers.empty();
    if (is_first) takeFirst(part);
    std::vector<uint8_t> numbers;
    for (size_t i = 0; i < part.parsed.header.components.size(); ++i) {
      if (!is_first)
        if (Status status = join(part, i); !status.ok()) return status;
      numbers.push_back(static_cast<uint8_t>(is_first ? i : header_.components.size() - 1));
    }
    out_.numbers.push_back(std::move(numbers));
    return checkNames();
  }
  CombinedHeader result() { return std::move(out_); }

 private:
  void takeFirst(const CombinedPart& part) {
    header_ = part.parsed.header;
    header_.index.clear();
    header_.pages.clear();
    for (ListedComponent& one : header_.components)
      if (one.details.name.empty()) one.details.name = part.name;
    if (promises_ && part.is_whole) return;
    header_.lossless = 0;
    for (ListedComponent& one : header_.components) one.details.lossless = 0;
    if (header_.geometry) header_.geometry->max_error = GeometryHeader::kNotStated;
  }

  /// Component `number` of a stream, of which the header says what is its own.
  Status join(const CombinedPart& part, size_t number) {
    if (header_.components.size() == kMostListed)
      return {TKS_USAGE, "A stream has at most " + std::to_string(kMostListed) + " components."};
    ListedComponent one = part.parsed.header.components[number];
    if (one.details.name.empty()) one.details.name = part.name;
    one.component = Component::kOther;
    if (one.isHeights() || one.isTexture()) {
      ComponentChoice choice;
      (one.isHeights() ? choice.heights : choice.texture) = number;
      Result<ParsedHeader> own = readHeader(part.bytes, choice);
      if (!own.ok()) return own.status();
      StreamHeader& header = own->header;
      if (!promises_ || !part.is_whole) {
        header.lossless = 0;
        if (header.geometry) header.geometry->max_error = GeometryHeader::kNotStated;
      }
      if (one.isHeights() && header_.geometry && header.grid.samples() > 0)
        return {TKS_USAGE, "A grid on a cube comes before all other heights, or not at all."};
      one.isHeights() ? joinHeights(header, one) : joinTexture(header, one);
    }
    header_.components.push_back(std::move(one));
    return {};
  }

  void joinHeights(StreamHeader& own, ListedComponent& one) {
    if (!header_.geometry) {
      one.component = Component::kGeometry;
      header_.geometry = own.geometry;
      header_.layers = own.layers;
      header_.metadata = own.metadata;
      header_.georeference.heights = own.georeference.heights;
      header_.georeference.description = own.georeference.description;
      header_.georeference.nan_nodata = own.georeference.nan_nodata;
      header_.height_positions = own.height_positions;
      header_.grid = own.grid;
      header_.lossless &= own.lossless;
      return;
    }
    one.component = Component::kGeometry;
    one.rest = fieldsOf(own, one);
    one.component = Component::kOther;
    one.details.metadata = own.metadata;
    one.details.place = own.georeference;
    one.details.lossless = own.lossless;
  }

  void joinTexture(StreamHeader& own, ListedComponent& one) {
    Georeference place = own.georeference;
    shareReference(header_, place.texture, place.texture_crs);
    if (!header_.texture) {
      one.component = Component::kTexture;
      header_.texture = own.texture;
      header_.georeference.texture = place.texture;
      header_.georeference.texture_crs = place.texture_crs;
      header_.texture_positions = own.texture_positions;
      header_.lossless &= own.lossless;
      return;
    }
    one.component = Component::kTexture;
    one.rest = fieldsOf(own, one);
    one.component = Component::kOther;
    one.details.place = place;
    one.details.lossless = own.lossless;
  }

  /// Both are heights, or both textures.
  static bool mayBeTakenAs(const ListedComponent& a, const ListedComponent& b) {
    return (a.isHeights() && b.isHeights()) || (a.isTexture() && b.isTexture());
  }

  Status checkNames() const {
    const std::vector<ListedComponent>& list = header_.components;
    for (size_t i = 0; i < list.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        if (mayBeTakenAs(list[i], list[j]) && list[i].details.name == list[j].details.name)
          return {TKS_USAGE, "Components " + std::to_string(j) + " and " + std::to_string(i) +
                                 " are of one kind and have the same name, or none: names tell "
                                 "them apart."};
    return {};
  }

  CombinedHeader out_;
  StreamHeader& header_ = out_.header;
  bool promises_;
};

}  // namespace

Result<CombinedHeader> combinedHeader(const std::vector<CombinedPart>& parts, bool promises) {
  JoinedHeader joined(promises);
  for (const CombinedPart& part : parts)
    if (Status status = joined.take(part); !status.ok()) return status;
  return joined.result();
}

}  // namespace tetrakis::inline combination

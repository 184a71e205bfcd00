// SPDX-License-Identifier: Apache-2.0
// Which components a stream has, and which of them is asked for.
#include <algorithm>
#include <string>
#include <vector>

#include "apps/doors/gdal/source.hpp"

namespace tetrakis::gdal {
namespace {

tks_component_kind kindOf(tks_part part) {
  return part == TKS_PART_TEXTURE ? TKS_COMPONENT_TEXTURE : TKS_COMPONENT_HEIGHTS;
}

std::vector<StreamComponent> componentsOf(const tks_decoder* decoder, uint32_t count) {
  std::vector<StreamComponent> list;
  for (uint32_t i = 0; i < count; ++i) {
    tks_component one{};
    one.size = sizeof one;
    if (tks_get_component(decoder, i, &one) != TKS_OK) break;
    list.push_back({one.name, one.kind, one.width, one.height, one.domain, one.is_taken != 0});
  }
  return list;
}

/// Those of a name, or the one with that number.
std::vector<uint32_t> numbersOf(const std::string& asked,
                                const std::vector<StreamComponent>& list) {
  std::vector<uint32_t> named, numbered;
  for (uint32_t i = 0; i < list.size(); ++i) {
    if (list[i].name == asked) named.push_back(i);
    if (std::to_string(i) == asked) numbered.push_back(i);
  }
  return named.empty() ? numbered : named;
}

}  // namespace

tks_status Source::takeComponents() {
  if (components_.empty()) {
    components_ = componentsOf(decoder_.get(), info_.components);
    if (settings_.component.empty()) return TKS_OK;
    chosen_ = numbersOf(settings_.component, components_);
    if (chosen_.empty()) {
      message_ = "The stream has no component \"" + settings_.component +
                 "\"; gdalinfo -mdd TKS lists those that it has.";
      return TKS_USAGE;
    }
  }
  if (const tks_status status = chooseIn(decoder_.get()); status != TKS_OK) {
    message_ = tks_message(decoder_.get());
    return status;
  }
  if (chosen_.empty()) return TKS_OK;
  components_ = componentsOf(decoder_.get(), info_.components);
  return tks_get_info(decoder_.get(), &info_);
}

tks_status Source::chooseIn(tks_decoder* decoder) const {
  for (const uint32_t number : chosen_)
    if (const tks_status status = tks_choose_component(decoder, number); status != TKS_OK)
      return status;
  return TKS_OK;
}

std::optional<tks_part> Source::askedPart() const {
  if (chosen_.empty()) return std::nullopt;
  const bool heights = std::any_of(chosen_.begin(), chosen_.end(), [this](uint32_t number) {
    return components_[number].kind == TKS_COMPONENT_HEIGHTS;
  });
  return heights ? TKS_PART_HEIGHTS : TKS_PART_TEXTURE;
}

std::optional<uint32_t> Source::takenFor(tks_part part) const {
  for (uint32_t i = 0; i < components_.size(); ++i)
    if (components_[i].is_taken && components_[i].kind == kindOf(part)) return i;
  return std::nullopt;
}

bool Source::isFirst(uint32_t number) const {
  const auto begin = components_.begin(), at = begin + number;
  return std::none_of(begin, at,
                      [at](const StreamComponent& other) { return other.kind == at->kind; });
}

bool Source::hasFurtherComponents() const {
  for (uint32_t i = 0; i < components_.size(); ++i)
    if (components_[i].kind != TKS_COMPONENT_UNKNOWN && !isFirst(i)) return true;
  return false;
}

}  // namespace tetrakis::gdal

// SPDX-License-Identifier: Apache-2.0
// The functions here find the void samples of a height file: nodata values as GDAL compares them,
// masks, and values that look like nodata although the file does not say so.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// The nodata value as a sample of this type holds it (floats: floatNodata()); nothing if it is
/// none of its values.
std::optional<double> asSample(double nodata, tks_sample sample);

/// Makes the nodata value of floats a float, and those that meet it that very value, since streams
/// compare exactly.
void matchNodata(HeightFile& heights);

/// Where `mask` is 0 samples become void: the nodata value, or NaN, or (integers without one) a
/// value that no other sample has, with a note. TKS_USAGE if there is none.
Status applyMask(HeightFile& heights, const std::vector<uint8_t>& mask, Notes& notes);

/// A note if the nodata value is none that the samples can have, so that no sample meets it.
std::optional<Note> noteOnNodata(const HeightFile& heights);

/// NaNs among floats whose nodata value is a number: streams know one value for voids.
uint64_t nansBesideNodata(const HeightFile& heights);

/// Without a nodata value, a number that files write where they have no height gives it
/// (tks_find_outliers), with a note. Other outliers only have a note, and so have all beside a
/// nodata value.
std::optional<Note> takeOutliers(HeightFile& heights);

}  // namespace tetrakis::tools

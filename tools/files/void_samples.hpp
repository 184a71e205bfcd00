// SPDX-License-Identifier: Apache-2.0
// Which samples of a height file are void: nodata values as GDAL compares them, masks, and values
// that look like nodata although nothing says so.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/status.hpp"
#include "tools/files/files.hpp"

namespace tetrakis::tools {

/// Whether GDAL takes a float for this nodata value: a text of few digits must meet it, so the
/// last bits do not count (ARE_REAL_EQUAL() in gdal_priv.h). A NaN meets NaN.
bool meetsNodata(double sample, double nodata);

/// The nodata value as a sample of this type holds it; nothing if it is none of its values. What
/// overflows a float by less than its last bits is its largest value.
std::optional<double> asSample(double nodata, tks_sample sample);

/// The nearest float; an infinity beyond the largest.
float toFloat(double value);

/// Gives floats that meet the nodata value that very value, since streams compare exactly.
void matchNodata(HeightFile& heights);

/// Where `mask` is 0 samples become void: the nodata value, or NaN, or (integers without one) a
/// value that no other sample has, with a note. TKS_USAGE if there is none.
Status applyMask(HeightFile& heights, const std::vector<uint8_t>& mask, Notes& notes);

/// A note if the nodata value is none that the samples can have, so that no sample meets it.
std::optional<Note> noteOnNodata(const HeightFile& heights);

/// NaNs among floats whose nodata value is a number: streams know one value for voids.
uint64_t nansBesideNodata(const HeightFile& heights);

/// Without a nodata value, a number that files write where they have no height gives it
/// (tks_find_outliers), with a note. Other outliers only have a note.
std::optional<Note> takeOutliers(HeightFile& heights);

}  // namespace tetrakis::tools

#pragma once

#include <array>
#include <cstdint>

#include "io/envi/colour_map.h"
#include "io/envi/envi_header.h"
#include "sampling/reason_words.h"

namespace ifov::render {
struct ImageInfo;
}

namespace ifov::io {

/// Classes of the quality raster: 0 is converged, r + 1 the pixels whose gravest reason is Reason r.
inline constexpr std::size_t kQualityClasses = sampling::kReasonNames.size() + 1;

std::uint8_t class_of(sampling::Reasons reasons);

/// "converged", or the reason's name.
std::string_view class_name(std::size_t quality_class);

/// In pictures, the header's lookup table and the report; light grey for what is converged, warm colours where the truth
/// may lie outside of the interval, cool ones where the interval is only wider than was asked.
const std::array<Rgb, kQualityClasses>& class_colours();

/// Makes the header that of an ENVI classification: names and colours of the classes.
void add_quality_classes(EnviHeader& header, const render::ImageInfo& image);

/// "1 unjudged, 2 samples, ...": the value of each bit. (GDAL leaves values with an equals sign away.)
void add_bit_names(EnviHeader& header, const render::ImageInfo& image);

}  // namespace ifov::io

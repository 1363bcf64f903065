#pragma once

#include <cstdint>
#include <vector>

#include "io/product_parts/acquisition.h"
#include "render/tile_sink.h"

namespace ifov::io {

/// What the cubes of a tile hold that it does not hold itself, as [pixel][band].
std::vector<float> air_half_widths(const sampling::TileResult& tile, const render::ImageInfo& info);
std::vector<std::uint32_t> sample_counts(const sampling::TileResult& tile);
std::vector<float> quality_values(const sampling::TileResult& tile);
/// std::logic_error where an abundance names no pixel or no material.
std::vector<float> fractions(const sampling::TileResult& tile, std::size_t materials,
                             float sampling::Abundance::*member);
/// Map coordinates and height. Not numbers where nothing is seen, as in the next one.
std::vector<double> map_positions(const sampling::TileResult& tile, const Acquisition& acquisition);
/// Zenith and azimuth, degrees, of the direction from the place to the sensor.
std::vector<float> view_angles(const sampling::TileResult& tile, const Acquisition& acquisition);

}  // namespace ifov::io

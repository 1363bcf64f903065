#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/envi/envi_header.h"
#include "io/product_parts/run_record.h"

namespace ifov::io {

/// Header of an image's cube, without bands and what values are. `what` it holds; `statement` is the accuracy reached,
/// in words.
EnviHeader image_header(std::string_view what, const render::ImageInfo& info, const RunIdentity& identity,
                        const std::string& statement);

/// Makes bands of the image's channels.
void add_channels(EnviHeader& header, const render::ImageInfo& info);

/// Makes bands of I of all channels, then Q, U and V.
void add_stokes(EnviHeader& header, const render::ImageInfo& info);
/// What the signs of Q, U and V mean and what they are about.
std::string stokes_convention();
/// That, and where the camera's axes point in the scene.
void add_stokes_convention(EnviHeader& header, const Acquisition::Camera& camera);

/// The radiance unit as people write it.
std::string shown_unit(const std::string& unit);

/// Channels for a picture, from 0: red, green and blue where there are channels near 0.66, 0.56 and 0.48 um,
/// else the middle one.
std::vector<int> picture_channels(const render::ImageInfo& info);

}  // namespace ifov::io

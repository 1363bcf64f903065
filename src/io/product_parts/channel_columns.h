#pragma once

#include <vector>

namespace ifov::render {
struct ImageInfo;
}

namespace ifov::io {

/// What detector columns differ in, [channel][column]: centres and widths of responses, um, and how far to the right what
/// elements see lies, px. Empty where an image has none.
struct ChannelsByColumn {
  std::vector<std::vector<double>> centre_um, fwhm_um, shift_px;
  bool any() const { return !centre_um.empty() || !shift_px.empty(); }
};

ChannelsByColumn channels_by_column(const render::ImageInfo& image);

}  // namespace ifov::io

#include "io/product_parts/channel_columns.h"

#include "render/image_info.h"
#include "sensor/spectrometer/column_responses.h"

namespace ifov::io {

ChannelsByColumn channels_by_column(const render::ImageInfo& image) {
  ChannelsByColumn by_column;
  const auto width = static_cast<std::size_t>(image.width_px);
  for (std::size_t c = 0; c < image.channels.size() && image.responses; ++c) {
    const sensor::ChannelColumns& columns = (*image.responses)[c].columns;
    const bool told = !columns.centre_um.empty();
    by_column.centre_um.push_back(told ? columns.centre_um
                                       : std::vector<double>(width, image.channels[c].centre_um));
    by_column.fwhm_um.push_back(told ? columns.fwhm_um
                                     : std::vector<double>(width, image.channels[c].fwhm_um));
  }
  for (const std::vector<double>& shift : image.keystone_px)
    by_column.shift_px.push_back(shift.empty() ? std::vector<double>(width, 0.0) : shift);
  return by_column;
}

}  // namespace ifov::io

#include <string>
#include <vector>

#include "core/format.h"
#include "io/product_parts/channel_columns.h"
#include "io/product_parts/product_headers.h"
#include "io/product_parts/run_record.h"
#include "io/products/part_file.h"
#include "io/products/product_format.h"

namespace ifov::io {
namespace {

/// A picture whose columns are the detector's, and whose lines are the channels.
void write_wavelengths(PartFile& file, const FormatInput& input) {
  const render::ImageInfo& image = input.record.image;
  const ChannelsByColumn by_column = channels_by_column(image);
  EnviHeader header;
  header.samples = image.width_px, header.lines = static_cast<int>(image.channels.size());
  header.interleave = EnviInterleave::bsq;
  header.data_type = EnviType::float64;
  std::uint64_t at = 0;
  const auto put = [&](const std::vector<std::vector<double>>& values, const char* name) {
    if (values.empty()) return;
    header.band_names.emplace_back(name);
    for (const std::vector<double>& line : values) {
      file.write_at(at, line.data(), line.size() * sizeof(double));
      at += line.size() * sizeof(double);
    }
  };
  put(by_column.centre_um, "centre of the response (um)");
  put(by_column.fwhm_um, "full width at half maximum (um)");
  put(by_column.shift_px, "shift to the right (px)");
  header.bands = static_cast<int>(header.band_names.size());
  header.description = format(
      "what detector columns differ in, made by ifov {} from {}\nsamples are the columns of the image and lines its channels, in order",
      input.record.identity.version, input.record.identity.document_path);
  std::string names;
  for (const render::ChannelInfo& channel : image.channels)
    names += format("{}{}", names.empty() ? "" : ", ", list_item(channel.name));
  header.other["channel names"] = names;
  input.put_header(to_text(header));
}

}  // namespace

constinit const ProductFormat formats::kWavelengths{
    .name = "",
    .ending = "_wavelengths.img",
    .what = "wavelengths and places of channels by detector column, ENVI",
    .write = write_wavelengths,
    .suits = [](const render::ImageInfo& image) { return image.responses || !image.keystone_px.empty(); },
    .has_header = true};

}  // namespace ifov::io

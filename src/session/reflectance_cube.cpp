#include "session/reflectance_cube.h"

#include <cmath>
#include <filesystem>

#include "atmosphere/sensor/sensor_atmosphere.h"
#include "atmosphere/survey/reflectance_retrieval.h"
#include "core/error.h"
#include "io/products/envi_reader.h"
#include "io/products/part_file.h"
#include "render/image_info.h"

namespace ifov::session {

namespace {

void require_channels(const render::ImageInfo& image, const std::string& document,
                      const io::EnviReader& cube) {
  const io::EnviHeader& header = cube.header();
  const std::string file = cube.data_path().string();
  const std::size_t bands = static_cast<std::size_t>(header.bands);
  if (bands != image.channels.size())
    throw InputError(format("{}: {} bands, but the sensor of {} has {} channels", file, bands, document,
                            image.channels.size()));
  if (header.wavelength.size() != bands)
    throw InputError(format(
        "{}: its header has no wavelengths (field 'wavelength'): expected one for each of the {} bands", file,
        bands));
  const bool nanometres = header.wavelength_units == "Nanometers";
  if (!nanometres && header.wavelength_units != "Micrometers")
    throw InputError(format("{}: its header has wavelength units '{}': expected Micrometers or Nanometers",
                            file, header.wavelength_units));
  if (!header.data_units.empty() && header.data_units != image.radiance_unit)
    throw InputError(
        format("{}: its values are in '{}': expected {}", file, header.data_units, image.radiance_unit));
  for (std::size_t c = 0; c < bands; ++c) {
    const double found_um = header.wavelength[c] * (nanometres ? 1e-3 : 1.0);
    const render::ChannelInfo& channel = image.channels[c];
    const double apart_um = std::max(0.1 * channel.fwhm_um, 1e-4 * channel.centre_um);
    if (!(std::abs(found_um - channel.centre_um) <= apart_um))
      throw InputError(format(
          "{}: band {} is at {:.5g} um, channel '{}' of {} at {:.5g} um; expected the same channels in the "
          "same order (within {:.2g} um)",
          file, c + 1, found_um, channel.name, document, channel.centre_um, apart_um));
  }
}

}  // namespace

RetrievalCounts retrieve(const render::ImageInfo& image, const std::string& document,
                         const atmosphere::SensorAtmosphere& air, const io::EnviReader& cube,
                         const io::EnviReader* half_widths, const std::string& reflectance_path,
                         const std::string& half_width_path) {
  require_channels(image, document, cube);
  const atmosphere::ReflectanceRetrieval retrieval(air);
  if (retrieval.left_out().size() == image.channels.size())
    throw InputError(format(
        "no channel of {} sees sunlight that ground reflects{}: there is no reflectance to find", document,
        air.geometry().sun_zenith_rad ? ", apart from what it emits" : ", because the Sun does not shine"));
  const io::EnviHeader& from = cube.header();
  const std::size_t width = static_cast<std::size_t>(from.samples), bands = image.channels.size();
  const bool with_air = half_widths != nullptr && half_widths->header().other.contains("ifov interval");
  const bool with_model =
      with_air &&
      half_widths->header().other.at("ifov interval").find("and of its model") != std::string::npos;
  RetrievalCounts counts;
  counts.negative_by_channel.assign(bands, 0);
  counts.left_out = retrieval.left_out();
  io::PartFile values(reflectance_path), errors(half_width_path);
  std::vector<float> line(width), known(width), found(width), wide(width);
  for (int y = 0; y < from.lines; ++y)
    for (std::size_t c = 0; c < bands; ++c) {
      const render::AtmosphereHalfWidth of_air =
          image.channels[c].air.value_or(render::AtmosphereHalfWidth());
      cube.read(y, static_cast<int>(c), line);
      if (half_widths != nullptr) half_widths->read(y, static_cast<int>(c), known);
      for (std::size_t x = 0; x < width; ++x) {
        const double radiance = line[x];
        double off = half_widths != nullptr ? known[x] : 0.0;
        if (!with_air) off += of_air.of(radiance);
        if (!with_model) off += of_air.in_interval(radiance);
        found[x] = static_cast<float>(retrieval.reflectance(c, radiance));
        wide[x] = static_cast<float>(retrieval.half_width(c, radiance, off));
        ++counts.values;
        if (std::isnan(line[x])) ++counts.missing;
        if (found[x] < 0.0f) ++counts.negative, ++counts.negative_by_channel[c];
      }
      const std::uint64_t at = (static_cast<std::uint64_t>(y) * bands + c) * width * sizeof(float);
      values.write_at(at, found.data(), width * sizeof(float));
      errors.write_at(at, wide.data(), width * sizeof(float));
    }
  io::EnviHeader header = from;
  header.header_offset = 0, header.data_type = io::EnviType::float32;
  header.interleave = io::EnviInterleave::bil, header.big_endian = false;
  header.data_units = "1";
  header.other.erase("z plot titles");
  header.other["data ignore value"] = "nan";
  const auto publish = [&](io::PartFile& file, const std::string& path, const char* what) {
    header.description = format("{}, of level uniform ground, by the atmosphere of {}", what, document);
    header.other["ifov interval"] = render::what_intervals_hold(image);
    io::PartFile text(path + ".hdr");
    io::write_part(text, io::to_text(header));
    file.sync();
    file.publish();
    text.publish();
  };
  publish(values, reflectance_path, "surface reflectance");
  publish(errors, half_width_path, "half-width of the surface reflectance's interval");
  return counts;
}

}  // namespace ifov::session

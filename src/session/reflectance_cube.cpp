#include "session/reflectance_cube.h"

#include <cmath>
#include <mutex>

#include "atmosphere/sensor/sensor_atmosphere.h"
#include "atmosphere/survey/reflectance_retrieval.h"
#include "core/error.h"
#include "io/products/envi_reader.h"
#include "render/image_info.h"
#include "session/cube_channels.h"
#include "session/line_blocks.h"
#include "session/line_cube.h"

namespace ifov::session {

RetrievalCounts retrieve(const RetrievalInput& from, const atmosphere::SensorAtmosphere& air,
                         const std::string& reflectance_path, const std::string& half_width_path, int threads,
                         const CancelToken* cancel) {
  const render::ImageInfo& image = from.image;
  require_channels(from.cube, image.channels, image.radiance_unit, from.document);
  const atmosphere::ReflectanceRetrieval retrieval(air);
  if (retrieval.left_out().size() == image.channels.size())
    throw InputError(format(
        "no channel of {} sees sunlight that ground reflects{}: there is no reflectance to find",
        from.document,
        air.geometry().sun_zenith_rad ? ", apart from what it emits" : ", because the Sun does not shine"));
  io::EnviHeader header = from.cube.header();
  const auto width = static_cast<std::size_t>(header.samples), bands = image.channels.size();
  const int lines = header.lines;
  header.data_units = std::string("1");
  header.other.erase("z plot titles");
  header.other["data ignore value"] = std::string("nan");
  header.other["ifov interval"] = render::what_intervals_hold(image);
  const auto described = [&](const char* what) {
    header.description = format("{}, of level uniform ground, by the atmosphere of {}", what, from.document);
    return header;
  };
  LineCube reflectance(reflectance_path, described("surface reflectance")),
      half_width(half_width_path, described("half-width of the surface reflectance's interval"));

  render::AirInIntervals held = render::AirInIntervals::none;
  if (from.half_widths != nullptr) {
    const auto& fields = from.half_widths->header().other;
    if (const auto told = fields.find("ifov interval"); told != fields.end())
      held = render::air_in_intervals(told->second);
  }
  RetrievalCounts counts;
  counts.negative_by_channel.assign(bands, 0);
  counts.left_out = retrieval.left_out();
  std::mutex counting;
  for_line_blocks(lines, threads, cancel, [&](int first, int end) {
    std::vector<float> radiance(width), known(width),
        found(reflectance.line_values() * static_cast<std::size_t>(end - first)), wide(found.size());
    std::vector<std::uint64_t> negative(bands, 0);
    std::uint64_t missing = 0;
    std::size_t next = 0;
    for (int y = first; y < end; ++y)
      for (std::size_t c = 0; c < bands; ++c) {
        const render::AtmosphereHalfWidth of_air =
            image.channels[c].air.value_or(render::AtmosphereHalfWidth());
        from.cube.read(y, static_cast<int>(c), radiance);
        if (from.half_widths != nullptr) from.half_widths->read(y, static_cast<int>(c), known);
        for (std::size_t x = 0; x < width; ++x, ++next) {
          double off = from.half_widths != nullptr ? known[x] : 0.0;
          if (held == render::AirInIntervals::none) off += of_air.of(radiance[x]);
          if (held != render::AirInIntervals::numbers_and_model) off += of_air.in_interval(radiance[x]);
          found[next] = static_cast<float>(retrieval.reflectance(c, radiance[x]));
          wide[next] = static_cast<float>(retrieval.half_width(c, radiance[x], off));
          if (std::isnan(radiance[x])) ++missing;
          if (found[next] < 0.0f) ++negative[c];
        }
      }
    reflectance.write(first, found);
    half_width.write(first, wide);
    const std::scoped_lock lock(counting);
    counts.values += found.size();
    counts.missing += missing;
    for (std::size_t c = 0; c < bands; ++c)
      counts.negative += negative[c], counts.negative_by_channel[c] += negative[c];
  });
  half_width.publish();
  reflectance.publish();
  return counts;
}

}  // namespace ifov::session

#include "session/runs/detection.h"

#include <algorithm>

#include "core/error.h"
#include "io/document/sensor_document.h"
#include "io/products/envi_reader.h"
#include "sensor/noise.h"
#include "session/assembly/whole/noise_assembly.h"
#include "session/assembly/whole/sensor_assembly.h"
#include "session/line_blocks.h"
#include "session/line_cube.h"

namespace ifov::session {
namespace {

std::string noises(std::span<const render::ChannelInfo> channels) {
  std::string text;
  for (const render::ChannelInfo& channel : channels)
    text += format("{}{:.6g}", text.empty() ? "" : ", ", channel.noise);
  return text;
}

}  // namespace

std::vector<render::ChannelInfo> noisy_channels(const io::DocumentSources& sources,
                                                std::span<const io::ChannelDocument> written) {
  const std::vector<radiometry::Channel> channels = assemble_channels(sources, written);
  const std::vector<double> noise = assemble_noise(sources, written, channels);
  std::vector<render::ChannelInfo> result;
  for (std::size_t c = 0; c < channels.size(); ++c)
    result.push_back({channels[c].name, channels[c].centre_um, channels[c].fwhm_um, {}, noise[c]});
  if (std::none_of(noise.begin(), noise.end(), [](double one) { return one > 0.0; }))
    throw io::document_error(sources, written.front().position, kNoNoise);
  return result;
}

std::unique_ptr<LineCube> noisy_cube(const io::EnviReader& radiance,
                                     std::span<const render::ChannelInfo> channels, std::uint64_t seed,
                                     const std::filesystem::path& to, int threads,
                                     const CancelToken* cancel) {
  io::EnviHeader header = radiance.header();
  header.description = format("{} with the sensor's noise drawn by ifov detect, seed {}",
                              radiance.data_path().filename().string(), seed);
  header.other["noise standard deviation"] = noises(channels);
  auto cube = std::make_unique<LineCube>(to, std::move(header));
  const auto width = static_cast<std::size_t>(radiance.header().samples);
  const sensor::Noise noise(seed);
  for_line_blocks(radiance.header().lines, threads, cancel, [&](int first, int end) {
    std::vector<float> values(cube->line_values() * static_cast<std::size_t>(end - first));
    float* next = values.data();
    for (int line = first; line < end; ++line)
      for (std::size_t band = 0; band < channels.size(); ++band, next += width) {
        radiance.read(line, static_cast<int>(band), {next, width});
        noise.add(line, static_cast<int>(band), channels[band].noise, {next, width});
      }
    cube->write(first, values);
  });
  return cube;
}

}  // namespace ifov::session

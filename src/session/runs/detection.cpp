#include "session/runs/detection.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "core/parallel.h"
#include "core/run_control.h"
#include "io/document/sensor_document.h"
#include "io/products/envi_reader.h"
#include "sensor/noise.h"
#include "session/assembly/whole/noise_assembly.h"
#include "session/assembly/whole/sensor_assembly.h"

namespace ifov::session {
namespace {

/// Lines that are written in one piece.
constexpr int kLines = 16;

std::string listed(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += format("{}{:.6g}", text.empty() ? "" : ", ", value);
  return text;
}

io::EnviHeader noisy_header(const io::EnviHeader& of, const NoisyChannels& channels, std::uint64_t seed,
                            const std::filesystem::path& from) {
  io::EnviHeader header = of;
  header.header_offset = 0;
  header.data_type = io::EnviType::float32;
  header.interleave = io::EnviInterleave::bil;
  header.big_endian = false;
  header.description =
      format("{} with the sensor's noise drawn by ifov detect, seed {}", from.filename().string(), seed);
  header.other["noise standard deviation"] = listed(channels.noise);
  return header;
}

}  // namespace

NoisyChannels noisy_channels(const io::DocumentSources& sources,
                             std::span<const io::ChannelDocument> written) {
  NoisyChannels result;
  result.channels = assemble_channels(sources, written);
  result.noise = assemble_noise(sources, written, result.channels);
  if (std::none_of(result.noise.begin(), result.noise.end(), [](double noise) { return noise > 0.0; }))
    throw io::document_error(sources, written.front().position,
                             "no channel tells the sensor's noise: give channels 'noise' (NEdL) or "
                             "'noise_temperature' (NEdT)");
  return result;
}

void require_same_channels(const io::EnviReader& radiance, const NoisyChannels& channels,
                           const std::string& told_by) {
  constexpr double kSame = 1e-3;
  const io::EnviHeader& header = radiance.header();
  const std::string cube = radiance.data_path().string();
  if (header.bands != static_cast<int>(channels.channels.size()))
    throw InputError(format("'{}' has {} bands, and '{}' tells the noise of {} channels", cube, header.bands,
                            told_by, channels.channels.size()));
  const double um = header.wavelength_units == "Nanometers" ? 1e-3 : 1.0;
  for (std::size_t c = 0; c < header.wavelength.size(); ++c) {
    const double in_cube = um * header.wavelength[c], told = channels.channels[c].centre_um;
    if (std::abs(in_cube - told) > kSame * told)
      throw InputError(format("band {} of '{}' lies at {:.6g} um, and channel '{}' of '{}' at {:.6g} um",
                              c + 1, cube, in_cube, channels.channels[c].name, told_by, told));
  }
}

NoisyCube::NoisyCube(const io::EnviReader& radiance, const NoisyChannels& channels, std::uint64_t seed,
                     const std::filesystem::path& to)
    : radiance_(radiance),
      channels_(channels),
      seed_(seed),
      header_(noisy_header(radiance.header(), channels, seed, radiance.data_path())),
      cube_(to),
      header_file_(to.string() + ".hdr") {}

NoisyCube::~NoisyCube() {
  if (published_) return;
  try {
    cube_.discard();
    header_file_.discard();
  } catch (const SystemError&) {  // what is left has a name that says so
  }
}

void NoisyCube::write(int threads, const CancelToken* cancel) {
  const auto width = static_cast<std::size_t>(header_.samples);
  const std::size_t line_values = width * static_cast<std::size_t>(header_.bands);
  const sensor::Noise noise(seed_);
  cube_.reserve(header_.data_bytes());
  parallel_for((header_.lines + kLines - 1) / kLines, threads, [&](std::int64_t part) {
    if (cancel != nullptr && cancel->cancelled()) throw Cancelled();
    const int first = static_cast<int>(part) * kLines, end = std::min(header_.lines, first + kLines);
    std::vector<float> values(line_values * static_cast<std::size_t>(end - first));
    float* next = values.data();
    for (int line = first; line < end; ++line)
      for (int band = 0; band < header_.bands; ++band, next += width) {
        radiance_.read(line, band, {next, width});
        noise.add(line, band, channels_.noise[static_cast<std::size_t>(band)], {next, width});
      }
    cube_.write_at(static_cast<std::uint64_t>(first) * line_values * sizeof(float), values.data(),
                   values.size() * sizeof(float));
  });
  io::write_part(header_file_, io::to_text(header_));
}

void NoisyCube::publish() {
  cube_.sync();
  header_file_.publish();
  cube_.publish();
  published_ = true;
}

}  // namespace ifov::session

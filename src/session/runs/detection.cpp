#include "session/runs/detection.h"

#include <algorithm>
#include <mutex>
#include <numbers>

#include "core/error.h"
#include "ifov/detect.h"
#include "io/document/document_error.h"
#include "io/document/sensor_document.h"
#include "io/products/envi_reader.h"
#include "sensor/detector/brightness_scale.h"
#include "sensor/detector/detector.h"
#include "sensor/detector/detector_signal.h"
#include "sensor/detector/one_over_f.h"
#include "sensor/noise.h"
#include "session/assembly/whole/noise_assembly.h"
#include "session/assembly/whole/sensor_assembly.h"
#include "session/line_blocks.h"
#include "session/line_cube.h"
#include "session/runs/detected_values.h"

namespace ifov::session {
namespace {

/// Draws a line of one channel after the other.
class Drawing {
 public:
  Drawing(const io::EnviReader& radiance, std::span<const render::ChannelInfo> channels, std::uint64_t seed,
          std::span<const DetectedCube> told, std::span<const sensor::BrightnessScale> scales,
          const std::vector<std::unique_ptr<LineCube>>& cubes)
      : radiance_(radiance),
        channels_(channels),
        seed_(seed),
        noise_(seed),
        told_(told),
        scales_(scales),
        cubes_(cubes) {
    const io::EnviHeader& header = radiance.header();
    lines_ = header.lines, width_ = header.samples;
    for (std::size_t c = 0; c < channels.size(); ++c)
      signals_.emplace_back(detector(c), seed, static_cast<int>(c), width_);
    saturated.assign(channels.size(), 0);
  }

  /// All lines of the channels from `first` to before `end`.
  void draw(std::size_t first, std::size_t end, int threads, const CancelToken* cancel) {
    drifts_.clear();
    for (std::size_t c = first; c < end; ++c)
      drifts_.push_back(
          sensor::one_over_f_noise(detector(c), seed_, static_cast<int>(c), lines_, width_, threads));
    for_line_blocks(lines_, threads, cancel, [&](int from, int to) {
      std::vector<std::vector<std::byte>> values(cubes_.size());
      std::vector<std::uint64_t> full(channels_.size(), 0);
      for (int line = from; line < to; ++line) {
        for (std::vector<std::byte>& of_cube : values) of_cube.clear();
        for (std::size_t c = first; c < end; ++c) full[c] += draw(line, c, c - first, values);
        for (std::size_t k = 0; k < cubes_.size(); ++k)
          cubes_[k]->write(line, static_cast<int>(first), values[k]);
      }
      const std::scoped_lock lock(counting_);
      for (std::size_t c = first; c < end; ++c) saturated[c] += full[c];
    });
  }

  std::vector<std::uint64_t> saturated;

 private:
  const sensor::Detector& detector(std::size_t c) const {
    static const sensor::Detector none;
    return channels_[c].detector ? *channels_[c].detector : none;
  }

  /// Of a channel in a cube.
  RadianceAs radiance_as(std::size_t cube, std::size_t c) const {
    RadianceAs as;
    if (told_[cube].quantity == DetectedQuantity::kelvins) as.scale = &scales_[c];
    if (told_[cube].quantity == DetectedQuantity::toa_reflectance)
      as.factor = std::numbers::pi / channels_[c].toa_irradiance;
    return as;
  }

  /// How many pixels are saturated.
  std::uint64_t draw(int line, std::size_t c, std::size_t drift,
                     std::vector<std::vector<std::byte>>& values) const {
    const auto width = static_cast<std::size_t>(width_);
    std::vector<float> mean(width);
    radiance_.read(line, static_cast<int>(c), mean);
    if (!channels_[c].detector) {
      noise_.add(line, static_cast<int>(c), channels_[c].noise, mean);
      for (std::size_t k = 0; k < cubes_.size(); ++k) append_values(mean, radiance_as(k, c), values[k]);
      return 0;
    }
    const sensor::Detector& of = detector(c);
    std::span<const float> slow = drifts_[drift];
    if (!slow.empty()) slow = slow.subspan(static_cast<std::size_t>(line) * width, width);
    std::vector<double> signal(width);
    signals_[c].draw(line, mean, slow, signal);
    for (std::size_t k = 0; k < cubes_.size(); ++k)
      append_detected(of, told_[k].quantity, cubes_[k]->header().data_type, signal, radiance_as(k, c),
                      values[k]);
    // What is full reads less by read noise.
    const double most = of.largest_signal() - 0.5 * of.gain - 4.0 * of.read_noise;
    return static_cast<std::uint64_t>(
        std::count_if(signal.begin(), signal.end(), [&](double one) { return one >= most; }));
  }

  const io::EnviReader& radiance_;
  std::span<const render::ChannelInfo> channels_;
  std::uint64_t seed_;
  sensor::Noise noise_;
  std::span<const DetectedCube> told_;
  std::span<const sensor::BrightnessScale> scales_;
  const std::vector<std::unique_ptr<LineCube>>& cubes_;
  int lines_ = 0, width_ = 0;
  std::vector<sensor::DetectorSignal> signals_;
  std::vector<std::vector<float>> drifts_;  // of the channels that are drawn
  std::mutex counting_;
};

/// So many channels are drawn at once: their 1/f noise is held in memory for whole images.
std::size_t channels_at_once(const io::EnviHeader& header, std::span<const render::ChannelInfo> channels) {
  constexpr double kMost_bytes = 256e6;
  if (std::none_of(channels.begin(), channels.end(), [](const render::ChannelInfo& channel) {
        return channel.detector && channel.detector->one_over_f > 0.0;
      }))
    return channels.size();
  const double bytes = 4.0 * header.samples * header.lines;
  return static_cast<std::size_t>(std::clamp(kMost_bytes / bytes, 1.0, static_cast<double>(channels.size())));
}

}  // namespace

std::vector<render::ChannelInfo> noisy_channels(const io::DocumentSources& sources,
                                                const io::SensorDocument& sensor) {
  const std::vector<radiometry::Channel> channels = assemble_channels(sources, sensor.channels);
  std::vector<render::ChannelInfo> result;
  for (const radiometry::Channel& channel : channels)
    result.push_back({channel.name, channel.centre_um, channel.fwhm_um});
  tell_noise(sources, sensor, channels, result);
  if (std::none_of(result.begin(), result.end(),
                   [](const render::ChannelInfo& one) { return one.noise > 0.0; }))
    throw io::document_error(sources, sensor.channels.front().position, kNoNoise);
  return result;
}

std::vector<sensor::BrightnessScale> brightness_scales(const io::DocumentSources& sources,
                                                       const io::SensorDocument& sensor) {
  std::vector<sensor::BrightnessScale> scales;
  for (const radiometry::Channel& channel : assemble_channels(sources, sensor.channels))
    scales.emplace_back(channel);
  return scales;
}

void require_quantity(DetectedQuantity quantity, std::span<const render::ChannelInfo> channels,
                      const std::string& document) {
  if (quantity == DetectedQuantity::radiance || quantity == DetectedQuantity::kelvins) return;
  if (quantity == DetectedQuantity::toa_reflectance) {
    for (const render::ChannelInfo& channel : channels)
      if (!(channel.toa_irradiance > 0.0))
        throw InputError(format(
            "{}: the run tells no sunlight above the air in channel '{}', which reflectance at the sensor is over: ask for radiance",
            document, channel.name));
    return;
  }
  for (const render::ChannelInfo& channel : channels) {
    if (!channel.detector)
      throw InputError(format("{}: channel '{}' has no 'detector' that makes electrons: ask for radiance",
                              document, channel.name));
    if (quantity == DetectedQuantity::counts && !channel.detector->digitises())
      throw InputError(
          format("{}: the detector of channel '{}' makes no counts: give it 'bits', or ask for electrons",
                 document, channel.name));
  }
}

Realization realize(const io::EnviReader& radiance, std::span<const render::ChannelInfo> channels,
                    std::uint64_t seed, std::span<const DetectedCube> cubes,
                    std::span<const sensor::BrightnessScale> scales, int threads, const CancelToken* cancel) {
  Realization result;
  for (const DetectedCube& cube : cubes)
    result.cubes.push_back(std::make_unique<LineCube>(
        cube.path, detected_header(radiance.header(), cube.quantity, channels,
                                   radiance.data_path().filename().string(), seed)));
  Drawing drawing(radiance, channels, seed, cubes, scales, result.cubes);
  const std::size_t at_once = channels_at_once(radiance.header(), channels);
  for (std::size_t first = 0; first < channels.size(); first += at_once)
    drawing.draw(first, std::min(first + at_once, channels.size()), threads, cancel);
  result.saturated = drawing.saturated;
  return result;
}

}  // namespace ifov::session

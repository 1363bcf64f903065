#include "session/detection/detection.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <numbers>

#include "core/error.h"
#include "core/parallel.h"
#include "ifov/detect.h"
#include "io/document/document_error.h"
#include "io/document/sensor_document.h"
#include "io/products/envi_reader.h"
#include "render/column_conversions.h"
#include "sensor/detector/blooming.h"
#include "sensor/detector/brightness_scale.h"
#include "sensor/detector/detector.h"
#include "sensor/detector/detector_signal.h"
#include "sensor/detector/memory.h"
#include "sensor/detector/mosaic.h"
#include "sensor/detector/one_over_f.h"
#include "sensor/noise.h"
#include "sensor/spectrometer/column_responses.h"
#include "session/assembly/whole/across_track.h"
#include "session/assembly/whole/noise_assembly.h"
#include "session/assembly/whole/sensor_assembly.h"
#include "session/detection/detected_values.h"
#include "session/detection/seen_light.h"
#include "session/line_blocks.h"
#include "session/line_cube.h"

namespace ifov::session {
namespace {

/// Draws a line of one channel after the other.
class Drawing {
 public:
  Drawing(const SignalSource& source, const render::ImageInfo& image, std::uint64_t seed,
          std::span<const DetectedCube> told, const std::vector<std::unique_ptr<LineCube>>& cubes)
      : source_(source),
        radiance_(*source.radiance),
        image_(image),
        channels_(image.channels),
        seed_(seed),
        noise_(seed),
        told_(told),
        cubes_(cubes) {
    const io::EnviHeader& header = radiance_.header();
    lines_ = header.lines, width_ = header.samples;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      illumination_.emplace_back(detector(c), width_, lines_, source.read_out);
      signals_.emplace_back(detector(c), seed, static_cast<int>(c), width_, source.read_out,
                            illumination_.back());
    }
    for (const render::ChannelInfo& channel : channels_) memories_.emplace_back(channel.lag, channel.inertia);
    saturated.assign(channels_.size(), 0);
  }

  /// All lines of the channels from `first` to before `end`.
  void draw(std::size_t first, std::size_t end, int threads, const CancelToken* cancel) {
    drifts_.clear();
    for (std::size_t c = first; c < end; ++c)
      drifts_.push_back(
          sensor::one_over_f_noise(detector(c), seed_, static_cast<int>(c), lines_, width_, threads));
    run_over_lines(first, end, threads, cancel);
    for_line_blocks(lines_, threads, cancel, [&](int from, int to) {
      std::vector<SeenLight> seen;
      for (std::size_t c = first; c < end; ++c)
        seen.emplace_back(source_, memories_[c], static_cast<int>(c), from, to, most_radiance(c));
      std::vector<std::vector<std::byte>> values(cubes_.size());
      std::vector<std::uint64_t> full(channels_.size(), 0);
      for (int line = from; line < to; ++line) {
        for (std::vector<std::byte>& of_cube : values) of_cube.clear();
        for (std::size_t c = first; c < end; ++c)
          full[c] += draw(line, c, c - first, seen[c - first], values);
        for (std::size_t k = 0; k < cubes_.size(); ++k) {
          if (!image_.mosaic)
            cubes_[k]->write(line, static_cast<int>(first), values[k]);
          else
            cubes_[k]->write(line, 0, through_filters(line, first, end, values[k], *cubes_[k]));
        }
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

  /// The line of the mosaic with what elements have through the filters of the channels from `first` to before `end`, whose values these
  /// are; what the others have was written before, or comes after.
  std::vector<std::byte> through_filters(int line, std::size_t first, std::size_t end,
                                         const std::vector<std::byte>& values, const LineCube& before) const {
    const auto width = static_cast<std::size_t>(width_);
    const std::size_t bytes = values.size() / (width * (end - first));
    std::vector<std::byte> own(width * bytes);
    if (first > 0) before.read(line, own);
    for (std::size_t x = 0; x < width; ++x) {
      const auto channel = static_cast<std::size_t>(image_.mosaic->channel_at(static_cast<int>(x), line));
      if (channel < first || channel >= end) continue;
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(((channel - first) * width + x) * bytes),
                  bytes, own.begin() + static_cast<std::ptrdiff_t>(x * bytes));
    }
    return own;
  }

  /// Of a channel in a cube.
  RadianceAs radiance_as(std::size_t cube, std::size_t c) const {
    if (told_[cube].quantity == DetectedQuantity::kelvins)
      return [this, c](std::size_t column, double radiance) {
        return render::brightness_kelvin(image_, c, static_cast<int>(column), radiance);
      };
    if (told_[cube].quantity == DetectedQuantity::toa_reflectance)
      return [this, c](std::size_t column, double radiance) {
        return std::numbers::pi / render::toa_irradiance(image_, c, static_cast<int>(column)) * radiance;
      };
    return [](std::size_t, double radiance) { return radiance; };
  }

  /// The radiance that fills the wells of a channel's elements.
  double most_radiance(std::size_t c) const {
    const sensor::Detector& of = detector(c);
    return of.exists() && of.full_well > 0.0 ? of.radiance_w_m2_sr_um(of.full_well)
                                             : std::numeric_limits<double>::infinity();
  }

  /// Of frames whose wells run over along columns: electrons of all lines.
  void run_over_lines(std::size_t first, std::size_t end, int threads, const CancelToken* cancel) {
    held_.assign(end - first, {});
    if (source_.read_out.kind != sensor::ReadOut::Kind::frame) return;
    const auto width = static_cast<std::size_t>(width_);
    for (std::size_t c = first; c < end; ++c) {
      const sensor::Detector& of = detector(c);
      if (!(of.blooming > 0.0)) continue;
      std::vector<double>& held = held_[c - first];
      held.resize(width * static_cast<std::size_t>(lines_));
      for_line_blocks(lines_, threads, cancel, [&](int from, int to) {
        const SeenLight seen(source_, memories_[c], static_cast<int>(c), from, to, most_radiance(c));
        std::vector<float> mean(width);
        for (int line = from; line < to; ++line) {
          seen.read(line, mean);
          signals_[c].collect(line, mean,
                              std::span(held).subspan(static_cast<std::size_t>(line) * width, width));
        }
      });
      parallel_for(width_, threads, [&](std::int64_t x) {
        sensor::run_over(held, static_cast<std::size_t>(x), width, static_cast<std::size_t>(lines_),
                         of.full_well, of.blooming);
      });
    }
  }

  /// How many pixels are saturated.
  std::uint64_t draw(int line, std::size_t c, std::size_t drift, const SeenLight& seen,
                     std::vector<std::vector<std::byte>>& values) const {
    const auto width = static_cast<std::size_t>(width_);
    std::vector<float> mean(width);
    seen.read(line, mean);
    if (!channels_[c].detector) {
      noise_.add(line, static_cast<int>(c), channels_[c].noise, mean);
      for (std::size_t k = 0; k < cubes_.size(); ++k) append_values(mean, radiance_as(k, c), values[k]);
      return 0;
    }
    const sensor::Detector& of = detector(c);
    std::span<const float> slow = drifts_[drift];
    if (!slow.empty()) slow = slow.subspan(static_cast<std::size_t>(line) * width, width);
    std::vector<double> signal(width);
    if (held_[drift].empty()) {
      signals_[c].draw(line, mean, slow, signal);
    } else {
      std::copy_n(held_[drift].begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(line) * width),
                  width, signal.begin());
      signals_[c].read(line, mean, slow, signal);
    }
    // What is full reads less by read noise.
    const double most = of.largest_signal() - 0.5 * of.gain - 4.0 * of.read_noise;
    const auto full = std::count_if(signal.begin(), signal.end(), [&](double one) { return one >= most; });
    signals_[c].correct(line, signal);
    // What was corrected is as of elements in the middle; else who makes radiance of it knows how much light falls where.
    const std::vector<double> light =
        of.is_corrected() ? std::vector<double>() : illumination_[c].of_line(line);
    for (std::size_t k = 0; k < cubes_.size(); ++k)
      append_detected(of, told_[k].quantity, cubes_[k]->header().data_type, signal, light, radiance_as(k, c),
                      values[k]);
    return static_cast<std::uint64_t>(full);
  }

  const SignalSource& source_;
  const io::EnviReader& radiance_;
  const render::ImageInfo& image_;
  std::span<const render::ChannelInfo> channels_;
  std::uint64_t seed_;
  sensor::Noise noise_;
  std::span<const DetectedCube> told_;
  const std::vector<std::unique_ptr<LineCube>>& cubes_;
  int lines_ = 0, width_ = 0;
  std::vector<sensor::Illumination> illumination_;
  std::vector<sensor::DetectorSignal> signals_;
  std::vector<sensor::SignalMemory> memories_;
  std::vector<std::vector<float>> drifts_;  // of the channels that are drawn
  std::vector<std::vector<double>> held_;   // likewise: electrons of whole frames, where wells run over
  std::mutex counting_;
};

/// So many channels are drawn at once: their 1/f noise, and what runs over, is held in memory for whole images.
std::size_t channels_at_once(const io::EnviHeader& header, std::span<const render::ChannelInfo> channels,
                             double most_bytes) {
  if (std::none_of(channels.begin(), channels.end(), [](const render::ChannelInfo& channel) {
        return channel.detector && (channel.detector->one_over_f > 0.0 || channel.detector->blooming > 0.0);
      }))
    return channels.size();
  const double bytes = 4.0 * header.samples * header.lines;
  return static_cast<std::size_t>(std::clamp(most_bytes / bytes, 1.0, static_cast<double>(channels.size())));
}

/// One band, of which what is told by channel is told so.
void tell_mosaic(const render::ImageInfo& image, io::EnviHeader& header) {
  header.bands = 1;
  header.band_names = {"mosaic"};
  header.wavelength.clear(), header.fwhm.clear(), header.default_bands.clear();
  header.wavelength_units.clear();
  header.other["mosaic pattern"] = render::mosaic_pattern(image);
  for (const char* key : {"data gain values", "data offset values", "noise standard deviation"})
    if (auto found = header.other.extract(key)) {
      found.key() = std::string("channel ") + key;
      header.other.insert(std::move(found));
    }
  std::string names;
  for (const render::ChannelInfo& channel : image.channels)
    names += format("{}{}", names.empty() ? "" : ", ", io::list_item(channel.name));
  header.other["channel names"] = names;
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

void tell_brightness(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                     render::ImageInfo& image) {
  const std::vector<radiometry::Channel> channels = assemble_channels(sources, sensor.channels);
  image.responses = assemble_smile(sources, sensor, channels, image.width_px);
  for (std::size_t c = 0; c < channels.size(); ++c)
    image.channels[c].brightness = std::make_shared<const sensor::BrightnessScale>(channels[c]);
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

Realization realize(const SignalSource& source, const render::ImageInfo& image, std::uint64_t seed,
                    std::span<const DetectedCube> cubes, int threads, const CancelToken* cancel,
                    double most_drift_bytes) {
  const std::span<const render::ChannelInfo> channels = image.channels;
  const io::EnviReader& radiance = *source.radiance;
  Realization result;
  for (const DetectedCube& cube : cubes) {
    io::EnviHeader header = detected_header(radiance.header(), cube.quantity, channels,
                                            radiance.data_path().filename().string(), seed);
    if (image.mosaic) tell_mosaic(image, header);
    result.cubes.push_back(std::make_unique<LineCube>(cube.path, std::move(header)));
  }
  Drawing drawing(source, image, seed, cubes, result.cubes);
  const std::size_t at_once = channels_at_once(radiance.header(), channels, most_drift_bytes);
  for (std::size_t first = 0; first < channels.size(); first += at_once)
    drawing.draw(first, std::min(first + at_once, channels.size()), threads, cancel);
  result.saturated = drawing.saturated;
  return result;
}

}  // namespace ifov::session

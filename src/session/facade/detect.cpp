#include "ifov/detect.h"

#include <algorithm>
#include <future>
#include <memory>

#include "core/call_scope.h"
#include "core/error.h"
#include "ifov/products.h"
#include "io/document/cameras/camera_settings.h"
#include "io/files/inputs.h"
#include "io/products/envi_reader.h"
#include "sensor/detector/brightness_scale.h"
#include "sensor/detector/detector.h"
#include "sensor/detector/mosaic.h"
#include "sensor/detector/read_out.h"
#include "session/cube_channels.h"
#include "session/detection/detection.h"
#include "session/facade/access.h"
#include "session/facade/document_inside.h"
#include "session/line_cube.h"
#include "session/runs/run_record_file.h"

namespace ifov {
namespace {

constexpr std::string_view kRecordEnding = "_run.json";

std::vector<render::ChannelInfo> channels_of(const Document& document) {
  const auto& inside = FacadeAccess::inside(document);
  const Call call{inside.inputs};
  const CallScope scope(call);
  return session::noisy_channels(inside.document.sources, inside.document.sensor);
}

/// None where none is told.
std::shared_ptr<const sensor::Detector> detector_of(const session::Record& told) {
  if (!told.is_there()) return nullptr;
  auto detector = std::make_shared<sensor::Detector>();
  for (const sensor::DetectorFigure& figure : sensor::detector_figures())
    (*detector).*figure.value = told[figure.name].number();
  std::vector<std::array<double, 2>> rows;
  for (const session::Record& row : told["vignette_rows"].items()) {
    const std::vector<session::Record> numbers = row.items();
    if (numbers.size() == 2) rows.push_back({numbers[0].number(), numbers[1].number()});
  }
  if (!rows.empty())
    detector->vignette_rows = std::make_shared<const std::vector<std::array<double, 2>>>(std::move(rows));
  return detector->exists() ? detector : nullptr;
}

std::vector<render::ChannelInfo> channels_of(const std::filesystem::path& record) {
  std::vector<render::ChannelInfo> channels;
  bool any = false;
  const session::RunRecordFile file(record);
  for (const session::Record& channel : file.root()["channels"].items()) {
    channels.push_back({channel["name"].text(""),
                        channel["centre_um"].number(),
                        channel["fwhm_um"].number(),
                        {},
                        channel["noise"].number(),
                        detector_of(channel["detector"])});
    channels.back().lag = channel["lag"].number(), channels.back().inertia = channel["inertia"].number();
    any = any || channels.back().noise > 0.0;
  }
  if (!any)
    throw InputError(
        format("{}: {}; or name another document whose channels do", record.string(), session::kNoNoise));
  return channels;
}

/// As the run had it, whatever document tells the noise.
void tell_sunlight(const std::filesystem::path& record, std::span<render::ChannelInfo> channels) {
  const session::RunRecordFile file(record);
  const std::vector<session::Record> told = file.root()["channels"].items();
  for (std::size_t c = 0; c < std::min(told.size(), channels.size()); ++c)
    channels[c].toa_irradiance = told[c]["toa_irradiance"].number();
  for (std::size_t c = 0; c < std::min(told.size(), channels.size()); ++c)
    for (const session::Record& carried : told[c]["toa_irradiance_of_carried"].items())
      channels[c].toa_of_carried.push_back(carried.number());
}

/// What the run's record holds, with values in place of its own.
Document written_document(const std::filesystem::path& record, const std::vector<std::string>& set) {
  const RunInfo run = run_info(record);
  const std::filesystem::path written = run.document;
  return Document::parse(run.document_text, written.filename().string(), written.parent_path(), set);
}

/// Responses, for kelvins and where they differ by column.
void tell_responses(const std::filesystem::path& record, const std::optional<Document>& other,
                    const DetectOptions& options, render::ImageInfo& image) {
  const auto wants = [&](DetectedQuantity quantity) {
    return std::find(options.quantities.begin(), options.quantities.end(), quantity) !=
           options.quantities.end();
  };
  const bool by_column =
      std::any_of(image.channels.begin(), image.channels.end(),
                  [](const render::ChannelInfo& channel) { return channel.toa_of_carried.size() > 1; });
  if (!wants(DetectedQuantity::kelvins) && !(wants(DetectedQuantity::toa_reflectance) && by_column)) return;
  // Of sunlight in a column the run's own responses tell.
  const Document document = other && !by_column ? *other : written_document(record, {});
  const auto& inside = FacadeAccess::inside(document);
  const Call call{inside.inputs};
  const CallScope scope(call);
  session::tell_brightness(inside.document.sources, inside.document.sensor, image);
}

/// Of the run's camera, where anything depends on it.
sensor::ReadOut read_out_of(const std::filesystem::path& record,
                            std::span<const render::ChannelInfo> channels) {
  const auto depends = [](const render::ChannelInfo& channel) {
    return channel.lag > 0.0 || channel.inertia > 0.0 ||
           (channel.detector && (channel.detector->has_pattern() || channel.detector->is_corrected() ||
                                 channel.detector->blooming > 0.0));
  };
  if (std::none_of(channels.begin(), channels.end(), depends)) return {};
  const Document document = written_document(record, {});
  return FacadeAccess::inside(document).document.sensor.camera.settings->read_out();
}

/// Cubes of the frames before.
std::vector<std::unique_ptr<io::EnviReader>> earlier_frames(const DetectOptions& options,
                                                            const sensor::ReadOut& read_out,
                                                            const render::ImageInfo& image) {
  std::vector<std::unique_ptr<io::EnviReader>> frames;
  if (options.after.empty()) return frames;
  if (std::none_of(image.channels.begin(), image.channels.end(),
                   [](const render::ChannelInfo& one) { return one.lag > 0.0 || one.inertia > 0.0; }))
    throw InputError(
        "frames before were named, and no channel remembers any: give the sensor's detector a 'lag' or a 'time_constant'");
  if (read_out.kind != sensor::ReadOut::Kind::frame)
    throw InputError(
        "frames before were named, and the run's camera scans: what its elements remember are its own lines and samples");
  for (const std::filesystem::path& run : options.after) {
    const std::filesystem::path record = record_of(run);
    std::string name = record.filename().string();
    name.resize(name.size() - kRecordEnding.size());
    frames.push_back(std::make_unique<io::EnviReader>(record.parent_path() / (name + "_radiance.img")));
    session::require_channels(*frames.back(), image.channels, render::ImageInfo().radiance_unit,
                              record.string());
    const io::EnviHeader& header = frames.back()->header();
    if (header.samples != image.width_px || header.lines != image.height_px)
      throw InputError(format("{}: found {} x {} pixels; expected {} x {}, as the frame after it has",
                              record.string(), header.samples, header.lines, image.width_px,
                              image.height_px));
  }
  return frames;
}

/// The document whose channels tell the noise; none: the record's own figures.
std::optional<Document> document_of(const std::filesystem::path& record, const DetectOptions& options) {
  if (options.set.empty()) return options.other;
  if (options.other)
    throw InputError(
        "values to set go with the document that the run's record holds, or into the other document");
  return written_document(record, options.set);
}

/// Of a run's elements.
std::shared_ptr<const sensor::Mosaic> mosaic_of(const std::filesystem::path& record, std::size_t channels) {
  const session::RunRecordFile file(record);
  const session::Record told = file.root()["image"]["mosaic"];
  if (!told.is_there())
    throw InputError(
        format("{}: the run's sensor has no \"mosaic\": every element sees all channels", record.string()));
  auto mosaic = std::make_shared<sensor::Mosaic>();
  mosaic->columns = told["columns"].small_integer();
  for (const session::Record& channel : told["channels"].items())
    mosaic->channels.push_back(channel.small_integer());
  const auto exists = [&](int channel) { return channel >= 0 && channel < static_cast<int>(channels); };
  if (mosaic->columns < 1 || mosaic->channels.empty() ||
      mosaic->channels.size() % static_cast<std::size_t>(mosaic->columns) != 0 ||
      !std::all_of(mosaic->channels.begin(), mosaic->channels.end(), exists))
    throw InputError(
        format("{}: image.mosaic is damaged: expected a pattern of channels of the run", record.string()));
  mosaic->rows = static_cast<int>(mosaic->channels.size()) / mosaic->columns;
  return mosaic;
}

const char* word_of(DetectedQuantity quantity) {
  switch (quantity) {
    case DetectedQuantity::radiance: return "noisy";
    case DetectedQuantity::electrons: return "electrons";
    case DetectedQuantity::counts: return "counts";
    case DetectedQuantity::kelvins: return "kelvins";
    case DetectedQuantity::toa_reflectance: return "toa_reflectance";
  }
  return "noisy";
}

}  // namespace

Detection detect(const std::filesystem::path& run, const DetectOptions& options) {
  if (options.realizations < 1)
    throw InputError(format("{} realizations were asked for; at least 1 is", options.realizations));
  if (options.threads < 0)
    throw InputError(format("threads: {} was asked for; 0 takes all cores", options.threads));
  const std::filesystem::path record = record_of(run);
  const std::optional<Document> other = document_of(record, options);
  std::vector<render::ChannelInfo> channels = other ? channels_of(*other) : channels_of(record);
  std::string name = record.filename().string();
  name.resize(name.size() - kRecordEnding.size());
  const io::EnviReader radiance(record.parent_path() / (name + "_radiance.img"));
  session::require_channels(radiance, channels, render::ImageInfo().radiance_unit,
                            other ? other->name() : record.string());
  tell_sunlight(record, channels);
  for (const DetectedQuantity quantity : options.quantities)
    session::require_quantity(quantity, channels, other ? other->name() : record.string());

  render::ImageInfo image;
  image.width_px = radiance.header().samples, image.height_px = radiance.header().lines;
  image.channels = channels;
  tell_responses(record, other, options, image);
  if (options.mosaic) image.mosaic = mosaic_of(record, channels.size());
  session::SignalSource source{&radiance, {}, read_out_of(record, channels)};
  const auto before = earlier_frames(options, source.read_out, image);
  for (const auto& frame : before) source.before.push_back(frame.get());
  Detection detection;
  for (const render::ChannelInfo& channel : channels)
    detection.channels.push_back({channel.name, channel.noise, channel.detector != nullptr});
  const std::filesystem::path folder = options.folder.empty() ? record.parent_path() : options.folder;
  const std::uint64_t bytes = 4 * static_cast<std::uint64_t>(radiance.header().samples) *
                              static_cast<std::uint64_t>(radiance.header().lines) *
                              static_cast<std::uint64_t>(radiance.header().bands);
  io::require_space(folder,
                    bytes * static_cast<std::uint64_t>(options.realizations) * options.quantities.size());
  const double pixels =
      static_cast<double>(options.realizations) * radiance.header().samples * radiance.header().lines;
  std::future<void> publishing;  // of one cube, while the next is made
  for (int k = 0; k < options.realizations; ++k) {
    const std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(k);
    std::vector<session::DetectedCube> cubes;
    for (const DetectedQuantity quantity : options.quantities) {
      cubes.push_back({quantity, folder / format("{}_{}{}_{}.img", name, options.mosaic ? "mosaic_" : "",
                                                 word_of(quantity), seed)});
      detection.cubes.push_back(cubes.back().path);
    }
    session::Realization made = session::realize(source, image, seed, cubes, options.threads, options.cancel);
    for (std::size_t c = 0; c < channels.size(); ++c)
      detection.channels[c].saturated += static_cast<double>(made.saturated[c]) / pixels;
    if (publishing.valid()) publishing.get();
    publishing = std::async(std::launch::async, [all = std::move(made.cubes)] {
      for (const auto& cube : all) cube->publish();
    });
  }
  if (publishing.valid()) publishing.get();
  return detection;
}

}  // namespace ifov

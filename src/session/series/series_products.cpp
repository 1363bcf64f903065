#include "session/series/series_products.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/format.h"
#include "geodesy/utc_seconds.h"
#include "io/document/product_words.h"
#include "io/envi/envi_header.h"
#include "io/files/own_files.h"
#include "io/product_parts/picture.h"
#include "io/products/envi_reader.h"
#include "io/series_report/animation.h"
#include "io/series_report/series_report.h"
#include "radiometry/planck.h"
#include "session/runs/run_record_file.h"
#include "session/series/series_record.h"
#include "session/series/series_sun.h"

namespace ifov::session {
namespace {

constexpr float kPure = 0.9F;  // share of a pixel from which on it counts as one material's
constexpr double kThermal_um = 3.0, kUsual_um = 10.5;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A channel whose brightness temperatures are shown.
struct ThermalChannel {
  int band = 0;
  double centre_um = 0.0;
  std::string name;
};

/// The one that the document's picture shows, else the nearest to the middle of the window; nothing where surfaces emit in none.
std::optional<ThermalChannel> thermal_channel(const std::vector<std::string>& shown, const Record& run) {
  if (run["image"]["radiance_unit"].text() != "W m-2 sr-1 um-1") return std::nullopt;
  std::optional<ThermalChannel> best;
  const std::vector<Record> channels = run["channels"].items();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const ThermalChannel channel{static_cast<int>(c), channels[c]["centre_um"].number(),
                                 channels[c]["name"].text()};
    if (channel.centre_um <= kThermal_um) continue;
    if (shown.size() == 1 && shown.front() == channel.name) return channel;
    if (!best || std::abs(channel.centre_um - kUsual_um) < std::abs(best->centre_um - kUsual_um))
      best = channel;
  }
  return best;
}

/// The products of one time.
class ProductsOfTime {
 public:
  ProductsOfTime(const std::filesystem::path& folder, const std::string& name) : stem_(folder / name) {}
  std::filesystem::path cube(const char* word) const { return stem_.string() + "_" + word + ".img"; }
  bool has(const char* word) const {
    std::error_code ignored;
    return std::filesystem::exists(cube(word), ignored);
  }
  io::EnviReader reader(const char* word) const { return io::EnviReader(cube(word)); }
  RunRecordFile record() const { return RunRecordFile(stem_.string() + "_run.json"); }

 private:
  std::filesystem::path stem_;
};

/// Mean and standard deviation of what is counted.
class Tally {
 public:
  void add(double value) {
    if (!std::isfinite(value)) return;
    if (count_ == 0) first_ = value;
    ++count_;
    sum_ += value - first_, squares_ += (value - first_) * (value - first_);
  }
  std::size_t count() const { return count_; }
  void put(io::SeriesReport::Means& means) const {
    const double n = static_cast<double>(count_);
    means.mean_k.push_back(count_ > 0 ? first_ + sum_ / n : kNone);
    means.deviation_k.push_back(count_ > 0 ? std::sqrt(std::max(0.0, squares_ / n - sum_ / n * sum_ / n))
                                           : kNone);
  }

 private:
  std::size_t count_ = 0;
  double first_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

/// Adds what one time's products tell of each material; `report.materials` are those of the abundances.
void add_time(const ProductsOfTime& products, const ThermalChannel& channel, io::SeriesReport& report) {
  const io::EnviReader radiance = products.reader("radiance"), abundance = products.reader("abundance");
  const std::optional<io::EnviReader> temperature =
      report.tells_surface ? std::optional<io::EnviReader>(products.reader("temperature")) : std::nullopt;
  const auto width = static_cast<std::size_t>(radiance.header().samples);
  std::vector<float> light(width), share(width), kelvin(width, std::numeric_limits<float>::quiet_NaN());
  std::vector<Tally> brightness(report.materials.size()), surface(report.materials.size());
  for (int line = 0; line < radiance.header().lines; ++line) {
    radiance.read(line, channel.band, light);
    if (temperature) temperature->read(line, 0, kelvin);
    for (std::size_t m = 0; m < report.materials.size(); ++m) {
      abundance.read(line, static_cast<int>(m), share);
      for (std::size_t x = 0; x < width; ++x) {
        if (!(share[x] >= kPure) || !std::isfinite(light[x])) continue;
        brightness[m].add(radiometry::brightness_temperature_k(channel.centre_um, light[x]));
        surface[m].add(kelvin[x]);
      }
    }
  }
  for (std::size_t m = 0; m < report.materials.size(); ++m) {
    io::SeriesReport::Material& material = report.materials[m];
    material.pixels.push_back(brightness[m].count());
    brightness[m].put(material.brightness);
    if (temperature) surface[m].put(material.surface);
  }
}

/// Lowest and highest of what pictures show, over all times.
io::Range common_range(const std::vector<ProductsOfTime>& times, const ThermalChannel& channel) {
  io::Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const ProductsOfTime& products : times) {
    const io::EnviReader radiance = products.reader("radiance");
    io::Layer layer =
        io::averaged_layer(radiance.view(), channel.band,
                           io::averaging_factor(radiance.header().samples, radiance.header().lines));
    io::to_brightness_temperature_k(layer, channel.centre_um);
    const io::Range own = io::percentiles(layer, io::kLowShare, io::kHighShare);
    range.low = std::min(range.low, own.low), range.high = std::max(range.high, own.high);
  }
  return range.high > range.low ? range : io::Range{range.low - 0.5, range.low + 0.5};
}

/// "2025-06-20 06:15 UTC".
std::string printed(std::string time) {
  if (const std::size_t t = time.find('T'); t != std::string::npos) time[t] = ' ';
  if (time.ends_with('Z')) time.pop_back();
  return time + " UTC";
}

}  // namespace

SeriesFiles make_series_products(const MadeSeries& of, LogSink* log) {
  const std::filesystem::path& folder = of.folder;
  const SeriesRecord& series = of.record;
  SeriesFiles made;
  const auto left_out = [&](const std::string& why) {
    if (log != nullptr) log->info(why);
  };
  std::vector<ProductsOfTime> times;
  for (const SeriesRecord::One& one : series.times) times.emplace_back(folder / one.folder, series.name);
  const auto channel = thermal_channel(of.shown_channels, times.front().record().root());
  if (!channel || of.is_of_views || !times.front().has("radiance")) {
    left_out("no animation and no crossovers: no channel beyond 3 um whose radiance tells a temperature");
    return made;
  }
  const auto keep = [&](const char* ending, const std::string& bytes, std::string what) {
    const std::filesystem::path path = folder / (series.name + ending);
    io::write_new_file(path, bytes);
    made.files.push_back({path, std::move(what)});
  };
  const std::string told = format("{} ({:.4g} \u00b5m)", channel->name, channel->centre_um);
  const std::string why_no_figures = io::why_not_built("png");
  const std::string name = std::filesystem::path(series.document).filename().string();
  if (why_no_figures.empty()) {
    io::Animation animation{format("{}: brightness temperature, {}", name, told), "K", {}, {}, {}};
    for (const SeriesRecord::One& one : series.times) animation.times.push_back(printed(one.time));
    animation.range = common_range(times, *channel);
    animation.layer = [&](std::size_t t) {
      const io::EnviReader radiance = times[t].reader("radiance");
      io::Layer layer =
          io::averaged_layer(radiance.view(), channel->band,
                             io::averaging_factor(radiance.header().samples, radiance.header().lines));
      io::to_brightness_temperature_k(layer, channel->centre_um);
      return layer;
    };
    keep("_animation.gif", io::make_animation(animation),
         format("brightness temperature, {} times, GIF", times.size()));
  } else {
    left_out(why_no_figures);
  }

  if (!times.front().has("abundance")) {
    left_out("no crossovers: they need the product 'abundance'");
    return made;
  }
  io::SeriesReport report;
  report.document = name;
  report.channel = told;
  report.tells_surface = times.front().has("temperature");
  const io::EnviHeader abundances = times.front().reader("abundance").header();
  for (const std::string& material : abundances.band_names)
    report.materials.push_back({material, {}, {}, {}});
  for (const SeriesRecord::One& one : series.times)
    report.time_s.push_back(geodesy::seconds_after(geodesy::parse_utc(one.time), {2440587.5, 0.0}));
  for (const ProductsOfTime& products : times) add_time(products, *channel, report);
  std::erase_if(report.materials, [](const auto& material) {
    return std::all_of(material.pixels.begin(), material.pixels.end(), [](std::size_t n) { return n == 0; });
  });
  report.notes.push_back(
      format("means over the pixels of which a material has {:.0f} % or more{}", 100.0 * kPure,
             report.tells_surface ? "; curves and crossovers are of the surfaces' own temperatures"
                                  : format("; brightness temperatures of {}", told)));
  if (report.materials.empty()) {
    left_out("no crossovers: no pixel is of one material alone");
    return made;
  }
  report.crossovers = io::crossovers_of(report);
  if (of.place) tell_of_sun(*of.place, report);
  keep("_crossovers.csv", io::series_csv(report),
       format("temperatures of {} materials, CSV", report.materials.size()));
  if (why_no_figures.empty())
    keep("_crossovers.png", io::series_figure(report),
         format("{} crossovers, PNG", report.crossovers.size()));
  return made;
}

}  // namespace ifov::session

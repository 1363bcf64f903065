#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/format.h"
#include "core/overloaded.h"
#include "io/document/detector_document.h"
#include "io/document/schema/record.h"
#include "io/document/schema/shared_target.h"
#include "io/document/sensor_document.h"
#include "io/document/spectrometer_document.h"
#include "io/document/tables/spectrometer_tables.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostChannels = 20000;
constexpr double kNanometresUpTo_um = 3.0;

using Response = decltype(ChannelDocument::response);

/// One entry of the document's list: one channel, or a series of them.
struct ChannelEntry {
  std::string name;
  std::vector<Response> responses;
  SourcePosition position;
  std::optional<SpectrumDocument> noise;
  std::optional<double> noise_k;
  std::optional<PolarizerDocument> polarizer;
  std::optional<RetarderDocument> retarder;
  std::shared_ptr<const SnrDocument> snr;
  std::shared_ptr<const DetectorDocument> detector;
  std::optional<std::array<double, 2>> shift_px;
  std::shared_ptr<const SmileDocument> smile;
  std::shared_ptr<const KeystoneDocument> keystone;
};

SchemaType<double> wavelength() { return quantity(kWavelength, Range::above(0.0, "um")); }

SchemaType<GaussianChannel> gaussian_type() {
  Record<GaussianChannel> record("Gaussian channel", "A response in the shape of a bell.");
  record.required("center", &GaussianChannel::centre_um, wavelength(), "its centre")
      .required("fwhm", &GaussianChannel::fwhm_um, wavelength(), "full width at half maximum");
  return record.type();
}

void check_rising(const DocumentNode& node, double from, double to) {
  if (!(to > from)) node.given("to").fail(format("{} is not above 'from'", node.given("to").title()));
}

SchemaType<TopHatChannel> top_hat_type() {
  Record<TopHatChannel> record("top-hat channel", "The same response from one wavelength to another.");
  record.required("from", &TopHatChannel::from_um, wavelength(), "where it begins")
      .required("to", &TopHatChannel::to_um, wavelength(), "where it ends")
      .check(
          [](const TopHatChannel& c, const DocumentNode& node) { check_rising(node, c.from_um, c.to_um); });
  return record.type();
}

SchemaType<MonochromaticChannel> monochromatic_type() {
  Record<MonochromaticChannel> record("monochromatic channel", "Spectral radiance at one wavelength.");
  record.required("at", &MonochromaticChannel::at_um, wavelength(), "the wavelength");
  return record.type();
}

SchemaType<TabulatedChannel> tabulated_channel_type() {
  Record<TabulatedChannel> record(
      "tabulated channel", "A relative response from a file: columns of numbers with the wavelength first.");
  record.required("file", &TabulatedChannel::file, file(), "the file")
      .required("wavelength_unit", &TabulatedChannel::um_per_unit, um_per_unit_type(),
                "unit of the wavelength column")
      .with_default("column", &TabulatedChannel::column, integer(2, 100000), "2",
                    "column of the response, counted from 1")
      .optional("band", &TabulatedChannel::band, label(),
                "which block of a file with several, named in lines such as ';; BAND 1'");
  return record.type();
}

SchemaType<PolarizerDocument> polarizer_type() {
  Record<PolarizerDocument> record("polarizer", "A linear polarizer before the channel.");
  record
      .required(
          "angle", &PolarizerDocument::angle_rad, quantity(kAngle, Range::between(-360.0, 360.0, "deg")),
          "of the axis along which light swings that is let through: from the image's right, counterclockwise as the image is looked at")
      .with_default(
          "extinction", &PolarizerDocument::extinction, number(Range::between(1.0, 1e9)), "10000",
          "how many times as much of it is let through as of light that swings across; 1 polarizes nothing");
  return record.type();
}

SchemaType<RetarderDocument> retarder_type() {
  Record<RetarderDocument> record("retarder", "A wave plate before the channel and its polarizer.");
  record
      .required("retardance", &RetarderDocument::retardance_rad,
                quantity(kAngle, Range::between(-360.0, 360.0, "deg")),
                "phase by which light along the slow axis falls behind: 90 deg of a quarter-wave plate")
      .required("angle", &RetarderDocument::angle_rad, quantity(kAngle, Range::between(-360.0, 360.0, "deg")),
                "of the slow axis, counted as a polarizer's");
  return record.type();
}

struct GaussianSeries {
  double from_um = 0.0, to_um = 0.0, fwhm_um = 0.0;
  int count = 0;
};

std::vector<Response> channels_of(const GaussianSeries& series) {
  std::vector<Response> channels;
  for (int i = 0; i < series.count; ++i) {
    const double share = static_cast<double>(i) / (series.count - 1);
    channels.push_back(
        GaussianChannel{series.from_um + share * (series.to_um - series.from_um), series.fwhm_um});
  }
  return channels;
}

/// The series that has exactly these channels.
std::optional<GaussianSeries> series_of(const std::vector<Response>& channels) {
  const auto is = [&](const GaussianSeries& series) {
    const std::vector<Response> made = channels_of(series);
    return std::equal(
        made.begin(), made.end(), channels.begin(), channels.end(), [](const Response& a, const Response& b) {
          const auto *one = std::get_if<GaussianChannel>(&a), *other = std::get_if<GaussianChannel>(&b);
          return other != nullptr && one->centre_um == other->centre_um && one->fwhm_um == other->fwhm_um;
        });
  };
  const auto* first = channels.size() < 2 ? nullptr : std::get_if<GaussianChannel>(&channels.front());
  const auto* last = channels.size() < 2 ? nullptr : std::get_if<GaussianChannel>(&channels.back());
  if (first == nullptr || last == nullptr) return std::nullopt;
  // The last centre may have been rounded away from where the series says that it ends.
  for (const double end_um : {last->centre_um, std::nextafter(last->centre_um, 0.0),
                              std::nextafter(last->centre_um, 2.0 * last->centre_um)}) {
    const GaussianSeries series{first->centre_um, end_um, first->fwhm_um, static_cast<int>(channels.size())};
    if (end_um > first->centre_um && is(series)) return series;
  }
  return std::nullopt;
}

SchemaType<std::vector<Response>> series_type() {
  Record<GaussianSeries> gaussian("Gaussian series", "Channels with centres at equal distances.");
  gaussian.required("from", &GaussianSeries::from_um, wavelength(), "centre of the first")
      .required("to", &GaussianSeries::to_um, wavelength(), "centre of the last")
      .required("count", &GaussianSeries::count, integer(2, kMostChannels), "how many")
      .required("fwhm", &GaussianSeries::fwhm_um, wavelength(), "full width at half maximum of each")
      .check(
          [](const GaussianSeries& s, const DocumentNode& node) { check_rising(node, s.from_um, s.to_um); });
  const auto spread = converted<std::vector<Response>>(gaussian.type(), channels_of, series_of);
  struct Holder {
    std::vector<Response> channels;
  };
  Record<Holder> record("channel series", "Many channels in one entry.");
  record.exactly_one().one("gaussian", &Holder::channels, spread, "Gaussian channels");
  return converted<std::vector<Response>>(
      record.type(), [](Holder holder) { return std::move(holder.channels); },
      [](const std::vector<Response>& channels) { return Holder{channels}; });
}

/// The response of an entry with one channel, where it is of this kind.
template <class Channel>
auto response_of() {
  return via([](ChannelEntry& entry, Channel channel) { entry.responses.emplace_back(std::move(channel)); },
             [](const ChannelEntry& entry) {
               return entry.responses.size() == 1 ? std::get_if<Channel>(&entry.responses.front()) : nullptr;
             });
}

SchemaType<ChannelEntry> entry_type() {
  Record<ChannelEntry> record("channel", "A channel, or a series of channels.");
  record
      .optional("name", &ChannelEntry::name, label(),
                "its name; of a series, the beginning of the names. Without it the wavelength")
      .exactly_one()
      .one("gaussian", response_of<GaussianChannel>(), gaussian_type(), "a bell")
      .one("top_hat", response_of<TopHatChannel>(), top_hat_type(), "a rectangle")
      .one("tabulated", response_of<TabulatedChannel>(), tabulated_channel_type(), "from a file")
      .one("monochromatic", response_of<MonochromaticChannel>(), monochromatic_type(), "one wavelength")
      .one("series", &ChannelEntry::responses, series_type(), "many at once")
      .at_most_one()
      .one(
          "noise", &ChannelEntry::noise, spectrum_type(SpectrumOf::radiance),
          "standard deviation of the sensor's noise as a radiance at the centre of the channel (NEdL); for errors stated in its unit")
      .one("noise_temperature", &ChannelEntry::noise_k,
           quantity(kTemperatureDifference, Range::above(0.0, "K")),
           "the same as a temperature difference of a black surface of 300 K (NEdT)")
      .one("snr", shared(&ChannelEntry::snr), snr_type(), "the same as a signal-to-noise ratio at a radiance")
      .optional("polarizer", &ChannelEntry::polarizer, polarizer_type(),
                "what stands before it; the channel's radiance is what is let through")
      .optional("retarder", &ChannelEntry::retarder, retarder_type(), "what stands before the polarizer")
      .optional("detector", shared(&ChannelEntry::detector), detector_type(),
                "what its detector has of its own, in place of the sensor's")
      .optional(
          "shift", &ChannelEntry::shift_px,
          tuple<double, 2>(quantity(kPixels, Range::between(-8.0, 8.0, "px"))),
          "of what its pixels respond to, right and down on the focal plane: bands that do not lie on each other")
      .optional("smile", shared(&ChannelEntry::smile), smile_type(false),
                "how its response differs from detector column to detector column; the sensor's if not given")
      .optional(
          "keystone", shared(&ChannelEntry::keystone), keystone_type(false),
          "how far across the track what its elements see lies from them, by column; the sensor's if not given");
  return record.type();
}

std::string wavelength_text(double um) {
  return um < kNanometresUpTo_um ? format("{:.6g} nm", 1e3 * um) : format("{:.6g} um", um);
}

std::string name_from(const Response& response) {
  return std::visit(Overloaded{[](const GaussianChannel& c) { return wavelength_text(c.centre_um); },
                               [](const MonochromaticChannel& c) { return wavelength_text(c.at_um); },
                               [](const TopHatChannel& c) {
                                 return format("{} to {}", wavelength_text(c.from_um),
                                               wavelength_text(c.to_um));
                               },
                               [](const TabulatedChannel& c) {
                                 const std::string& path = c.file.path;
                                 return c.band.empty() ? path.substr(path.find_last_of('/') + 1) : c.band;
                               }},
                    response);
}

/// What the name of a channel says beyond its response: all of it, or what a series puts before it.
std::string own_name(const ChannelDocument& channel) {
  const std::string own = name_from(channel.response);
  return channel.name == own ? "" : channel.name;
}
std::string name_in_series(const ChannelDocument& channel) {
  const std::string own = name_from(channel.response);
  if (channel.name == own) return "";
  const bool has_both = channel.name.size() > own.size() + 1 && channel.name.ends_with(" " + own);
  return has_both ? channel.name.substr(0, channel.name.size() - own.size() - 1) : channel.name;
}

/// The entries of a document for its channels: series where three or more of them make one.
class ChannelEntries {
 public:
  ChannelEntries(const std::vector<ChannelDocument>& channels, Writing& writing) : channels_(channels) {
    const SchemaType<SpectrumDocument> noise = spectrum_type(SpectrumOf::radiance);
    const SchemaType<SnrDocument> snr = snr_type();
    const SchemaType<DetectorDocument> detector = detector_type();
    const SchemaType<SmileDocument> smile = smile_type(false);
    const SchemaType<KeystoneDocument> keystone = keystone_type(false);
    for (const ChannelDocument& channel : channels)
      sensors_.push_back({channel.noise ? noise.write(*channel.noise, writing) : std::nullopt,
                          channel.snr ? snr.write(*channel.snr, writing) : std::nullopt,
                          channel.detector ? detector.write(*channel.detector, writing) : std::nullopt,
                          channel.smile ? smile.write(*channel.smile, writing) : std::nullopt,
                          channel.keystone ? keystone.write(*channel.keystone, writing) : std::nullopt});
  }

  std::vector<ChannelEntry> all() const {
    std::vector<ChannelEntry> entries;
    for (std::size_t from = 0; from < channels_.size();) {
      const std::size_t to = end_of_series(from);
      ChannelEntry series = entry_of(from, name_in_series(channels_[from]));
      for (std::size_t k = from + 1; k < to; ++k) series.responses.push_back(channels_[k].response);
      if (to - from > 2 && series_of(series.responses)) {
        entries.push_back(std::move(series));
      } else {
        for (std::size_t k = from; k < to; ++k) entries.push_back(entry_of(k, own_name(channels_[k])));
      }
      from = to;
    }
    return entries;
  }

 private:
  ChannelEntry entry_of(std::size_t k, std::string name) const {
    ChannelEntry entry;
    entry.name = std::move(name);
    entry.responses.push_back(channels_[k].response);
    entry.noise = channels_[k].noise;
    entry.noise_k = channels_[k].noise_k;
    entry.polarizer = channels_[k].polarizer;
    entry.retarder = channels_[k].retarder;
    entry.snr = channels_[k].snr;
    entry.detector = channels_[k].detector;
    entry.shift_px = channels_[k].shift_px;
    entry.smile = channels_[k].smile;
    entry.keystone = channels_[k].keystone;
    return entry;
  }

  /// Behind the last channel that goes on, as far as can be seen, what the one at `from` begins.
  std::size_t end_of_series(std::size_t from) const {
    constexpr double kSame = 1e-9;
    const auto centre = [&](std::size_t k) {
      const auto* gaussian = std::get_if<GaussianChannel>(&channels_[k].response);
      return gaussian != nullptr ? gaussian->centre_um : std::numeric_limits<double>::quiet_NaN();
    };
    std::size_t end = from + 1;
    for (; end < channels_.size(); ++end) {
      const double step_um = centre(from + 1) - centre(from);
      const double expected_um = centre(from) + static_cast<double>(end - from) * step_um;
      if (!(std::abs(centre(end) - expected_um) <= kSame * centre(end)) || sensors_[end] != sensors_[from] ||
          channels_[end].noise_k != channels_[from].noise_k ||
          channels_[end].polarizer != channels_[from].polarizer ||
          channels_[end].retarder != channels_[from].retarder ||
          channels_[end].shift_px != channels_[from].shift_px ||
          name_in_series(channels_[end]) != name_in_series(channels_[from]))
        break;
    }
    return end;
  }

  const std::vector<ChannelDocument>& channels_;
  std::vector<std::array<Written, 5>> sensors_;  // noise, ratio, detector, smile and keystone of each
};

}  // namespace

SchemaType<std::vector<ChannelDocument>> channels_type() {
  const SchemaType<ChannelEntry> entry_of = entry_type();
  const auto entries = list(entry_of, 1, kMostChannels);
  return {entries.description,
          [description = entries.description, read = entry_of.read](const DocumentNode& node) {
            check_list(node, *description);
            std::vector<ChannelDocument> channels;
            for (const DocumentNode& item : node.items()) {
              ChannelEntry entry = read(item);
              if (channels.size() + entry.responses.size() > kMostChannels) {
                item.fail(format("{} brings the number of channels above {}", item.title(), kMostChannels));
              }
              const bool series = entry.responses.size() > 1;
              for (Response& response : entry.responses) {
                const std::string own = name_from(response);
                const std::string name = entry.name.empty() ? own
                                         : series           ? format("{} {}", entry.name, own)
                                                            : entry.name;
                channels.push_back({name, std::move(response), entry.position, entry.noise, entry.noise_k,
                                    entry.polarizer, entry.retarder, entry.snr, entry.detector,
                                    entry.shift_px, entry.smile, entry.keystone});
              }
            }
            return channels;
          },
          [write = entries.write](const std::vector<ChannelDocument>& channels, Writing& writing) {
            return write(ChannelEntries(channels, writing).all(), writing);
          }};
}

}  // namespace ifov::io

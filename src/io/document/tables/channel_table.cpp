#include "core/format.h"
#include "core/overloaded.h"
#include "io/document/schema/record.h"
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
};

Kind<double> wavelength() { return quantity(kWavelength, Range::above(0.0, "um")); }

Kind<GaussianChannel> gaussian_kind() {
  Record<GaussianChannel> record("Gaussian channel", "A response in the shape of a bell.");
  record.required("center", &GaussianChannel::centre_um, wavelength(), "its centre")
      .required("fwhm", &GaussianChannel::fwhm_um, wavelength(), "full width at half maximum");
  return record.kind();
}

void check_rising(const DocumentNode& node, double from, double to) {
  if (!(to > from)) node.given("to").fail(format("{} is not above 'from'", node.given("to").title()));
}

Kind<TopHatChannel> top_hat_kind() {
  Record<TopHatChannel> record("top-hat channel", "The same response from one wavelength to another.");
  record.required("from", &TopHatChannel::from_um, wavelength(), "where it begins")
      .required("to", &TopHatChannel::to_um, wavelength(), "where it ends")
      .check(
          [](const TopHatChannel& c, const DocumentNode& node) { check_rising(node, c.from_um, c.to_um); });
  return record.kind();
}

Kind<MonochromaticChannel> monochromatic_kind() {
  Record<MonochromaticChannel> record("monochromatic channel", "Spectral radiance at one wavelength.");
  record.required("at", &MonochromaticChannel::at_um, wavelength(), "the wavelength");
  return record.kind();
}

Kind<TabulatedChannel> tabulated_kind() {
  Record<TabulatedChannel> record(
      "tabulated channel", "A relative response from a file: columns of numbers with the wavelength first.");
  record.required("file", &TabulatedChannel::file, file(), "the file")
      .required("wavelength_unit", &TabulatedChannel::um_per_unit, um_per_unit_kind(),
                "unit of the wavelength column")
      .with_default("column", &TabulatedChannel::column, integer(2, 100000), "2",
                    "column of the response, counted from 1")
      .optional("band", &TabulatedChannel::band, label(),
                "which block of a file with several, named in lines such as ';; BAND 1'");
  return record.kind();
}

struct GaussianSeries {
  double from_um = 0.0, to_um = 0.0, fwhm_um = 0.0;
  int count = 0;
};

Kind<std::vector<Response>> series_kind() {
  Record<GaussianSeries> gaussian("Gaussian series", "Channels with centres at equal distances.");
  gaussian.required("from", &GaussianSeries::from_um, wavelength(), "centre of the first")
      .required("to", &GaussianSeries::to_um, wavelength(), "centre of the last")
      .required("count", &GaussianSeries::count, integer(2, kMostChannels), "how many")
      .required("fwhm", &GaussianSeries::fwhm_um, wavelength(), "full width at half maximum of each")
      .check(
          [](const GaussianSeries& s, const DocumentNode& node) { check_rising(node, s.from_um, s.to_um); });
  const auto spread = converted<std::vector<Response>>(gaussian.kind(), [](const GaussianSeries& series) {
    std::vector<Response> channels;
    for (int i = 0; i < series.count; ++i) {
      const double share = static_cast<double>(i) / (series.count - 1);
      channels.push_back(
          GaussianChannel{series.from_um + share * (series.to_um - series.from_um), series.fwhm_um});
    }
    return channels;
  });
  struct Holder {
    std::vector<Response> channels;
  };
  Record<Holder> record("channel series", "Many channels in one entry.");
  record.exactly_one().one("gaussian", &Holder::channels, spread, "Gaussian channels");
  return converted<std::vector<Response>>(record.kind(),
                                          [](Holder holder) { return std::move(holder.channels); });
}

Kind<ChannelEntry> entry_kind() {
  const auto store = [](ChannelEntry& entry, auto response) {
    entry.responses.emplace_back(std::move(response));
  };
  Record<ChannelEntry> record("channel", "A channel, or a series of channels.");
  record
      .optional("name", &ChannelEntry::name, label(),
                "its name; of a series, the beginning of the names. Without it the wavelength")
      .exactly_one()
      .one("gaussian", store, gaussian_kind(), "a bell")
      .one("top_hat", store, top_hat_kind(), "a rectangle")
      .one("tabulated", store, tabulated_kind(), "from a file")
      .one("monochromatic", store, monochromatic_kind(), "one wavelength")
      .one("series", &ChannelEntry::responses, series_kind(), "many at once")
      .at_most_one()
      .one(
          "noise", &ChannelEntry::noise, spectrum_kind(SpectrumOf::radiance),
          "standard deviation of the sensor's noise as a radiance at the centre of the channel (NEdL); for errors stated in its unit")
      .one("noise_temperature", &ChannelEntry::noise_k,
           quantity(kTemperatureDifference, Range::above(0.0, "K")),
           "the same as a temperature difference of a black surface of 300 K (NEdT)");
  return record.kind();
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

}  // namespace

Kind<std::vector<ChannelDocument>> channels_kind() {
  const auto entries = list(entry_kind(), 1, kMostChannels);
  return {entries.description,
          [description = entries.description, read = entry_kind().read](const DocumentNode& node) {
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
                channels.push_back({name, std::move(response), entry.position, entry.noise, entry.noise_k});
              }
            }
            return channels;
          }};
}

}  // namespace ifov::io

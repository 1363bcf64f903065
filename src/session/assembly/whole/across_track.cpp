#include "session/assembly/whole/across_track.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/spectrometer_document.h"
#include "io/tables/column_table.h"
#include "sensor/detector/mosaic.h"
#include "sensor/spectrometer/column_responses.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

using radiometry::Channel;

/// As far as a response may lie from where its channel is told to have it, in its widths; and as wide as it may be.
constexpr double kFarthest = 2.0, kNarrowest = 0.25, kWidest = 4.0;
constexpr double kFarthest_px = 8.0;

/// Where the middle of a column lies across the track: -1 at the first one's outer side, 1 at the last one's.
double place_across(int column, int width_px) { return (2.0 * column + 1.0) / width_px - 1.0; }

double value_at(const std::vector<double>& coefficients, double u) {
  double value = 0.0;
  for (std::size_t k = coefficients.size(); k-- > 0;) value = value * u + coefficients[k];
  return value;
}

/// Where a channel stands between the shortest wavelength and the longest.
class ByWavelength {
 public:
  explicit ByWavelength(const std::vector<Channel>& channels) {
    for (const Channel& channel : channels) {
      first_ = std::min(first_, channel.centre_um);
      last_ = std::max(last_, channel.centre_um);
    }
  }
  double between(const Channel& channel, double shortest, double longest) const {
    const double share = last_ > first_ ? (channel.centre_um - first_) / (last_ - first_) : 0.0;
    return shortest + share * (longest - shortest);
  }

 private:
  double first_ = INFINITY, last_ = 0.0;
};

/// What turns about an axis has no detector columns across the image.
void check_columns(const io::DocumentSources& sources, const SourcePosition& position, const char* what,
                   const io::SensorDocument& sensor) {
  if (sensor.camera.settings == nullptr || !sensor.camera.settings->sweeps()) return;
  throw io::document_error(
      sources, position,
      format("{} is of detector columns across the track, and those of the image of a {} camera are samples "
             "of its sweep, alike in all; expected a pushbroom, frame or orthographic camera",
             what, sensor.camera.model));
}

class SmileAssembly {
 public:
  SmileAssembly(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                const std::vector<Channel>& channels, int width_px)
      : sources_(sources), sensor_(sensor), channels_(channels), width_(width_px), by_wavelength_(channels) {}

  std::shared_ptr<const sensor::ColumnResponses> made() {
    const auto of = [&](std::size_t c) {
      return (sensor_.channels[c].smile ? sensor_.channels[c].smile : sensor_.smile).get();
    };
    if (sensor_.smile && sensor_.smile->table) read(*sensor_.smile);
    std::vector<sensor::ChannelColumns> columns(channels_.size());
    SourcePosition position;
    bool any = false;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      if (of(c) == nullptr) continue;
      check_columns(sources_, of(c)->position, "smile", sensor_);
      if (channels_[c].is_monochromatic())
        throw io::document_error(
            sources_, of(c)->position,
            format("channel '{}' is a single wavelength, and smile is of responses: expected one that has a "
                   "width ('gaussian', 'top_hat' or 'tabulated')",
                   channels_[c].name));
      position = of(c)->position;
      columns[c] = columns_of(c, *of(c));
      any = true;
    }
    if (!any) return nullptr;
    return with_position(sources_, position, [&] {
      return std::make_shared<const sensor::ColumnResponses>(
          sensor::ColumnResponses::find(channels_, columns));
    });
  }

 private:
  sensor::ChannelColumns columns_of(std::size_t c, const io::SmileDocument& smile) const {
    const Channel& channel = channels_[c];
    sensor::ChannelColumns columns;
    for (int i = 0; i < width_; ++i) {
      const double u = place_across(i, width_);
      const auto differs = [&](std::vector<double> io::SmilePolynomial::*which) {
        if (smile.polynomial) return value_at((*smile.polynomial).*which, u);
        return by_wavelength_.between(channel, value_at(smile.between->shortest.*which, u),
                                      value_at(smile.between->longest.*which, u));
      };
      const auto at = static_cast<std::size_t>(i);
      columns.centre_um.push_back(smile.table ? centres_[c][at]
                                              : channel.centre_um + differs(&io::SmilePolynomial::centre_um));
      columns.fwhm_um.push_back(!smile.table      ? channel.fwhm_um + differs(&io::SmilePolynomial::fwhm_um)
                                : widths_.empty() ? channel.fwhm_um
                                                  : widths_[c][at]);
      check(channel, smile, i, columns.centre_um.back(), columns.fwhm_um.back());
    }
    return columns;
  }

  void check(const Channel& channel, const io::SmileDocument& smile, int column, double centre_um,
             double fwhm_um) const {
    const double far_um = kFarthest * channel.fwhm_um;
    if (!(std::abs(centre_um - channel.centre_um) <= far_um))
      throw io::document_error(
          sources_, smile.position,
          format("smile takes channel '{}' of {:.6g} um, {:.4g} um wide, to {:.6g} um in column {}; expected "
                 "{:.6g} to {:.6g} um, {:g} widths to either side",
                 channel.name, channel.centre_um, channel.fwhm_um, centre_um, column + 1,
                 channel.centre_um - far_um, channel.centre_um + far_um, kFarthest));
    if (!(fwhm_um >= kNarrowest * channel.fwhm_um && fwhm_um <= kWidest * channel.fwhm_um))
      throw io::document_error(
          sources_, smile.position,
          format("smile makes channel '{}', {:.4g} um wide, {:.4g} um wide in column {}; expected {:.4g} to "
                 "{:.4g} um, from {:g} to {:g} times as wide",
                 channel.name, channel.fwhm_um, fwhm_um, column + 1, kNarrowest * channel.fwhm_um,
                 kWidest * channel.fwhm_um, kNarrowest, kWidest));
  }

  void read(const io::SmileDocument& smile) {
    const io::SmileTable& table = *smile.table;
    const double um = table.um_per_unit;
    const auto numbers = [&](const io::ColumnTable& from, const char* what, const auto& lowest,
                             const auto& highest) {
      return with_position(sources_, from.file.position, [&] {
        std::vector<io::ChannelRange> ranges;
        for (const Channel& channel : channels_)
          ranges.push_back({channel.name, lowest(channel) / um, highest(channel) / um});
        auto read = io::read_column_table(from.file.path, format("{} ({})", what, um == 1.0 ? "um" : "nm"),
                                          ranges, width_);
        for (std::vector<double>& of_channel : read)
          for (double& value : of_channel) value *= um;
        return read;
      });
    };
    const auto centre = [](double widths) {
      return [widths](const Channel& c) { return c.centre_um + widths * c.fwhm_um; };
    };
    const auto width = [](double times) { return [times](const Channel& c) { return times * c.fwhm_um; }; };
    centres_ = numbers(table.centres, "centre", centre(-kFarthest), centre(kFarthest));
    if (table.widths)
      widths_ = numbers(*table.widths, "full width at half maximum", width(kNarrowest), width(kWidest));
  }

  const io::DocumentSources& sources_;
  const io::SensorDocument& sensor_;
  const std::vector<Channel>& channels_;
  int width_;
  ByWavelength by_wavelength_;
  std::vector<std::vector<double>> centres_, widths_;  // of a table
};

}  // namespace

std::shared_ptr<const sensor::ColumnResponses> assemble_smile(const io::DocumentSources& sources,
                                                              const io::SensorDocument& sensor,
                                                              const std::vector<Channel>& channels,
                                                              int width_px) {
  return SmileAssembly(sources, sensor, channels, width_px).made();
}

std::vector<std::vector<double>> assemble_keystone(const io::DocumentSources& sources,
                                                   const io::SensorDocument& sensor,
                                                   const std::vector<Channel>& channels, int width_px) {
  std::vector<std::vector<double>> shifts(channels.size()), table;
  const ByWavelength by_wavelength(channels);
  if (sensor.keystone && sensor.keystone->table) {
    const io::DocumentFile& from = sensor.keystone->table->file;
    std::vector<io::ChannelRange> ranges;
    for (const Channel& channel : channels) ranges.push_back({channel.name, -kFarthest_px, kFarthest_px});
    table = with_position(sources, from.position, [&] {
      return io::read_column_table(from.path, "keystone (px)", ranges, width_px);
    });
  }
  bool any = false;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto& own = sensor.channels[c].keystone;
    const io::KeystoneDocument* const keystone = own ? own.get() : sensor.keystone.get();
    if (keystone == nullptr) continue;
    check_columns(sources, keystone->position, "keystone", sensor);
    for (int i = 0; i < width_px; ++i) {
      const double u = place_across(i, width_px);
      const double shift =
          keystone->table ? table[c][static_cast<std::size_t>(i)]
          : keystone->polynomial
              ? value_at(keystone->polynomial->shift_px, u)
              : by_wavelength.between(channels[c], value_at(keystone->between->shortest.shift_px, u),
                                      value_at(keystone->between->longest.shift_px, u));
      if (!(std::abs(shift) <= kFarthest_px))
        throw io::document_error(
            sources, keystone->position,
            format(
                "keystone takes channel '{}' by {:.4g} px in column {}; expected {:g} px to either side at most",
                channels[c].name, shift, i + 1, kFarthest_px));
      shifts[c].push_back(shift);
    }
    if (std::all_of(shifts[c].begin(), shifts[c].end(), [](double shift) { return shift == 0.0; }))
      shifts[c].clear();
    any = any || !shifts[c].empty();
  }
  return any ? shifts : std::vector<std::vector<double>>{};
}

std::shared_ptr<const sensor::Mosaic> assemble_mosaic(const io::SensorDocument& sensor) {
  if (!sensor.mosaic) return nullptr;
  auto mosaic = std::make_shared<sensor::Mosaic>();
  mosaic->rows = static_cast<int>(sensor.mosaic->rows.size());
  mosaic->columns = static_cast<int>(sensor.mosaic->rows.front().size());
  for (const std::vector<io::DocumentName>& row : sensor.mosaic->rows)
    for (const io::DocumentName& name : row) {
      const auto found = std::ranges::find(sensor.channels, name.name, &io::ChannelDocument::name);
      mosaic->channels.push_back(static_cast<int>(found - sensor.channels.begin()));
    }
  return mosaic;
}

io::SensorDocument sensor_as_carried(const io::SensorDocument& sensor,
                                     const sensor::ColumnResponses* responses) {
  io::SensorDocument carried = sensor;
  if (responses == nullptr) return carried;
  carried.channels.clear();
  for (std::size_t k = 0; k < responses->carried(); ++k) {
    const std::size_t c = responses->channel_of(k);
    carried.channels.push_back(sensor.channels[c]);
    carried.channels.back().name = (*responses)[c].carried[k - responses->first(c)].name;
  }
  return carried;
}

}  // namespace ifov::session

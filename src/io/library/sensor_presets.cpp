#include "io/library/sensor_presets.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/names.h"
#include "io/json/json_writer.h"
#include "io/tables/text_table.h"
#include "radiometry/channel.h"

namespace ifov::data {
extern const std::string_view sensors_landsat_txt, sensors_sentinel_txt, sensors_terra_txt;
}

namespace ifov::io {
namespace {

class PresetParser {
 public:
  PresetParser(const std::string& table, std::string_view text) : file_(table, std::string(text)) {}

  std::vector<SensorPreset> parse() {
    for (line_ = 1; line_ <= file_.line_count(); ++line_) {
      const std::string_view text = file_.line(line_);
      if (is_blank(text) || text[0] == '#') continue;
      const std::size_t colon = text.find(": ");
      if (colon == std::string_view::npos) fail("expected 'key: value'");
      take(text.substr(0, colon), text.substr(colon + 2));
    }
    return std::move(presets_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { file_.fail(line_, 0, message); }

  void take(std::string_view key, std::string_view value) {
    if (key == "sensor") {
      presets_.emplace_back().name = value;
      return;
    }
    if (presets_.empty()) fail("expected 'sensor: NAME' first");
    SensorPreset& preset = presets_.back();
    if (key == "about")
      preset.about = value;
    else if (key == "source")
      preset.sources.emplace_back(value);
    else if (key == "band")
      preset.bands.push_back(band(split(value, ' ')));
    else
      fail(format("there is no key '{}'", key));
  }

  PresetBand band(const std::vector<Field>& fields) const {
    if (fields.size() != 4 && fields.size() != 7)
      fail("expected NAME from|bell UM UM, and snr RATIO RADIANCE or nedt K AT_K");
    PresetBand band;
    band.name = fields[0].text;
    band.is_bell = word(fields[1].text, "bell", "from");
    band.a_um = number(fields[2].text), band.b_um = number(fields[3].text);
    if (fields.size() == 7) {
      const bool is_snr = word(fields[4].text, "snr", "nedt");
      (is_snr ? band.snr : band.nedt_k) = number(fields[5].text);
      (is_snr ? band.at_w_m2_sr_um : band.at_k) = number(fields[6].text);
    }
    return band;
  }

  /// Whether it is the first of two.
  bool word(std::string_view text, std::string_view first, std::string_view second) const {
    if (text != first && text != second)
      fail(format("expected '{}' or '{}'; found '{}'", first, second, text));
    return text == first;
  }

  double number(std::string_view text) const {
    const std::optional<double> value = number_in(text);
    if (!value || !(*value > 0.0)) fail(format("'{}' is no number above 0", text));
    return *value;
  }

  TextFile file_;
  int line_ = 0;
  std::vector<SensorPreset> presets_;
};

void write_noise(JsonWriter& json, const PresetBand& band) {
  if (band.snr > 0.0)
    json.object("snr", [&] {
      json.member("ratio", band.snr);
      json.member("radiance", format("{:g} W m-2 sr-1 um-1", band.at_w_m2_sr_um));
    });
  else if (band.at_k == PresetBand::kUsual_k)
    json.member("noise_temperature", format("{:g} K", band.nedt_k));
  else if (band.nedt_k > 0.0)
    json.member("noise", format("{:.4g} W m-2 sr-1 um-1", band.nedl_w_m2_sr_um()));
}

}  // namespace

double PresetBand::nedl_w_m2_sr_um() const {
  const radiometry::Channel channel = is_bell ? radiometry::Channel::gaussian(name, a_um, b_um)
                                              : radiometry::Channel::top_hat(name, a_um, b_um);
  return nedt_k * radiometry::channel_planck_slope_w_m2_sr_um_k(channel, at_k);
}

std::vector<SensorPreset> parse_sensor_presets(const std::string& table, std::string_view text) {
  return PresetParser(table, text).parse();
}

std::span<const SensorPreset> sensor_presets() {
  static const std::vector<SensorPreset> presets = [] {
    const std::array<std::pair<const char*, std::string_view>, 3> tables{{
        {"data/sensors/landsat.txt", data::sensors_landsat_txt},
        {"data/sensors/sentinel.txt", data::sensors_sentinel_txt},
        {"data/sensors/terra.txt", data::sensors_terra_txt},
    }};
    std::vector<SensorPreset> all;
    for (const auto& [name, text] : tables) {
      std::vector<SensorPreset> more = parse_sensor_presets(name, text);
      std::move(more.begin(), more.end(), std::back_inserter(all));
    }
    return all;
  }();
  return presets;
}

const SensorPreset& sensor_preset(std::string_view name) {
  std::vector<std::string> names;
  for (const SensorPreset& preset : sensor_presets()) {
    if (lower_case(preset.name) == lower_case(name)) return preset;
    names.push_back(preset.name);
  }
  throw InputError(
      format("there is no preset '{}'{} ({})", name, did_you_mean(name, names), list_names(names, "and")));
}

std::string preset_text(const SensorPreset& preset) {
  JsonWriter json(JsonWriter::Layout::indented);
  json.object([&] {
    json.object("sensor", [&] {
      json.list("channels", [&] {
        for (const PresetBand& band : preset.bands)
          json.object([&] {
            json.member("name", band.name);
            json.object(band.is_bell ? "gaussian" : "top_hat", [&] {
              json.member(band.is_bell ? "center" : "from", format("{:g} um", band.a_um));
              json.member(band.is_bell ? "fwhm" : "to", format("{:g} um", band.b_um));
            });
            write_noise(json, band);
          });
      });
    });
  });
  return json.written();
}

}  // namespace ifov::io

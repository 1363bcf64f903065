#include "io/library/sensor_presets.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <sstream>

#include "core/error.h"
#include "core/names.h"
#include "io/json/json_adapter.h"
#include "io/tables/text_table.h"
#include "radiometry/channel.h"

namespace ifov::data {
extern const std::string_view sensors_landsat_txt, sensors_sentinel_txt, sensors_nasa_txt,
    sensors_commercial_txt, sensors_spectrometers_txt, sensors_cameras_txt;
}

namespace ifov::io {
namespace {

constexpr std::size_t kMostListed = 64;

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
    if (key == "band")
      preset.bands.push_back(band(split(value, ' ')));
    else if (key == "series")
      preset.series.push_back(series(split(value, ' ')));
    else if (key == "noise")
      preset.noise = noise(split(value, ' '));
    else if (std::string* json = json_of(preset, key))
      *json = json_in(value);
    else
      words_of(preset, key, value);
  }

  void words_of(SensorPreset& preset, std::string_view key, std::string_view value) const {
    if (key == "about")
      preset.about = value;
    else if (key == "ground")
      preset.ground = value;
    else if (key == "source")
      preset.sources.emplace_back(value);
    else if (key == "also")
      for (const Field& name : split(value, ';')) preset.also.emplace_back(name.text);
    else
      fail(format("there is no key '{}'", key));
  }

  static std::string* json_of(SensorPreset& preset, std::string_view key) {
    if (key == "optics") return &preset.optics;
    if (key == "detector") return &preset.detector;
    if (key == "mosaic") return &preset.mosaic;
    if (key == "camera") return &preset.camera;
    if (key == "platform") return &preset.platform;
    return nullptr;
  }

  std::string json_in(std::string_view value) const {
    try {
      parse_json(std::string(value), "JSON");
    } catch (const InputError& error) {
      fail(error.what());
    }
    return std::string(value);
  }

  PresetBand band(const std::vector<Field>& fields) const {
    const std::size_t words = fields.size();
    if (words != 4 && words != 6 && words != 7)
      fail(
          "expected NAME from|bell UM UM, and snr RATIO RADIANCE, nedt K AT_K or efficiency ELECTRONS_PER_PHOTON");
    PresetBand band;
    band.name = fields[0].text;
    band.is_bell = word(fields[1].text, "bell", "from");
    band.a_um = number(fields[2].text), band.b_um = number(fields[3].text);
    if (words == 6) {
      word(fields[4].text, "efficiency", "efficiency");
      band.efficiency = number(fields[5].text);
    } else if (words == 7) {
      const bool is_snr = word(fields[4].text, "snr", "nedt");
      (is_snr ? band.snr : band.nedt_k) = number(fields[5].text);
      (is_snr ? band.at_w_m2_sr_um : band.at_k) = number(fields[6].text);
    }
    return band;
  }

  PresetSeries series(const std::vector<Field>& fields) const {
    if (fields.size() != 4) fail("expected FROM TO COUNT FWHM, in um");
    const double count = number(fields[2].text);
    PresetSeries series{number(fields[0].text), number(fields[1].text), number(fields[3].text),
                        static_cast<int>(count)};
    if (!(series.count == count && count >= 2.0))
      fail(format("'{}' is no number of channels from 2 on", fields[2].text));
    if (!(series.to_um > series.from_um))
      fail(format("'{}' is not above '{}'", fields[1].text, fields[0].text));
    return series;
  }

  std::vector<std::pair<double, double>> noise(const std::vector<Field>& fields) const {
    if (fields.size() < 4 || fields.size() % 2 != 0) fail("expected UM RADIANCE, two of them or more");
    std::vector<std::pair<double, double>> table;
    for (std::size_t k = 0; k < fields.size(); k += 2) {
      table.emplace_back(number(fields[k].text), number(fields[k + 1].text));
      if (k > 0 && !(table.back().first > table[table.size() - 2].first))
        fail(format("'{}' is not above the wavelength before it", fields[k].text));
    }
    return table;
  }

  /// Whether it is the first of two.
  bool word(std::string_view text, std::string_view first, std::string_view second) const {
    if (text != first && text != second)
      fail(first == second ? format("expected '{}'; found '{}'", first, text)
                           : format("expected '{}' or '{}'; found '{}'", first, second, text));
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

std::string noise_json(const PresetBand& band) {
  if (band.snr > 0.0)
    return format(R"(, "snr": {{"ratio": {:g}, "radiance": "{:g} W m-2 sr-1 um-1"}})", band.snr,
                  band.at_w_m2_sr_um);
  if (band.at_k == PresetBand::kUsual_k) return format(R"(, "noise_temperature": "{:g} K")", band.nedt_k);
  if (band.nedt_k > 0.0) return format(R"(, "noise": "{:.6g} W m-2 sr-1 um-1")", band.nedl_w_m2_sr_um());
  if (band.efficiency > 0.0)
    return format(R"(, "detector": {{"quantum_efficiency": {:g}}})", band.efficiency);
  return {};
}

std::string channel_json(const PresetBand& band) {
  return format(R"({{"name": "{}", "{}": {{"{}": "{:g} um", "{}": "{:g} um"}}{}}})", band.name,
                band.is_bell ? "gaussian" : "top_hat", band.is_bell ? "center" : "from", band.a_um,
                band.is_bell ? "fwhm" : "to", band.b_um, noise_json(band));
}

/// The part of a table that a series needs: what lies within, and a point to each side.
std::string noise_json(const std::vector<std::pair<double, double>>& table, const PresetSeries& series) {
  if (table.empty()) return {};
  const auto above = std::ranges::upper_bound(table, series.from_um, {}, &std::pair<double, double>::first);
  auto first = above == table.begin() ? above : std::prev(above);
  auto last = std::ranges::lower_bound(table, series.to_um, {}, &std::pair<double, double>::first);
  if (last == table.end()) --last;
  first = std::min(first, last);
  std::string um, values;
  for (auto row = first;; ++row) {
    const char* comma = row == first ? "" : ", ";
    um += format(R"({}"{:g} um")", comma, row->first);
    values += format(R"({}"{:g} W m-2 sr-1 um-1")", comma, row->second);
    if (row == last) break;
  }
  return format(R"(, "noise": {{"table": {{"wavelength": [{}], "values": [{}]}}, "outside": "extend"}})", um,
                values);
}

std::string channel_json(const PresetSeries& series, const std::vector<std::pair<double, double>>& noise) {
  return format(
      R"({{"series": {{"gaussian": {{"from": "{:g} um", "to": "{:g} um", "count": {}, "fwhm": "{:g} um"}}}}{}}})",
      series.from_um, series.to_um, series.count, series.fwhm_um, noise_json(noise, series));
}

/// A pixel as large as the first one that is told.
std::string orthographic_json(const SensorPreset& preset) {
  const std::vector<Field> words = split(preset.ground, ' ');
  const bool has_size = words.size() > 1 && number_in(words[0].text).has_value();
  std::string unit(has_size ? words[1].text : "m");
  if (unit.ends_with(',')) unit.pop_back();
  return format(R"({{"orthographic": {{"gsd": "{} {}", "pixels": [64, 64]}}}})",
                has_size ? words[0].text : "1", unit);
}

std::string channels_json(const SensorPreset& preset) {
  std::string text;
  const auto add = [&](const std::string& channel) { text += (text.empty() ? "" : ",\n      ") + channel; };
  for (const PresetBand& band : preset.bands) add(channel_json(band));
  for (const PresetSeries& series : preset.series) add(channel_json(series, preset.noise));
  return format("[\n      {}\n    ]", text);
}

std::vector<std::string> words_of(std::string name) {
  std::replace(name.begin(), name.end(), '-', ' ');
  std::istringstream words(name);
  return {std::istream_iterator<std::string>(words), {}};
}

}  // namespace

double PresetBand::nedl_w_m2_sr_um() const {
  const radiometry::Channel channel = is_bell ? radiometry::Channel::gaussian(name, a_um, b_um)
                                              : radiometry::Channel::top_hat(name, a_um, b_um);
  return nedt_k * radiometry::channel_planck_slope_w_m2_sr_um_k(channel, at_k);
}

int SensorPreset::channel_count() const {
  int count = static_cast<int>(bands.size());
  for (const PresetSeries& of : series) count += of.count;
  return count;
}

std::pair<double, double> SensorPreset::range_um() const {
  std::pair<double, double> range{std::numeric_limits<double>::infinity(), 0.0};
  const auto add = [&](double first, double last) {
    range = {std::min(range.first, first), std::max(range.second, last)};
  };
  for (const PresetBand& band : bands) {
    if (band.is_bell)
      add(band.a_um - 0.5 * band.b_um, band.a_um + 0.5 * band.b_um);
    else
      add(band.a_um, band.b_um);
  }
  for (const PresetSeries& of : series) add(of.from_um - 0.5 * of.fwhm_um, of.to_um + 0.5 * of.fwhm_um);
  return range;
}

std::string SensorPreset::noise_text() const {
  std::string text = noise.empty() ? "" : "NEdL";
  std::ptrdiff_t told = 0;
  const auto add = [&](const char* word, auto is_told) {
    const auto more = std::ranges::count_if(bands, is_told);
    if (more == 0) return;
    text += text.empty() ? word : format(", {}", word);
    told += more;
  };
  add("SNR", [](const PresetBand& band) { return band.snr > 0.0; });
  add("NEdT", [](const PresetBand& band) { return band.nedt_k > 0.0; });
  add("detector", [](const PresetBand& band) { return band.efficiency > 0.0; });
  return told == 0 || told == static_cast<std::ptrdiff_t>(bands.size()) ? text
                                                                        : format("{} of {}", text, told);
}

std::vector<SensorPreset> parse_sensor_presets(const std::string& table, std::string_view text) {
  return PresetParser(table, text).parse();
}

std::span<const SensorPreset> sensor_presets() {
  static const std::vector<SensorPreset> presets = [] {
    const std::array<std::pair<const char*, std::string_view>, 6> tables{{
        {"data/sensors/landsat.txt", data::sensors_landsat_txt},
        {"data/sensors/sentinel.txt", data::sensors_sentinel_txt},
        {"data/sensors/nasa.txt", data::sensors_nasa_txt},
        {"data/sensors/commercial.txt", data::sensors_commercial_txt},
        {"data/sensors/spectrometers.txt", data::sensors_spectrometers_txt},
        {"data/sensors/cameras.txt", data::sensors_cameras_txt},
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
  const std::string asked = lower_case(name);
  std::vector<std::string> names, holding, every;
  for (const SensorPreset& preset : sensor_presets()) {
    bool holds = false;
    const auto look = [&](const std::string& known) {
      holds = holds || lower_case(known).find(asked) != std::string::npos;
      every.push_back(known);
      return lower_case(known) == asked;
    };
    if (look(preset.name) || std::ranges::any_of(preset.also, look)) return preset;
    names.push_back(preset.name);
    if (holds && !asked.empty()) holding.push_back(preset.name);
  }
  if (holding.empty() && nearest_name(name, every).empty())
    for (const SensorPreset& preset : sensor_presets())
      if (!nearest_name(asked, words_of(preset.name)).empty()) holding.push_back(preset.name);
  const std::string meant =
      holding.empty() ? did_you_mean(name, every) : format("; did you mean {}?", list_names(holding, "or"));
  throw InputError(
      format("there is no preset '{}'{} ({})", name, meant, list_names(names, "and", kMostListed)));
}

std::string preset_text(const SensorPreset& preset) {
  std::string sensor =
      format("\n    \"camera\": {},", preset.camera.empty() ? orthographic_json(preset) : preset.camera);
  const auto add = [&](const char* key, const std::string& json) {
    if (!json.empty()) sensor += format("\n    \"{}\": {},", key, json);
  };
  add("optics", preset.optics), add("detector", preset.detector), add("mosaic", preset.mosaic);
  const std::string platform =
      preset.platform.empty() ? "" : format("  \"platform\": {},\n", preset.platform);
  return format(R"({{
  "ifov": 1,
  "scene": {{
    "materials": {{"land": {{"reflectance": 0.3, "temperature": "300 K"}}, "lake": {{"reflectance": 0.05, "temperature": "290 K"}}}},
    "objects": [
      {{"plane": {{}}, "material": "land"}},
      {{"disk": {{"center": ["100 km", "0 m", "0.1 m"], "normal": [0, 0, 1], "radius": "100 km"}}, "material": "lake"}}
    ]
  }},
  "light": {{"sun": {{"disc": {{"zenith": "45 deg", "azimuth": "135 deg"}}}}, "sky": {{"none": {{}}}}}},
{}  "sensor": {{{}
    "channels": {}
  }}
}}
)",
                platform, sensor, channels_json(preset));
}

}  // namespace ifov::io

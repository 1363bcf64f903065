#include "radiometry/refractive_index.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <vector>

#include "core/error.h"

namespace ifov::data {
extern const std::string_view refractive_indices_txt, index_ice, index_water;
}

namespace ifov::radiometry {
namespace {

/// What follows `key` where a line begins with it.
bool after(std::string_view line, std::string_view key, std::string_view& rest) {
  if (line.substr(0, key.size()) != key) return false;
  rest = line.substr(key.size());
  return true;
}

std::array<double, 3> three_numbers(std::string_view line) {
  std::array<double, 3> values{};
  const char* at = line.data();
  const char* const end = at + line.size();
  for (double& value : values) {
    while (at != end && *at == ' ') ++at;
    at = std::from_chars(at, end, value).ptr;
  }
  return values;
}

std::vector<RefractiveIndex> parse_indices(std::string_view text) {
  std::vector<RefractiveIndex> all;
  std::vector<double> um, n, k;
  const auto finish = [&] {
    if (all.empty()) return;
    const std::string name = format("refractive index of {}", all.back().name);
    all.back().n = Spectrum(um, std::move(n), OutsideRange::error, name);
    all.back().k = Spectrum(std::move(um), std::move(k), OutsideRange::error, name);
    um.clear(), n.clear(), k.clear();
  };
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    std::string_view rest;
    if (line.empty() || line[0] == '#') continue;
    if (after(line, "index: ", rest)) {
      finish();
      all.push_back({rest, {}, {}, {}, {}});
    } else if (after(line, "about: ", rest)) {
      all.back().about = rest;
    } else if (after(line, "source: ", rest)) {
      if (all.back().source.empty()) all.back().source = rest;
    } else {
      const std::array<double, 3> row = three_numbers(line);
      um.push_back(row[0]);
      n.push_back(row[1]);
      k.push_back(row[2]);
    }
  }
  finish();
  return all;
}

/// A file of data/indices.
RefractiveIndex parse_index(std::string_view name, std::string_view about, std::string_view source,
                            std::string_view text) {
  std::vector<double> um, n, k;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line[0] == '#') continue;
    const std::array<double, 3> row = three_numbers(line);
    um.push_back(row[0]);
    n.push_back(row[1]);
    k.push_back(row[2]);
  }
  const std::string what = format("refractive index of {}", name);
  Spectrum real_part(um, std::move(n), OutsideRange::error, what);
  return {name, about, source, std::move(real_part),
          Spectrum(std::move(um), std::move(k), OutsideRange::error, what)};
}

}  // namespace

std::span<const RefractiveIndex> refractive_indices() {
  static const std::vector<RefractiveIndex> all = parse_indices(data::refractive_indices_txt);
  return all;
}

std::span<const std::string_view> refractive_index_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> found;
    for (const RefractiveIndex& index : refractive_indices()) found.push_back(index.name);
    return found;
  }();
  return names;
}

const RefractiveIndex& refractive_index(std::string_view name) {
  std::string names;
  for (const RefractiveIndex& index : refractive_indices()) {
    if (index.name == name) return index;
    names += (names.empty() ? "'" : ", '") + std::string(index.name) + "'";
  }
  throw InputError(format("there is no refractive index of '{}'; there are {}", name, names));
}

const RefractiveIndex* whole_refractive_index(std::string_view name) {
  static const std::array<RefractiveIndex, 2> all{
      parse_index("ice", "Ih, at 266 K", "S. G. Warren and R. E. Brandt, J. Geophys. Res. 113, D14220 (2008)",
                  data::index_ice),
      parse_index("water", "liquid, at 25 degC",
                  "D. J. Segelstein, M.S. thesis, University of Missouri (1981)", data::index_water)};
  // n of that table of water is up to 0.03 lower in the infrared than others measured it.
  static const RefractiveIndex water{all[1].name, all[1].about, all[1].source, refractive_index("water").n,
                                     all[1].k};
  if (name == water.name) return &water;
  return name == all[0].name ? &all[0] : nullptr;
}

}  // namespace ifov::radiometry

#include "atmosphere/particles/aerosol_components.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "atmosphere/tables/table_text.h"
#include "radiometry/refractive_index.h"

namespace ifov::data {
extern const std::string_view atmosphere_aerosol_components;
}

namespace ifov::atmosphere {
namespace {

struct ComponentTables {
  struct Sizes {
    double humidity_percent = 0.0, median_um = 0.0;
    RadiusRange range;
  };
  struct Component {
    double deviation = 0.0;
    std::string index;
    std::vector<Sizes> sizes;  ///< humidities rise
  };
  struct Index {
    std::vector<double> wavelength_um, n, k;
  };
  std::map<std::string, Component, std::less<>> components;
  std::map<std::string, Index, std::less<>> indices;
  std::map<std::string, std::vector<std::pair<std::string, double>>, std::less<>> mixtures;
  std::vector<std::string> names;  ///< of the mixtures, as they stand in the file

  static const ComponentTables& instance() {
    static const ComponentTables all;
    return all;
  }

 private:
  ComponentTables() {
    for (const TableSection& section : parse_table_text(data::atmosphere_aerosol_components)) {
      const std::vector<std::string>& words = section.words;
      const std::vector<double>& values = section.values;
      if (words[0] == "component") {
        Component& component = components[words[1]];
        component.deviation = std::stod(words[2]), component.index = words[3];
        for (std::size_t k = 0; k < values.size(); k += 4)
          component.sizes.push_back({values[k], values[k + 1], {values[k + 2], values[k + 3]}});
      } else if (words[0] == "index") {
        indices[words[1]] = {table_column(section, 0, 3), table_column(section, 1, 3),
                             table_column(section, 2, 3)};
      } else {
        names.push_back(words[1]);
        for (std::size_t k = 2; k < words.size(); k += 2)
          mixtures[words[1]].emplace_back(words[k], std::stod(words[k + 1]));
      }
    }
  }
};

ComponentTables::Sizes sizes_at(const std::vector<ComponentTables::Sizes>& table, double humidity_percent) {
  const double humidity =
      std::clamp(humidity_percent, table.front().humidity_percent, table.back().humidity_percent);
  std::size_t i = 0;
  while (i + 2 < table.size() && table[i + 1].humidity_percent < humidity) ++i;
  const ComponentTables::Sizes &low = table[i], &high = table[std::min(i + 1, table.size() - 1)];
  if (!(high.humidity_percent > low.humidity_percent)) return low;
  const double share = std::log((100.0 - humidity) / (100.0 - low.humidity_percent)) /
                       std::log((100.0 - high.humidity_percent) / (100.0 - low.humidity_percent));
  return {humidity,
          std::lerp(low.median_um, high.median_um, share),
          {std::lerp(low.range.least_um, high.range.least_um, share),
           std::lerp(low.range.most_um, high.range.most_um, share)}};
}

}  // namespace

std::shared_ptr<const MieParticles> component_spheres(std::string_view name, double humidity_percent) {
  using radiometry::OutsideRange;
  using radiometry::Spectrum;
  const ComponentTables& tables = ComponentTables::instance();
  const ComponentTables::Component& component = tables.components.at(std::string(name));
  const ComponentTables::Index& dry = tables.indices.at(component.index);
  const ComponentTables::Sizes sizes = sizes_at(component.sizes, humidity_percent);
  const double of_dry = std::pow(component.sizes.front().median_um / sizes.median_um, 3);
  std::vector<double> n = dry.n, k = dry.k;
  if (of_dry < 1.0) {
    const radiometry::RefractiveIndex& water = radiometry::refractive_index("water");
    for (std::size_t i = 0; i < n.size(); ++i) {
      n[i] = std::lerp(water.n.at(dry.wavelength_um[i]), n[i], of_dry);
      k[i] = std::lerp(water.k.at(dry.wavelength_um[i]), k[i], of_dry);
    }
  }
  return std::make_shared<const MieParticles>(
      lognormal(sizes.median_um, component.deviation, sizes.range),
      Spectrum(dry.wavelength_um, std::move(n), OutsideRange::extend),
      Spectrum(dry.wavelength_um, std::move(k), OutsideRange::extend));
}

const std::vector<std::string>& composed_aerosols() { return ComponentTables::instance().names; }

/// Of mineral particles. Spheroids of their sizes and index (Koepke, Gasteiger and Hess 2015, Atmos. Chem. Phys. 15, 5947) send half as
/// much again to 110 to 140 degrees and half as much to 160 to 180; of desert dust with what is soluble beside it this holds all.
constexpr double kShapeError = 0.7;

std::shared_ptr<const ParticleMixture> composed_aerosol(std::string_view name, double humidity_percent) {
  std::vector<ParticleMixture::Part> parts;
  for (const auto& [component, number] : ComponentTables::instance().mixtures.at(std::string(name)))
    parts.push_back({component_spheres(component, humidity_percent), number,
                     component.starts_with("mineral") ? kShapeError : 0.0});
  return std::make_shared<const ParticleMixture>(std::move(parts));
}

}  // namespace ifov::atmosphere

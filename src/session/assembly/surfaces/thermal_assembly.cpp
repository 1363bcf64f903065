#include "session/assembly/surfaces/thermal_assembly.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "atmosphere/weather_series.h"
#include "core/error.h"
#include "io/document/document_error.h"
#include "io/document/scene_document.h"
#include "io/document/thermal_document.h"
#include "io/library/thermal_library.h"
#include "io/weather/time_table_file.h"
#include "materials/material.h"
#include "radiometry/planck.h"
#include "radiometry/solar_spectrum.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/two_faces.h"
#include "thermal/faces/air_gap.h"
#include "thermal/faces/time_table.h"
#include "thermal/therm_slab.h"

namespace ifov::session {
namespace {

using radiometry::Spectrum;

constexpr double kRoom_k = 293.15, kRoom_w_m2_k = 7.7;  // ISO 6946: 0.13 m2 K W-1

/// Mean of a spectrum with a weight over what is known of both, and the share of the weight, on [first, last] um, that is.
struct Mean {
  double value = 0.0, known = 0.0;
};
template <class Weight>
Mean mean_of(const Spectrum& spectrum, double first_um, double last_um, const Weight& weight) {
  if (spectrum.is_constant()) return {spectrum.values()[0], 1.0};
  constexpr int kPoints = 4000;
  const bool goes_on = spectrum.outside() != radiometry::OutsideRange::error;
  double sum = 0.0, known = 0.0, all = 0.0;
  for (int i = 0; i < kPoints; ++i) {  // equal steps of the logarithm
    const double um = first_um * std::pow(last_um / first_um, (i + 0.5) / kPoints), part = um * weight(um);
    all += part;
    if (!goes_on && (um < spectrum.first_um() || um > spectrum.last_um())) continue;
    known += part;
    sum += part * spectrum.at(um);
  }
  return {known > 0.0 ? sum / known : 0.0, known / all};
}

Spectrum transmittance_of(const materials::Material& optics) {
  return optics.transmittance.value_or(Spectrum::constant(0.0));
}

/// What is neither reflected nor let through, in the light of the Sun above the air, 0.3 to 4 um.
Mean solar_absorptance(const materials::Material& optics) {
  const Spectrum& sun = radiometry::solar_irradiance_1au();
  const auto weight = [&](double um) { return sun.at(um); };
  const Mean back = mean_of(optics.reflectance, 0.3, 4.0, weight),
             through = mean_of(transmittance_of(optics), 0.3, 4.0, weight);
  return {1.0 - back.value - through.value, std::min(back.known, through.known)};
}

/// The same for what a surface of 290 K gives off, 3 to 50 um.
Mean longwave_emissivity(const materials::Material& optics) {
  const auto weight = [](double um) { return radiometry::planck_w_m2_sr_um(um, 290.0); };
  const Mean back = mean_of(optics.reflectance, 3.0, 50.0, weight),
             through = mean_of(transmittance_of(optics), 3.0, 50.0, weight);
  return {1.0 - back.value - through.value, std::min(back.known, through.known)};
}

/// The table of a document or its file, whose place errors are told with.
std::shared_ptr<const thermal::TimeTable> table_of(const io::DocumentSources& sources,
                                                   const io::TimedDocument& source,
                                                   std::span<const io::TimeTableColumn> columns) {
  auto table = std::make_shared<thermal::TimeTable>();
  for (const io::TimedDocument::AtTime& one : source.table) {
    table->time_s.push_back(atmosphere::seconds_of(one.time));
    table->value.push_back(one.value);
  }
  if (source.file)
    with_position(sources, source.file->position, [&] {
      io::TimeTableRows rows = io::read_time_table(source.file->path, columns);
      *table = {std::move(rows.time_s), std::move(rows.value)};
    });
  return table;
}

std::string range_text(const thermal::TimeTable& table, double offset, const char* unit) {
  const auto [least, most] = std::minmax_element(table.value.begin(), table.value.end());
  return format("{:g} to {:g} {}, at {} times", *least - offset, *most - offset, unit, table.value.size());
}

constexpr double kZero_k = 273.15;

thermal::Back back_of(const io::DocumentSources& sources, const io::ThermalBackDocument& back, double deep_k,
                      std::vector<std::string>& description) {
  const auto table = [&](const io::TimedDocument& source, const char* what) {
    std::shared_ptr<const thermal::TimeTable> over_time;
    if (!source.is_over_time()) return over_time;
    over_time = table_of(sources, source, io::kTemperatureColumns);
    description.push_back(format("{} {}", what, range_text(*over_time, kZero_k, "degC")));
    return over_time;
  };
  if (back.held_k) return thermal::HeldBack{back.held_k->constant, table(*back.held_k, "held behind at")};
  if (back.room)
    return thermal::RoomAir{back.room->temperature_k.constant, back.room->conductance_w_m2_k,
                            table(back.room->temperature_k, "a room behind of")};
  if (back.ground) return thermal::DeepGround{back.ground->temperature_k.value_or(deep_k)};
  if (back.other_side) return thermal::OtherFace{};
  return thermal::Insulated{};
}

template <class E>
E named(const std::string& name) {
  int i = 0;
  while (thermal::name_of(static_cast<E>(i)) != name) ++i;
  return static_cast<E>(i);
}

std::string layer_text(const thermal::SolidLayer& layer, const std::string& name) {
  return format("{:g} mm{} of {:g} W m-1 K-1, {:g} kg m-3, {:g} J kg-1 K-1: a day's wave goes {:.3g} cm deep",
                1e3 * layer.thickness_m, name.empty() ? "" : " " + name, layer.conductivity_w_m_k,
                layer.density_kg_m3, layer.specific_heat_j_kg_k, 100.0 * thermal::daily_depth_m(layer));
}

void take_air_gap(const io::ThermalLayerDocument::AirGap& source, ThermalMaterial& result) {
  const double resistance =
      thermal::resistance_m2_k_w({source.thickness_m, source.emissivities[0], source.emissivities[1],
                                  named<thermal::HeatFlow>(source.heat_flow)});
  result.solid.layers.back().gap_behind_m2_k_w = resistance;
  result.description.push_back(format("{:g} mm air, heat flow {}: {:.3f} m2 K W-1 by ISO 6946",
                                      1e3 * source.thickness_m, source.heat_flow, resistance));
}

void take_layers(const io::ThermalDocument& source, ThermalMaterial& result) {
  for (const io::ThermalLayerDocument& layer : source.layers) {
    if (layer.air_gap) {
      take_air_gap(*layer.air_gap, result);
      continue;
    }
    thermal::SolidLayer solid{layer.thickness_m, layer.conductivity_w_m_k, layer.density_kg_m3,
                              layer.specific_heat_j_kg_k};
    if (!layer.library.empty()) {
      const io::LibrarySolid& known = io::thermal_library().solid(layer.library);
      solid = known.values;
      if (result.solid.layers.empty()) result.skin.melts_k = known.melts_k;
      solid.thickness_m = layer.thickness_m;
    }
    result.solid.layers.push_back(solid);
    result.description.push_back(layer_text(solid, layer.library));
  }
}

void take_leaf(const thermal::Leaf& leaf, double water_m, ThermalMaterial& result) {
  thermal::SolidLayer water = io::thermal_library().solid("water").values;
  water.thickness_m = water_m;
  result.solid.layers.push_back(water);
  result.solid.back = thermal::OtherFace{};
  result.skin.two_faces = true;
  result.skin.leaf = leaf;
  result.description.push_back(format(
      "a leaf {:g} cm wide, holding {:g} mm of water; stomata of {:g} mol m-2 s-1 on {}; fluxes are of both "
      "faces together",
      100.0 * leaf.width_m, 1e3 * water_m, leaf.stomatal_mol_m2_s,
      leaf.stomatal_faces == 2 ? "both faces" : "one face"));
}

void take_held(const io::DocumentSources& sources, const io::TimedDocument& source, ThermalMaterial& result) {
  thermal::SolidLayer skin = io::thermal_library().solid("steel").values;  // of any stuff: it follows at once
  skin.thickness_m = 1e-3;
  result.solid.layers.push_back(skin);
  if (!source.is_over_time()) {
    result.skin.as_air = true;
    result.description.push_back("as warm as the air; \"power\" is what holds it there");
    return;
  }
  result.skin.held_k = table_of(sources, source, io::kTemperatureColumns);
  result.description.push_back(format("{} as told; \"power\" is what holds it there",
                                      range_text(*result.skin.held_k, kZero_k, "degC")));
}

ThermalMaterial from_document(const io::DocumentSources& sources, const io::ThermalDocument& source,
                              double deep_k) {
  ThermalMaterial result;
  if (const auto& therm = source.therm) {
    const thermal::ThermSlab slab{
        therm->density_kg_m3,    therm->specific_heat_j_kg_k, therm->conductivity_w_m_k, therm->thickness_m,
        therm->solar_absorption, therm->emissivity,           therm->exposed_area};
    result.solid = thermal::solid_of(slab);
    result.skin = thermal::skin_of(slab);
    result.start = thermal::Start::air;
    result.description.push_back("THERM: " + layer_text(result.solid.layers[0], {}));
  } else if (source.held) {
    take_held(sources, *source.held, result);
  } else if (source.leaf) {
    take_leaf({source.leaf->width_m, source.leaf->stomatal_mol_m2_s, source.leaf->both_faces ? 2 : 1},
              source.leaf->water_m, result);
  } else {
    take_layers(source, result);
    result.solid.back = back_of(sources, source.back, deep_k, result.description);
    result.skin.wetness = {source.wetness, source.resistance_s_m};
    if (source.back.other_side) {
      result.skin.two_faces = true;
      result.description.push_back("both faces are outdoors and as warm; fluxes are of both together");
    }
  }
  result.skin.roughness = named<thermal::Roughness>(source.roughness);
  result.skin.power_w_m2 = source.power_w_m2.constant;
  if (source.power_w_m2.is_over_time()) {
    result.skin.power_over_time = table_of(sources, source.power_w_m2, io::kPowerColumns);
    result.description.push_back(
        format("heat from inside of {}", range_text(*result.skin.power_over_time, 0.0, "W m-2")));
  }
  return result;
}

ThermalMaterial from_library(const io::LibrarySurface& surface, const std::string& name, double deep_k) {
  using Back = io::LibrarySurface::Back;
  ThermalMaterial result;
  if (surface.leaf.width_m > 0.0) {
    take_leaf(surface.leaf, surface.layers.front().thickness_m, result);
    result.description.push_back(format("as '{}' of the library", name));
    return result;
  }
  result.solid.layers = surface.layers;
  for (const thermal::SolidLayer& layer : surface.layers) result.description.push_back(layer_text(layer, {}));
  result.description.push_back(format("as '{}' of the library", name));
  if (surface.back == Back::ground) result.solid.back = thermal::DeepGround{deep_k};
  if (surface.back == Back::room) result.solid.back = thermal::RoomAir{kRoom_k, kRoom_w_m2_k};
  result.skin.roughness = surface.roughness;
  result.skin.wetness = {surface.wet_share, surface.resistance_s_m};
  result.skin.melts_k = surface.melts_k;
  return result;
}

/// Takes what the spectrum says of the skin, unless the document does.
void take_optics(const io::DocumentSources& sources, const io::MaterialDocument& source,
                 const materials::Material& optics, ThermalMaterial& result) {
  const auto take = [&](const std::optional<double>& given, const Mean& mean, double least, const char* what,
                        const char* key, double& value) {
    if (given) {
      value = *given;
      result.description.push_back(
          mean.known >= least ? format("{} {:.3f} as given; its spectrum has {:.3f}", what, value, mean.value)
                              : format("{} {:.3f} as given", what, value));
      return;
    }
    if (mean.known < least)
      throw io::document_error(
          sources, source.position,
          format("the spectrum of '{}' covers {:.0f} % of what its {} is the mean of, expected {:.0f} "
                 "%; give \"thermal\": {{..., \"{}\": ...}}",
                 source.name, 100.0 * mean.known, what, 100.0 * least, key));
    value = std::clamp(mean.value, 0.0, 1.0);
    result.description.push_back(format("{} {:.3f}", what, value));
  };
  const std::optional<double> absorptance = source.thermal ? source.thermal->solar_absorptance : std::nullopt,
                              emissivity = source.thermal ? source.thermal->emissivity : std::nullopt;
  if (std::isfinite(result.skin.melts_k))
    result.description.push_back(
        format("melts at {:g} degC and gets no warmer; what melts is not taken away, and none freezes again",
               result.skin.melts_k - 273.15));
  take(absorptance, solar_absorptance(optics), 0.8, "absorptance of sunlight", "solar_absorptance",
       result.skin.solar_absorptance);
  if (result.skin.two_faces) {
    const auto of_sun = [&](double um) { return radiometry::solar_irradiance_1au().at(um); };
    result.skin.transmittance = std::min(1.0 - result.skin.solar_absorptance,
                                         mean_of(transmittance_of(optics), 0.3, 4.0, of_sun).value);
  }
  take(emissivity, longwave_emissivity(optics), 0.3, "long-wave emissivity", "emissivity",
       result.skin.emissivity);
}

}  // namespace

bool has_two_faces(const io::MaterialDocument& source) {
  if (source.thermal) return source.thermal->leaf || source.thermal->back.other_side;
  const auto* library = std::get_if<io::LibrarySource>(&source.spectrum.source);
  const io::LibrarySurface* surface =
      library != nullptr ? io::thermal_library().surface(library->material) : nullptr;
  return surface != nullptr && surface->back == io::LibrarySurface::Back::other_side;
}

std::optional<ThermalMaterial> assemble_thermal(const io::DocumentSources& sources,
                                                const io::MaterialDocument& source,
                                                const materials::Material& optics, double deep_k) {
  std::optional<ThermalMaterial> result;
  if (source.thermal) {
    result = from_document(sources, *source.thermal, deep_k);
  } else if (const auto* library = std::get_if<io::LibrarySource>(&source.spectrum.source)) {
    if (const io::LibrarySurface* surface = io::thermal_library().surface(library->material))
      result = from_library(*surface, library->material, deep_k);
  }
  if (!result) return result;
  with_position(sources, source.thermal ? source.thermal->position : source.position,
                [&] { thermal::check(result->solid); });
  if (source.thermal && source.thermal->therm) return result;  // has both numbers of its own
  take_optics(sources, source, optics, *result);
  return result;
}

}  // namespace ifov::session

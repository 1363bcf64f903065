#include <cmath>

#include "core/format.h"
#include "geodesy/utc_seconds.h"
#include "io/document/schema/heat_quantities.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"
#include "io/document/thermal_document.h"
#include "io/library/thermal_library.h"
#include "thermal/faces/air_gap.h"
#include "thermal/faces/convection.h"
#include "thermal/solid.h"
#include "thermal/wind_profile.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostLayers = 100;

SchemaType<double> above_zero(const Dimension& dimension, std::string_view unit) {
  return quantity(dimension, Range::above(0.0, unit));
}

SchemaType<double> thickness() {
  return quantity(kLength, Range::at_least(1e6 * thermal::kThinnestLayer_m, "um"));
}

/// The names of the first `count` of an enumeration, each as itself.
template <class E>
SchemaType<std::string> names_of(int count) {
  std::vector<std::pair<std::string, std::string>> words;
  for (int i = 0; i < count; ++i) {
    const std::string name(thermal::name_of(static_cast<E>(i)));
    words.emplace_back(name, name);
  }
  return choice(words);
}

SchemaType<ThermalLayerDocument> air_gap_type() {
  using Layer = ThermalLayerDocument;
  using Gap = Layer::AirGap;
  const auto given = [](auto member) {
    return via(
        [member](Layer& layer, auto value) {
          (layer.air_gap ? *layer.air_gap : layer.air_gap.emplace()).*member = std::move(value);
        },
        [member](const Layer& layer) {
          return layer.air_gap ? std::optional((*layer.air_gap).*member) : std::nullopt;
        });
  };
  Record<Layer> record(
      "air gap",
      "Air that does not change with that outdoors, between two layers or before what is behind: a "
      "resistance without mass by its thickness, the way that heat goes and both faces (ISO 6946).");
  record
      .required("air_gap", given(&Gap::thickness_m),
                quantity(kLength, Range::between(1.0, 1e3 * thermal::kThickestGap_m, "mm")),
                "how thick the air is")
      .with_default("heat_flow", given(&Gap::heat_flow), names_of<thermal::HeatFlow>(thermal::kHeatFlows),
                    "\"horizontal\"", "as through a wall; or mostly up or down through a roof or a floor")
      .with_default("emissivities", given(&Gap::emissivities),
                    list(fraction(Range::between(0.01, 1.0)), 2, 2), "[0.9, 0.9]",
                    "of both faces; 0.05 of a bright foil");
  return record.type();
}

SchemaType<ThermalLayerDocument> solid_layer_type() {
  using Layer = ThermalLayerDocument;
  Record<Layer> record("thermal layer", "A sheet of one solid: of the library, or of three numbers.");
  record.required("thickness", &Layer::thickness_m, thickness(), "at least 10 um");
  const auto given = [](auto member) {
    return via([member](Layer& layer, double value) { layer.*member = value; },
               [member](const Layer& layer) {
                 return layer.library.empty() ? std::optional(layer.*member) : std::nullopt;
               });
  };
  record.exactly_one()
      .one("library",
           via([](Layer& layer, std::string name) { layer.library = std::move(name); },
               [](const Layer& layer) {
                 return layer.library.empty() ? std::nullopt : std::optional(layer.library);
               }),
           label(), "name of a thermal material that is built in")
      .one("conductivity", given(&Layer::conductivity_w_m_k), above_zero(kConductivity, "W m-1 K-1"),
           "of heat")
      .optional("density", given(&Layer::density_kg_m3), above_zero(kMassDensity, "kg/m3"), "of mass")
      .optional("specific_heat", given(&Layer::specific_heat_j_kg_k), above_zero(kSpecificHeat, "J kg-1 K-1"),
                "heat by mass and temperature");
  for (const char* key : {"density", "specific_heat"}) record.needs(key, "conductivity");
  record.check([](const Layer& layer, const DocumentNode& node) {
    if (!layer.library.empty()) {
      try {
        thermal_library().solid(layer.library);
      } catch (const InputError& error) {
        node.given("library").fail(error.what());
      }
    } else if (!(layer.density_kg_m3 > 0.0) || !(layer.specific_heat_j_kg_k > 0.0)) {
      node.given("conductivity").fail_at_key("a conductivity needs 'density' and 'specific_heat' beside it");
    }
  });
  return record.type();
}

SchemaType<ThermalLayerDocument> layer_type() {
  return tagged<ThermalLayerDocument>(
      {{{"air_gap"}, air_gap_type()},
       {{"thickness", "library", "conductivity", "density", "specific_heat"}, solid_layer_type()}});
}

/// Air lies between two solids, or between one and what is behind.
void check_air_gaps(const ThermalDocument& thermal, const DocumentNode& node) {
  const std::vector<ThermalLayerDocument>& layers = thermal.layers;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (!layers[i].air_gap) continue;
    const DocumentNode& gap = node.given("layers").items()[i];
    const auto fail = [&](const char* message) { gap.fail(format("{} {}", gap.title(), message)); };
    if (i == 0) fail("is an air gap, and the surface is that of a solid; begin with a solid");
    if (layers[i - 1].air_gap) fail("is an air gap behind another; give one of them, or the sheet between");
    if (i + 1 < layers.size()) continue;
    if (thermal.back.ground)
      fail("is an air gap, and deep ground is what the last layer goes on as; end with a solid");
    if (!thermal.back.held_k && !thermal.back.room)
      fail(
          "is an air gap, and no heat passes behind it; give a \"back\" that has a temperature, or leave it out");
  }
}

constexpr std::size_t kMostTimes = 100000;

using TimedRows = std::vector<TimedDocument::AtTime>;

SchemaType<TimedRows> rows_type(const char* key, const SchemaType<double>& value, const char* what) {
  Record<TimedDocument::AtTime> one(format("{} at a time", key), format("{} at one time.", what));
  one.required("time", &TimedDocument::AtTime::time, time_type(), "of UTC, or with another zone")
      .required(key, &TimedDocument::AtTime::value, value, "then");
  const SchemaType<TimedRows> rows = list(one.type(), 1, kMostTimes);
  return {rows.description,
          [read = rows.read](const DocumentNode& node) {
            TimedRows table = read(node);
            for (std::size_t k = 1; k < table.size(); ++k) {
              if (geodesy::seconds_after(table[k].time, table[k - 1].time) > 0.0) continue;
              const DocumentNode& time = node.items()[k].given("time");
              time.fail(format("{} is {}, expected a time after {}, which stands before it", time.title(),
                               geodesy::format_utc(table[k].time), geodesy::format_utc(table[k - 1].time)));
            }
            return table;
          },
          rows.write};
}

SchemaType<TimedDocument> over_time_type(const char* key, const SchemaType<double>& value, const char* what,
                                         const char* headings) {
  Record<TimedDocument> record(
      format("{} over time", key),
      format("{}: linear between its times, the first and the last hold beyond.", what));
  record.exactly_one()
      .one("table",
           via([](TimedDocument& timed, TimedRows table) { timed.table = std::move(table); },
               [](const TimedDocument& timed) {
                 return timed.table.empty() ? std::nullopt : std::optional(timed.table);
               }),
           rows_type(key, value, what), "times in rising order")
      .one("file", &TimedDocument::file, file(),
           format("the same as comma-separated values under the headings {}", headings));
  return record.type();
}

/// A value, or one over time.
SchemaType<TimedDocument> timed_type(const char* key, const SchemaType<double>& value, const char* what,
                                     const char* headings) {
  return either(converted<TimedDocument>(
                    value,
                    [](double constant) {
                      return TimedDocument{constant, {}, {}};
                    },
                    [](const TimedDocument& timed) {
                      return timed.is_over_time() ? std::nullopt : std::optional(timed.constant);
                    }),
                over_time_type(key, value, what, headings));
}

constexpr const char* kTemperatureHeadings = "time,temperature_c or time,temperature_k";

SchemaType<TimedDocument> timed_temperature_type() {
  return timed_type("temperature", above_zero(kTemperature, "K"), "How warm it is", kTemperatureHeadings);
}

SchemaType<ThermalBackDocument> back_type() {
  using Back = ThermalBackDocument;
  Record<Back::Room> room("room behind a wall", "Air at a temperature that is held, or goes over time.");
  room.with_default("temperature", &Back::Room::temperature_k, timed_temperature_type(), "\"20 degC\"",
                    "of the air")
      .with_default("conductance", &Back::Room::conductance_w_m2_k,
                    quantity(kConductance, Range::at_least(0.0, "W m-2 K-1")), "\"7.7 W m-2 K-1\"",
                    "between it and the last layer (ISO 6946: 1 / 0.13)");
  Record<Back::Ground> ground(
      "deep ground",
      "The last layer goes on to ten times the depth of a day's wave, where the temperature is held.");
  ground.optional(
      "temperature", &Back::Ground::temperature_k, above_zero(kTemperature, "K"),
      "deep down; without it the mean of the air over the weather's year, or what there is of it");
  Record<Back::OtherSide> other_side(
      "other side of a sheet",
      "Of a sign, a hood, a tarpaulin that stands free: a sheet that passes heat so well that both faces are as warm, "
      "at most 0.01 m2 K W-1. Either face takes in the Sun, the sky, the wind and what is about it.");
  Record<Back> record("back of layers", "What lies behind the last layer.");
  record.exactly_one()
      .one("temperature", &Back::held_k, timed_temperature_type(), "that is held there")
      .one("room", &Back::room, room.type(), "air of a room")
      .one("ground", &Back::ground, ground.type(), "deep ground")
      .one("other_side", &Back::other_side, other_side.type(),
           "the other face of the same thin sheet, outdoors, too");
  return record.type();
}

SchemaType<LeafDocument> leaf_type() {
  using Leaf = LeafDocument;
  Record<Leaf> record(
      "free leaf",
      "A leaf of two faces that stands free: air along its own width, and stomata (Campbell and Norman 1998).");
  record
      .with_default("width", &Leaf::width_m, quantity(kLength, Range::between(0.1, 3000.0, "mm")), "\"5 cm\"",
                    "along the wind: 1 mm of a needle, 5 cm of a broad leaf")
      .with_default(
          "stomatal_conductance", &Leaf::stomatal_mol_m2_s,
          quantity(kLeafConductance, Range::between(0.0, 10.0, "mol m-2 s-1")), "\"0.4 mol m-2 s-1\"",
          "of a face that has stomata, for vapour, by day: in the dark they are shut; 0 of a dry leaf")
      .with_default(
          "stomata", &Leaf::both_faces,
          choice(std::vector<std::pair<std::string, bool>>{{"one face", false}, {"both faces", true}}),
          "\"one face\"", "as of most trees; grasses and many crops have them on both")
      .with_default("water", &Leaf::water_m, quantity(kLength, Range::between(0.02, 20.0, "mm")),
                    "\"0.2 mm\"", "thickness of the water that it holds, which stores heat");
  return record.type();
}

SchemaType<ThermDocument> therm_type() {
  const SchemaType<double> share = fraction(Range::between(0.0, 1.0));
  Record<ThermDocument> record(
      "THERM slab",
      "The seven numbers of DIRSIG's THERM: a slab, insulated behind, that begins at the temperature of the air.");
  record.required("density", &ThermDocument::density_kg_m3, above_zero(kMassDensity, "kg/m3"), "of mass")
      .required("specific_heat", &ThermDocument::specific_heat_j_kg_k,
                above_zero(kSpecificHeat, "J kg-1 K-1"), "heat by mass and temperature")
      .required("conductivity", &ThermDocument::conductivity_w_m_k, above_zero(kConductivity, "W m-1 K-1"),
                "of heat")
      .required("thickness", &ThermDocument::thickness_m, thickness(), "at least 10 um")
      .required("solar_absorption", &ThermDocument::solar_absorption, share, "share of sunlight")
      .required("emissivity", &ThermDocument::emissivity, share, "of long waves")
      .with_default("exposed_area", &ThermDocument::exposed_area, share, "0.5",
                    "share of both faces that the air reaches: 0.5 is the front alone");
  return record.type();
}

/// Rows, or a file of them.
SchemaType<TimedDocument> held_table_type() {
  struct File {
    DocumentFile file;
  };
  Record<File> of_file("temperatures in a file", "How warm it is over time, from a file.");
  of_file.required("file", &File::file, file(),
                   format("comma-separated values under the headings {}", kTemperatureHeadings));
  return either(converted<TimedDocument>(
                    rows_type("temperature", above_zero(kTemperature, "K"), "How warm it is"),
                    [](TimedRows table) {
                      return TimedDocument{0.0, std::move(table), {}};
                    },
                    [](const TimedDocument& timed) {
                      return timed.table.empty() ? std::nullopt : std::optional(timed.table);
                    }),
                converted<TimedDocument>(
                    of_file.type(),
                    [](File found) {
                      return TimedDocument{0.0, {}, std::move(found.file)};
                    },
                    [](const TimedDocument& timed) {
                      return timed.file ? std::optional(File{*timed.file}) : std::nullopt;
                    }));
}

}  // namespace

SchemaType<ThermalDocument> thermal_type() {
  using Thermal = ThermalDocument;
  struct AsAir {};
  Record<Thermal> record("thermal material",
                         "What a surface's temperature follows from under weather (`ifov temperature`).");
  record.exactly_one()
      .one("layers",
           via([](Thermal& thermal,
                  std::vector<ThermalLayerDocument> layers) { thermal.layers = std::move(layers); },
               [](const Thermal& thermal) {
                 return thermal.layers.empty() ? std::nullopt : std::optional(thermal.layers);
               }),
           list(layer_type(), 1, kMostLayers), "from the surface inwards")
      .one("therm", &Thermal::therm, therm_type(), "THERM's seven numbers in their place")
      .one("leaf", &Thermal::leaf, leaf_type(), "a leaf, both faces of which are outdoors")
      .one("air",
           via([](Thermal& thermal, AsAir) { thermal.held.emplace(); },
               [](const Thermal& thermal) {
                 return thermal.held && !thermal.held->is_over_time() ? std::optional(AsAir{}) : std::nullopt;
               }),
           Record<AsAir>("as the air", "Nothing is solved: the surface is as warm as the air.").type(),
           "as warm as the air")
      .one(
          "table",
          via([](Thermal& thermal, TimedDocument table) { thermal.held = std::move(table); },
              [](const Thermal& thermal) {
                return thermal.held && thermal.held->is_over_time() ? thermal.held : std::nullopt;
              }),
          held_table_type(),
          "how warm it is over time, linear between, the first and the last hold beyond; times in rising order, or {\"file\": …}")
      .optional("back",
                via([](Thermal& thermal, ThermalBackDocument back) { thermal.back = back; },
                    [](const Thermal& thermal) {
                      const ThermalBackDocument& back = thermal.back;
                      return back.held_k || back.room || back.ground || back.other_side ? std::optional(back)
                                                                                        : std::nullopt;
                    }),
                back_type(), "what lies behind the last layer; without it no heat passes there")
      .with_default("roughness", &Thermal::roughness, names_of<thermal::Roughness>(thermal::kRoughnesses),
                    "\"rough\"", "to the wind")
      .with_default("wetness", &Thermal::wetness, fraction(Range::between(0.0, 1.0)), "0",
                    "share of the surface that gives off water")
      .with_default("resistance", &Thermal::resistance_s_m,
                    quantity(kResistance, Range::at_least(0.0, "s/m")), "\"0 s/m\"",
                    "what stands in the vapour's way before the air does: 70 s/m of a lawn's stomata")
      .with_default("power", &Thermal::power_w_m2,
                    timed_type("power", quantity(kHeatFlux), "Heat from inside, of an engine, of a hall",
                               "time,power_w_m2"),
                    "\"0 W m-2\"", "given off at the surface from inside: always as much, or over time")
      .optional("solar_absorptance", &Thermal::solar_absorptance, fraction(Range::between(0.0, 1.0)),
                "in place of what the material's spectrum takes of sunlight")
      .optional("emissivity", &Thermal::emissivity, fraction(Range::between(0.0, 1.0)),
                "of long waves, in place of the spectrum's");
  for (const char* key : {"back", "wetness", "resistance"}) record.needs(key, "layers");
  record.check([](const Thermal& thermal, const DocumentNode& node) {
    check_air_gaps(thermal, node);
    const auto refuse = [&](std::string_view key, const char* message) {
      if (const DocumentNode* found = node.find(key))
        found->fail_at_key(format("{} {}", found->title(), message));
    };
    if (thermal.therm)
      for (const char* key : {"solar_absorptance", "emissivity"})
        refuse(key, "is given beside 'therm', which has its own");
    if (thermal.held)
      for (const char* key : {"power", "roughness"})
        refuse(key, "has no part where it is told how warm the surface is");
    if (thermal.leaf) refuse("roughness", "is given beside 'leaf', along whose width the wind goes");
  });
  return record.type();
}

SchemaType<TemperaturesDocument> temperatures_type() {
  using Temperatures = TemperaturesDocument;
  const SchemaType<std::string> terrain = names_of<thermal::Terrain>(thermal::kTerrains);
  Record<Temperatures> record("temperatures", "How surface temperatures are solved.");
  record
      .with_default("spin_up", &Temperatures::spin_up_s, quantity(kDuration, Range::between(0.0, 60.0, "d")),
                    "\"3 d\"", "before the day that is shown")
      .with_default("step", &Temperatures::step_s, quantity(kDuration, Range::between(0.5, 60.0, "min")),
                    "\"5 min\"", "of time")
      .with_default("repeat_first_day", &Temperatures::repeat_first_day, boolean(), "false",
                    "whether days before the weather begins are like its first 24 hours")
      .with_default("terrain", &Temperatures::terrain, terrain, "\"open\"", "about the scene, for the wind")
      .with_default("anemometer_height", &Temperatures::anemometer_m,
                    quantity(kLength, Range::at_least(1.0, "m")), "\"10 m\"",
                    "that the weather's wind was measured at")
      .with_default("anemometer_terrain", &Temperatures::anemometer_terrain, terrain, "\"open\"",
                    "that it was measured over")
      .check([](const Temperatures& how, const DocumentNode& node) {
        const double steps = 86400.0 / how.step_s;
        if (std::abs(steps - std::round(steps)) > 1e-6)
          node.given("step").fail(format("{} is {:g} s, expected a whole number of steps in a day",
                                         node.given("step").title(), how.step_s));
      });
  return record.type();
}

}  // namespace ifov::io

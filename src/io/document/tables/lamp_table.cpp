#include <string>
#include <utility>

#include "io/document/light_document.h"
#include "io/document/schema/record.h"
#include "io/document/shapes/measures.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

using Form = LampDocument::Form;

constexpr std::size_t kMostLamps = 100000;

/// What light a lamp gives off, and how much.
void with_light(Record<LampDocument>& record, bool has_file) {
  if (has_file)
    record.at_most_one();
  else
    record.exactly_one();
  record
      .one("temperature", &LampDocument::temperature_k, quantity(kTemperature, Range::above(0.0, "K")),
           "the light of a blackbody; without power and flux as bright as one")
      .one("spectrum", &LampDocument::spectrum, spectrum_type(SpectrumOf::number),
           "light by wavelength, in any unit: power or flux say how much");
  if (!has_file)
    record.one("radiance", &LampDocument::radiance, spectrum_type(SpectrumOf::radiance),
               "light by wavelength and how much, in the brightest direction");
  record.at_most_one()
      .one("power", &LampDocument::power_w, quantity(kPower, Range::above(0.0, "W")),
           "radiant power in all wavelengths of the light")
      .one("flux", &LampDocument::flux_lm, quantity(kLuminousFlux, Range::above(0.0, "lm")), "luminous flux")
      .check([has_file](const LampDocument& lamp, const DocumentNode& node) {
        const bool says_how_much = lamp.power_w || lamp.flux_lm;
        if (lamp.spectrum && !says_how_much && !has_file)
          node.given("spectrum")
              .fail(
                  "a spectrum in any unit says nothing of how much light there is: give 'power' or 'flux' too, or "
                  "'radiance' in its place");
        if (lamp.radiance && says_how_much)
          node.given(lamp.power_w ? "power" : "flux")
              .fail("'radiance' says how much light there is already: use 'spectrum' for its form alone");
      });
}

void with_place(Record<LampDocument>& record) {
  record.required("at", &LampDocument::at_m, point(), "its centre");
}

void with_small_radius(Record<LampDocument>& record) {
  record.with_default("radius", &LampDocument::radius_m, positive_length(), "\"1 cm\"",
                      "of the luminous ball, as which it is seen");
}

void with_axis(Record<LampDocument>& record, const std::string& what) {
  record.with_default("towards", &LampDocument::towards, direction(), "[0, 0, -1]", what);
}

SchemaType<LampDocument> point_lamp() {
  Record<LampDocument> record("point lamp", "A small ball that shines the same in all directions.");
  with_place(record);
  with_small_radius(record);
  with_light(record, false);
  return record.type();
}

SchemaType<LampDocument> sphere_lamp() {
  Record<LampDocument> record("sphere lamp", "A luminous ball, the same in all directions.");
  with_place(record);
  record.required("radius", &LampDocument::radius_m, positive_length(), "its radius");
  with_light(record, false);
  return record.type();
}

SchemaType<LampDocument> disk_lamp() {
  Record<LampDocument> record("disk lamp", "A disk that shines to one side, by Lambert's law.");
  with_place(record);
  record.required("radius", &LampDocument::radius_m, positive_length(), "its radius");
  with_axis(record, "the side that shines");
  with_light(record, false);
  return record.type();
}

SchemaType<LampDocument> spot_lamp() {
  Record<LampDocument> record("spot lamp",
                              "A small ball with a cone of light: the same intensity within the half angle, "
                              "falling smoothly to none over the edge beyond it.");
  with_place(record);
  with_small_radius(record);
  with_axis(record, "the middle of the cone");
  record
      .required("half_angle", &LampDocument::half_angle_rad,
                quantity(kAngle, Range::between(0.1, 180.0, "deg")), "of the cone")
      .with_default("edge", &LampDocument::edge_rad, quantity(kAngle, Range::between(0.0, 180.0, "deg")),
                    "\"5 deg\"", "over which it falls to nothing");
  with_light(record, false);
  return record.type();
}

SchemaType<LampDocument> ies_lamp() {
  Record<LampDocument> record(
      "measured lamp",
      "A small ball with the intensities of a file of IES LM-63 (type C). Without power and "
      "flux the file's own candelas; without a light a grey one.");
  with_place(record);
  with_small_radius(record);
  record.required("file", &LampDocument::intensities, file(), "the file");
  with_axis(record, "where the file's straight down points");
  record.with_default(
      "azimuth", &LampDocument::azimuth_rad, quantity(kAngle, Range::between(-360.0, 360.0, "deg")),
      "\"90 deg\"",
      "of the file's plane of 0 deg, clockwise from north; of a lamp that points north or south "
      "that plane holds the vertical");
  with_light(record, true);
  return record.type();
}

}  // namespace

SchemaType<std::vector<LampDocument>> lamps_type() {
  Record<LampDocument> record("lamp", "A body that gives off light, and reflects none.");
  const auto as = [](Form form) {
    return via(
        [form](LampDocument& lamp, LampDocument model) {
          const SourcePosition position = lamp.position;
          lamp = std::move(model);
          lamp.form = form;
          lamp.position = position;
        },
        [form](const LampDocument& lamp) { return lamp.form == form ? &lamp : nullptr; });
  };
  record.exactly_one()
      .one("point", as(Form::point), point_lamp(), "a small ball")
      .one("sphere", as(Form::sphere), sphere_lamp(), "a ball")
      .one("disk", as(Form::disk), disk_lamp(), "one side of a disk")
      .one("spot", as(Form::spot), spot_lamp(), "a cone of light")
      .one("ies", as(Form::goniometer), ies_lamp(), "intensities from a file");
  return list(record.type(), 1, kMostLamps);
}

}  // namespace ifov::io

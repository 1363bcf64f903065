#include "core/format.h"
#include "io/document/cameras/view_settings.h"
#include "io/document/detector_document.h"
#include "io/document/pupil_document.h"
#include "io/document/schema/record.h"
#include "io/document/schema/shared_target.h"
#include "io/document/sensor_document.h"
#include "io/document/spectrometer_document.h"
#include "io/document/tables/own_mounts.h"
#include "io/document/tables/spectrometer_tables.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

struct PsfEntry {
  decltype(SensorDocument::psf) psf;
  SourcePosition position;
};

/// Aperture, wavelength and what covers the middle, of whatever is diffracted at an aperture.
template <class T>
void add_aperture(Record<T>& record) {
  record
      .optional("aperture", &T::aperture_m, quantity(kLength, Range::above(0.0, "m")),
                "diameter; that of the sensor's `optics` if not given")
      .optional(
          "wavelength", &T::wavelength_um, quantity(kWavelength, Range::above(0.0, "um")),
          "for which it is computed, one for all channels; of each channel its own, the middle of its response, if not given")
      .optional(
          "obscuration", &T::obscuration, fraction({0.0, 0.95, false, false, {}}),
          "diameter of what covers the middle of the aperture, over the aperture's; if not given that of `optics` where the "
          "aperture is theirs, else 0");
}

SchemaType<PupilDocument> pupil_type() {
  using Coefficient = PupilDocument::Coefficient;
  Record<Coefficient> coefficient("Zernike coefficient", "A part of a wavefront.");
  coefficient
      .required(
          "noll", &Coefficient::noll, integer(2, 66),
          "the polynomial by Noll's number (1976): 4 defocus, 5 and 6 astigmatism, 7 and 8 coma, 11 spherical aberration; 2 moves "
          "the image to the right, 3 down")
      .exactly_one()
      .one(
          "rms", &Coefficient::rms_m, quantity(kLength),
          "root of its mean square over the whole disc, with its sign, as a path: it counts more where the wavelength is short")
      .one("waves", &Coefficient::rms_waves, number(), "the same in wavelengths, whichever a channel has");
  Record<PupilDocument::Spiders> spiders(
      "spiders", "Vanes across the aperture, from its middle to its rim, evenly around.");
  spiders.required("count", &PupilDocument::Spiders::count, integer(1, 16), "how many")
      .required("width", &PupilDocument::Spiders::width, fraction({0.0, 0.5, true, false, {}}),
                "of each, over the aperture's diameter")
      .with_default("angle", &PupilDocument::Spiders::angle_rad, quantity(kAngle), "\"0 deg\"",
                    "of the first, from the image's right downwards");
  Record<PupilDocument> pupil(
      "pupil PSF",
      "Diffraction of an aperture with vanes in it and a wavefront behind it. Its size in pixels follows from focal length and pitch: the "
      "camera's, or those of `optics` and `detector`.");
  add_aperture(pupil);
  pupil
      .optional("spiders", &PupilDocument::spiders, spiders.type(),
                "what holds the middle; none if not given")
      .optional(
          "defocus", &PupilDocument::defocus_m, quantity(kLength),
          "of the detector from the focus, along the axis: a path of defocus / 8 (f-number)^2 at the rim")
      .optional("zernike", &PupilDocument::zernike, list(coefficient.type(), 1, 65),
                "the wavefront; flat if not given")
      .check([](const PupilDocument& read, const DocumentNode& node) {
        for (std::size_t k = 0; k < read.zernike.size(); ++k)
          for (std::size_t l = 0; l < k; ++l)
            if (read.zernike[l].noll == read.zernike[k].noll)
              node.given("zernike").fail(
                  format("the wavefront has the polynomial {} twice: add them up", read.zernike[k].noll));
      });
  return pupil.type();
}

SchemaType<PsfEntry> psf_type() {
  const Range positive_px = Range::above(0.0, "px");
  Record<GaussianPsf> gaussian("Gaussian PSF", "A bell.");
  gaussian.required("sigma", &GaussianPsf::sigma_px, quantity(kPixels, positive_px),
                    "its standard deviation");
  Record<AiryPsf> airy(
      "Airy PSF",
      "Diffraction of a circular aperture. Its size in pixels follows from focal length and pitch: the camera's, or those of "
      "`optics` and `detector`.");
  add_aperture(airy);
  Record<KernelPsf> kernel("kernel PSF",
                           "An image of the PSF, as a point is seen, its middle where the point is.");
  kernel.required("file", &KernelPsf::file, file(), "the image")
      .required("samples_per_pixel", &KernelPsf::samples_per_pixel, number(Range::above(0.0)),
                "samples of the image along one side of a pixel");
  Record<PsfEntry> record(
      "PSF",
      "Point spread function of the optics, in pixels of the focal plane: where lines, or samples of a sweep, are closer together or "
      "further apart than elements, it is so many more or fewer of them long.");
  record.exactly_one()
      .one("none", &PsfEntry::psf, Record<NoPsf>("no PSF", "Optics without blur.").type(), "no blur")
      .one("gaussian", &PsfEntry::psf, gaussian.type(), "a bell")
      .one("airy", &PsfEntry::psf, airy.type(), "diffraction")
      .one("pupil",
           via(
               [](PsfEntry& entry, PupilDocument pupil) {
                 entry.psf = std::make_shared<const PupilDocument>(std::move(pupil));
               },
               [](const PsfEntry& entry) {
                 const auto* pupil = std::get_if<std::shared_ptr<const PupilDocument>>(&entry.psf);
                 return pupil != nullptr ? std::optional(**pupil) : std::nullopt;
               }),
           pupil_type(), "diffraction with vanes, defocus and a wavefront")
      .one("kernel", &PsfEntry::psf, kernel.type(), "from an image");
  return record.type();
}

/// A sensor of single views in place of a camera.
template <class Settings>
void add_views(Record<SensorDocument>& record, const char* key, const SchemaType<Settings>& type,
               std::string doc) {
  using Placed = std::pair<Settings, SourcePosition>;
  const auto placed = located<Placed>(
      type,
      [](Settings settings, const DocumentNode& node) {
        return Placed(std::move(settings), node.key_position());
      },
      [](const Placed& settings) { return settings.first; });
  record.one(key,
             via(
                 [key](SensorDocument& sensor, Placed settings) {
                   sensor.camera.model = key;
                   sensor.camera.settings = std::make_shared<const Settings>(std::move(settings.first));
                   sensor.camera.position = std::move(settings.second);
                 },
                 [](const SensorDocument& sensor) {
                   const auto* settings = camera_as<Settings>(sensor.camera);
                   return settings != nullptr ? std::optional(Placed(*settings, {})) : std::nullopt;
                 }),
             placed, std::move(doc));
}

/// Where a row puts what counts before the same of a preset, key by key.
template <class V>
auto over_preset(std::shared_ptr<const V> SensorDocument::*member) {
  return via(
      [member](SensorDocument& sensor, V value) {
        const std::shared_ptr<const V> preset = sensor.*member;
        sensor.*member = std::make_shared<const V>(preset ? preset->under(value) : std::move(value));
      },
      [member](const SensorDocument& sensor) { return (sensor.*member).get(); });
}

/// What an image's pixels alone have.
void refuse_for_views(const SensorDocument& sensor, const DocumentNode& node) {
  if (dynamic_cast<const ViewSettings*>(sensor.camera.settings.get()) == nullptr) return;
  for (const char* key :
       {"mount", "psf", "stokes", "fill_factor", "optics", "detector", "smile", "keystone", "mosaic"})
    if (const DocumentNode* own = node.find(key))
      own->fail_at_key(
          format("'{}' is of the pixels of a picture, and '{}' makes none", key, sensor.camera.model));
  for (const ChannelDocument& channel : sensor.channels)
    if (channel.shift_px || channel.smile || channel.keystone)
      node.given("channels")
          .fail_at_key(format(
              "channel '{}' has a {}, which is of the pixels of a picture, and '{}' makes none", channel.name,
              channel.shift_px ? "shift"
              : channel.smile  ? "smile"
                               : "keystone",
              sensor.camera.model));
  for (const ChannelDocument& channel : sensor.channels)
    if (channel.polarizer || channel.retarder)
      node.given("channels")
          .fail_at_key(format(
              "channel '{}' has a polarizer or retarder, which are turned about the axes of a picture, and '{}' makes none",
              channel.name, sensor.camera.model));
}

}  // namespace

SchemaType<SensorDocument> sensor_type() {
  Record<SensorDocument> record("sensor", "What measures.");
  record.exactly_one().one("camera", &SensorDocument::camera, camera_type(), "geometry of the image");
  add_views(record, "distant", distant_type(),
            "instead of an image: what leaves an area towards a list of directions");
  add_views(record, "hemisphere", hemisphere_type(),
            "instead: towards directions all over the hemisphere, and the albedo");
  add_views(record, "points", points_type(), "instead: irradiance and sky view at points");
  add_views(record, "rays", rays_type(), "instead: radiance along rays");
  add_own_mounts(record);
  record.exactly_one()
      .one("channels", &SensorDocument::channels, channels_type(), "spectral channels")
      .one(
          "preset", only_read([](SensorDocument& sensor, SensorDocument preset) {
            sensor.channels = std::move(preset.channels);
            sensor.optics = std::move(preset.optics), sensor.detector = std::move(preset.detector);
            sensor.mosaic = std::move(preset.mosaic);
          }),
          preset_type(),
          "instead: the channels of an instrument and their noise, its optics, detector and mosaic as far as they are published; what the document "
          "says of these counts before them. `ifov sensors` lists the instruments")
      .optional("psf",
                via(
                    [](SensorDocument& sensor, PsfEntry entry) {
                      sensor.psf = std::move(entry.psf);
                      sensor.psf_position = std::move(entry.position);
                    },
                    [](const SensorDocument& sensor) {
                      return std::holds_alternative<NoPsf>(sensor.psf)
                                 ? std::nullopt
                                 : std::optional(PsfEntry{sensor.psf, {}});
                    }),
                psf_type(), "blur of the optics; none if not given")
      .with_default(
          "stokes", &SensorDocument::stokes, boolean(), "false",
          "whether the Stokes vector of light is told, about the axes of the focal plane: products `stokes`, `dolp`, `aop` and "
          "their errors")
      .with_default("fill_factor", &SensorDocument::fill_factor, fraction({0.0, 1.0, true, false, {}}), "1",
                    "sensitive share of a detector element's area, a centred square")
      .optional("optics", over_preset(&SensorDocument::optics), optics_type(),
                "what light passes, for a `detector`")
      .optional("detector", over_preset(&SensorDocument::detector), detector_type(),
                "how light becomes electrons and counts: for `ifov detect`, and errors in shares of noise")
      .optional(
          "smile", shared(&SensorDocument::smile), smile_type(true),
          "how the channels' responses differ from detector column to detector column; not at all if not given")
      .optional(
          "keystone", shared(&SensorDocument::keystone), keystone_type(true),
          "how far across the track what elements see lies from them, by channel and detector column; nowhere if not given")
      .optional(
          "mosaic", shared(&SensorDocument::mosaic), mosaic_type(),
          "filters on the elements of a frame, each of which sees one channel: rows of channels' names, a pattern that repeats from "
          "the upper left element on, such as [[\"red\", \"green\"], [\"green\", \"blue\"]]")
      .check(refuse_for_views);
  return record.type();
}

}  // namespace ifov::io

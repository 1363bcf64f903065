#include <algorithm>

#include "core/format.h"
#include "core/overloaded.h"
#include "io/document/carriers_document.h"
#include "io/document/pupil_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/sensor_tables.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

struct NoPsf {};
struct PsfEntry {
  std::variant<NoPsf, GaussianPsf, AiryPsf, KernelPsf, std::shared_ptr<const PupilDocument>,
               std::shared_ptr<const DiffusionDocument>, std::shared_ptr<const CrosstalkDocument>>
      psf;
};

/// A part that is kept behind a pointer.
template <class Document>
auto kept_apart() {
  return via([](PsfEntry& entry,
                Document document) { entry.psf = std::make_shared<const Document>(std::move(document)); },
             [](const PsfEntry& entry) {
               const auto* held = std::get_if<std::shared_ptr<const Document>>(&entry.psf);
               return held != nullptr ? std::optional(**held) : std::nullopt;
             });
}

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

SchemaType<DiffusionDocument> diffusion_type() {
  using Diffusion = DiffusionDocument;
  const SchemaType<double> length = quantity(kLength, Range::above(0.0, "m"));
  Record<Diffusion> record(
      "carrier diffusion",
      "Carriers that wander sideways before an element takes them. Of light that comes from behind, and is absorbed there, `field_free` "
      "says how far they have to go; of light from the front `depletion`, `length` and `absorption` how many have to and how far they "
      "get. Lengths are made pixels by the pitch: the camera's, or that of `detector`.");
  record.exactly_one()
      .one("field_free", &Diffusion::field_free_m, length,
           "light from behind: thickness of the layer without a field, before the one that takes carriers")
      .one("depletion", &Diffusion::depletion_m, quantity(kLength, Range::at_least(0.0, "m")),
           "light from the front: depth of the field that takes carriers straight; behind it is none")
      .optional("length", &Diffusion::length_m, length,
                "diffusion length; of light from behind endless if not given")
      .optional(
          "absorption", &Diffusion::absorption, spectrum_type(SpectrumOf::number),
          "of light from the front: the absorption coefficient in 1/um, taken at the middle of each channel; a channel with more "
          "of it has less blur")
      .needs("absorption", "depletion")
      .check([](const Diffusion& read, const DocumentNode& node) {
        if (!read.depletion_m) return;
        if (!read.length_m)
          node.fail(
              "light from the front takes the diffusion length of what lies behind the depletion: give 'length'");
        if (!read.absorption)
          node.fail(
              "light from the front takes how deep it goes: give 'absorption', the coefficient in 1/um");
      });
  return record.type();
}

SchemaType<CrosstalkDocument> crosstalk_type() {
  const SchemaType<double> share = fraction({0.0, 0.1, false, false, {}});
  Record<CrosstalkDocument> record(
      "crosstalk", "What elements pass to their neighbours, a pitch away, as shares of what falls on them.");
  record
      .required("share", &CrosstalkDocument::share, share,
                "that each of the four neighbours beside, above and below gets")
      .optional(
          "above", &CrosstalkDocument::above, share,
          "that each of those above and below gets, where it is another: 0 of a single line of elements")
      .optional("corner", &CrosstalkDocument::corner, share,
                "that each of the four at the corners gets; 0 if not given");
  return record.type();
}

/// One part of a PSF, by its key.
SchemaType<PsfEntry> part_type() {
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
      "further apart than elements, it is so many more or fewer of them long. A list is the convolution of its parts: their modulations "
      "are multiplied.");
  record.exactly_one()
      .one("none", &PsfEntry::psf, Record<NoPsf>("no PSF", "Optics without blur.").type(), "no blur")
      .one("gaussian", &PsfEntry::psf, gaussian.type(), "a bell")
      .one("airy", &PsfEntry::psf, airy.type(), "diffraction")
      .one("pupil", kept_apart<PupilDocument>(), pupil_type(),
           "diffraction with vanes, defocus and a wavefront")
      .one("kernel", &PsfEntry::psf, kernel.type(), "from an image")
      .one("diffusion", kept_apart<DiffusionDocument>(), diffusion_type(),
           "carriers that wander in the detector")
      .one("crosstalk", kept_apart<CrosstalkDocument>(), crosstalk_type(),
           "what elements pass to their neighbours");
  return record.type();
}

PsfEntry entry_of(const PsfPart& part) {
  return std::visit([](const auto& one) { return PsfEntry{one}; }, part);
}

std::vector<PsfPart> parts_of(const std::vector<PsfEntry>& entries) {
  std::vector<PsfPart> parts;
  for (const PsfEntry& entry : entries)
    std::visit(Overloaded{[](const NoPsf&) {}, [&](const auto& one) { parts.emplace_back(one); }}, entry.psf);
  return parts;
}

/// Of some kinds there can be one: light is diffracted at one aperture, and elements pass to neighbours what they have.
void refuse_twice(const std::vector<PsfEntry>& entries, const DocumentNode& node) {
  int apertures = 0, crosstalk = 0;
  for (const PsfEntry& entry : entries) {
    apertures += std::holds_alternative<AiryPsf>(entry.psf) ||
                 std::holds_alternative<std::shared_ptr<const PupilDocument>>(entry.psf);
    crosstalk += std::holds_alternative<std::shared_ptr<const CrosstalkDocument>>(entry.psf);
  }
  if (apertures > 1)
    node.fail(format(
        "the PSF is diffracted {} times, and light passes one aperture: give one of 'airy' and 'pupil', once",
        apertures));
  if (crosstalk > 1) node.fail(format("the PSF has crosstalk {} times: give it once", crosstalk));
}

}  // namespace

SchemaType<PlacedPsf> psf_type() {
  constexpr std::size_t kMostParts = 16;
  const SchemaType<PsfEntry> part = part_type();
  using Entries = std::vector<PsfEntry>;
  const auto one = located<PlacedPsf>(
      part,
      [](const PsfEntry& entry, const DocumentNode& node) {
        return PlacedPsf{parts_of({entry}), node.position()};
      },
      [](const PlacedPsf& psf) {
        return psf.parts.size() == 1 ? std::optional(entry_of(psf.parts.front())) : std::nullopt;
      });
  const auto several = located<PlacedPsf>(
      list(part, 1, kMostParts),
      [](const Entries& entries, const DocumentNode& node) {
        refuse_twice(entries, node);
        return PlacedPsf{parts_of(entries), node.position()};
      },
      [](const PlacedPsf& psf) {
        Entries entries;
        for (const PsfPart& one_part : psf.parts) entries.push_back(entry_of(one_part));
        return entries;
      });
  return either(one, several);
}

}  // namespace ifov::io

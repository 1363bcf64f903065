#include "session/assembly/whole/psf_assembly.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/overloaded.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/carriers_document.h"
#include "io/document/detector_document.h"
#include "io/document/psf_document.h"
#include "io/document/pupil_document.h"
#include "io/document/sensor_document.h"
#include "io/raster/raster.h"
#include "sensor/airy_aperture.h"
#include "sensor/mtf.h"
#include "sensor/optics/carrier_diffusion.h"
#include "sensor/optics/halo.h"
#include "sensor/optics/psf_product.h"
#include "sensor/psf.h"
#include "sensor/pupil.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

/// Of a PSF within its cut.
constexpr double kFarthestPsf_px = 64.0;

/// What a Gaussian leaves out by itself; likewise what is convolved without wings.
constexpr double kUsuallyLeftOut = 2.2e-5;

using PupilPointer = std::shared_ptr<const io::PupilDocument>;
using DiffusionPointer = std::shared_ptr<const io::DiffusionDocument>;
using CrosstalkPointer = std::shared_ptr<const io::CrosstalkDocument>;

std::span<const io::PsfPart> all_parts(const io::SensorDocument& sensor) {
  return sensor.psf ? std::span<const io::PsfPart>(sensor.psf->parts) : std::span<const io::PsfPart>();
}

/// The only part of a kind; null where there is none.
template <class Part>
const Part* part_of(const io::SensorDocument& sensor) {
  for (const io::PsfPart& part : all_parts(sensor))
    if (const auto* found = std::get_if<Part>(&part)) return found;
  return nullptr;
}

}  // namespace

std::optional<io::AiryPsf> diffraction_of(const io::SensorDocument& sensor) {
  if (const auto* airy = part_of<io::AiryPsf>(sensor)) return *airy;
  const auto* pupil = part_of<PupilPointer>(sensor);
  if (pupil == nullptr) return std::nullopt;
  return io::AiryPsf{(*pupil)->aperture_m, (*pupil)->wavelength_um, (*pupil)->obscuration};
}

namespace {

/// Between elements: the camera's, or the detector's.
double focal_pitch_m(const io::SensorDocument& sensor) {
  const auto camera = sensor.camera.settings->optics();
  return camera ? camera->pitch_m : sensor.detector->pitch_m.value();
}

}  // namespace

sensor::AiryAperture airy_aperture(const io::SensorDocument& sensor) {
  const io::AiryPsf airy = diffraction_of(sensor).value();
  const io::OpticsDocument none;
  const io::OpticsDocument& optics = sensor.optics ? *sensor.optics : none;
  const auto camera = sensor.camera.settings->optics();
  sensor::AiryAperture made;
  made.wavelength_um = airy.wavelength_um.value_or(0.0);
  made.pitch_m = focal_pitch_m(sensor);
  const std::optional<double> focal_length_m =
                                  camera ? std::optional(camera->focal_length_m) : optics.focal_length_m,
                              aperture_m = airy.aperture_m ? airy.aperture_m : optics.aperture_m;
  if (aperture_m && focal_length_m)
    made.diameter_m = *aperture_m, made.focal_length_m = *focal_length_m;
  else
    made.diameter_m = 1.0, made.focal_length_m = optics.f_number.value();
  made.obscuration = airy.obscuration.value_or(airy.aperture_m ? 0.0 : optics.obscuration);
  return made;
}

sensor::Pupil assemble_pupil(const io::SensorDocument& sensor, double wavelength_um) {
  const io::PupilDocument& told = **part_of<PupilPointer>(sensor);
  sensor::Pupil pupil;
  pupil.aperture = airy_aperture(sensor);
  if (!(pupil.aperture.wavelength_um > 0.0)) pupil.aperture.wavelength_um = wavelength_um;
  if (told.spiders) {
    pupil.spiders = told.spiders->count;
    pupil.spider_width = told.spiders->width;
    pupil.spider_angle_rad = told.spiders->angle_rad;
  }
  pupil.defocus_m = told.defocus_m.value_or(0.0);
  for (const io::PupilDocument::Coefficient& one : told.zernike)
    pupil.wavefront.push_back({one.noll, one.rms_m.value_or(0.0), one.rms_waves.value_or(0.0)});
  return pupil;
}

namespace {

/// Where to cut a Gaussian, sigmas, beside things that are `contrast` times as bright as the rest: what is left out of them is 1e-4 of the rest at
/// most, unless more than `widest_px` would be kept. 4.4 to 8.
double gaussian_cut_sigmas(double sigma_px, double contrast, double widest_px) {
  constexpr double kLeast = 4.4, kMost = 8.0, kStep = 0.1, kLeftOut = 1e-4;
  double cut = kLeast;
  const auto left_out = [&] {
    const double kept = std::erf(cut / std::numbers::sqrt2);
    return 1.0 - kept * kept;
  };
  while (contrast * left_out() > kLeftOut && cut + kStep <= std::min(kMost, widest_px / sigma_px))
    cut += kStep;
  return cut;
}

sensor::CarrierDiffusion diffusion_of(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                                      const io::DiffusionDocument& told, double wavelength_um) {
  const double pitch_m = focal_pitch_m(sensor);
  sensor::CarrierDiffusion diffusion;
  diffusion.field_free_px = told.field_free_m.value_or(0.0) / pitch_m;
  if (told.length_m) diffusion.length_px = *told.length_m / pitch_m;
  diffusion.depletion_px = told.depletion_m.value_or(0.0) / pitch_m;
  if (!told.absorption) return diffusion;
  const double per_um = with_position(sources, told.absorption->position, [&] {
    return assemble_spectrum(sources, *told.absorption, "absorption").at(wavelength_um);
  });
  if (!(per_um > 0.0))
    throw io::document_error(
        sources, told.absorption->position,
        format(
            "the absorption coefficient is {:g} /um at {:g} um: expected more than 0, or no light becomes carriers there",
            per_um, wavelength_um));
  diffusion.absorption_per_px = 1e6 * per_um * pitch_m;
  return diffusion;
}

std::optional<sensor::Halo> halo_of(const io::SensorDocument& sensor) {
  if (!sensor.optics || !sensor.optics->stray_light) return std::nullopt;
  const io::OpticsDocument::StrayLight& told = *sensor.optics->stray_light;
  if (!(told.share > 0.0)) return std::nullopt;
  return sensor::Halo{told.share, told.radius_px};
}

sensor::Crosstalk crosstalk_of(const io::CrosstalkDocument& told) {
  return {told.share, told.above.value_or(told.share), told.corner.value_or(0.0)};
}

std::unique_ptr<sensor::Psf> kernel_of(const io::KernelPsf& kernel) {
  const io::Raster raster = io::read_raster(kernel.file.path);
  std::vector<double> values(
      raster.values.begin(),
      raster.values.begin() + static_cast<std::ptrdiff_t>(raster.width) * raster.height);
  return sensor::make_kernel_psf(raster.width, raster.height, std::move(values), kernel.samples_per_pixel);
}

sensor::PsfParts parts_of(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                          double wavelength_um) {
  sensor::PsfParts parts;
  for (const io::PsfPart& part : all_parts(sensor))
    std::visit(
        Overloaded{[&](const io::GaussianPsf& gaussian) { parts.sigmas_px.push_back(gaussian.sigma_px); },
                   [&](const io::AiryPsf&) {
                     sensor::AiryAperture aperture = airy_aperture(sensor);
                     if (!(aperture.wavelength_um > 0.0)) aperture.wavelength_um = wavelength_um;
                     parts.diffracted =
                         sensor::make_airy_psf(aperture, sensor::airy_energy_to_trace(aperture));
                   },
                   [&](const PupilPointer&) {
                     parts.diffracted = sensor::make_pupil_psf(assemble_pupil(sensor, wavelength_um));
                   },
                   [&](const io::KernelPsf& kernel) { parts.images.push_back(kernel_of(kernel)); },
                   [&](const DiffusionPointer& diffusion) {
                     parts.diffusion.push_back(diffusion_of(sources, sensor, *diffusion, wavelength_um));
                   },
                   [](const CrosstalkPointer&) {}},
        part);
  return parts;
}

/// Without crosstalk; null where there is nothing else.
std::unique_ptr<const sensor::Psf> convolved(sensor::PsfParts parts, double contrast) {
  double square = 0.0;
  for (const double sigma : parts.sigmas_px) square += sigma * sigma;
  const std::size_t known = parts.images.size() + (parts.diffracted ? 1 : 0);
  const bool smooth = square > 0.0 || !parts.diffusion.empty();
  if (known == 0 && parts.diffusion.empty()) {
    if (!(square > 0.0)) return nullptr;
    // Of Gaussians alone their variances add up.
    const double sigma_px = std::sqrt(square);
    return sensor::make_gaussian_psf(sigma_px, gaussian_cut_sigmas(sigma_px, contrast, kFarthestPsf_px));
  }
  if (known == 1 && !smooth) return std::move(parts.diffracted ? parts.diffracted : parts.images.front());
  constexpr double kMostMissing = 1e-4;
  return sensor::make_product_psf(std::move(parts), std::min(kUsuallyLeftOut, kMostMissing / contrast));
}

}  // namespace

bool psf_depends_on_wavelength(const io::SensorDocument& sensor) {
  const std::optional<io::AiryPsf> diffraction = diffraction_of(sensor);
  if (diffraction && !diffraction->wavelength_um) return true;
  const auto* diffusion = part_of<DiffusionPointer>(sensor);
  return diffusion != nullptr && (*diffusion)->absorption;
}

bool psf_grows_with_wavelength(const io::SensorDocument& sensor) {
  const auto* diffusion = part_of<DiffusionPointer>(sensor);
  return diffusion == nullptr || !(*diffusion)->absorption;
}

bool psf_has_tails(const io::SensorDocument& sensor) {
  return !diffraction_of(sensor) &&
         (part_of<io::GaussianPsf>(sensor) != nullptr || part_of<DiffusionPointer>(sensor) != nullptr);
}

std::unique_ptr<const sensor::Psf> assemble_psf(const io::DocumentSources& sources,
                                                const io::SensorDocument& sensor, double wavelength_um,
                                                double contrast) {
  return with_position(sources, sensor.psf_position, [&]() -> std::unique_ptr<const sensor::Psf> {
    const auto* crosstalk = part_of<CrosstalkPointer>(sensor);
    const std::optional<sensor::Halo> halo = halo_of(sensor);
    const auto made_for = [&](double brightest) -> std::unique_ptr<const sensor::Psf> {
      std::unique_ptr<const sensor::Psf> made =
          convolved(parts_of(sources, sensor, wavelength_um), brightest);
      if (crosstalk != nullptr) made = sensor::with_crosstalk(std::move(made), crosstalk_of(**crosstalk));
      if (halo) made = sensor::with_halo(std::move(made), *halo);
      return made;
    };
    std::unique_ptr<const sensor::Psf> made = made_for(contrast);
    const auto too_wide = [&] { return made != nullptr && made->half_width_px() > kFarthestPsf_px; };
    if (too_wide() && contrast > 1.0) made = made_for(1.0);  // what is left out stands in the interval
    if (too_wide())
      throw InputError(format(
          "the PSF reaches {:.4g} pixels from its middle, and images are blurred within {:g}; expected a narrower one, or wider "
          "pixels",
          made->half_width_px(), kFarthestPsf_px));
    return made;
  });
}

std::optional<double> psf_mtf(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                              double wavelength_um, double cycles_px) {
  double product = 1.0;
  for (const io::PsfPart& part : all_parts(sensor)) {
    const std::optional<double> own = std::visit(
        Overloaded{[&](const io::GaussianPsf& psf) -> std::optional<double> {
                     return sensor::gaussian_mtf(psf.sigma_px, cycles_px);
                   },
                   [&](const io::AiryPsf&) -> std::optional<double> {
                     const sensor::AiryAperture airy = airy_aperture(sensor);
                     const double um = airy.wavelength_um > 0.0 ? airy.wavelength_um : wavelength_um;
                     const double q_px = 1e-6 * um * airy.focal_length_m / (airy.diameter_m * airy.pitch_m);
                     return sensor::diffraction_mtf(q_px, airy.obscuration, cycles_px);
                   },
                   [&](const PupilPointer&) -> std::optional<double> {
                     const sensor::Pupil pupil = assemble_pupil(sensor, wavelength_um);
                     sensor::check_pupil(pupil);
                     return sensor::pupil_mtf(pupil, cycles_px);
                   },
                   [&](const DiffusionPointer& diffusion) -> std::optional<double> {
                     return diffusion_of(sources, sensor, *diffusion, wavelength_um).mtf(cycles_px);
                   },
                   [&](const CrosstalkPointer& psf) -> std::optional<double> {
                     return crosstalk_of(*psf).mtf(cycles_px);
                   },
                   [](const io::KernelPsf&) -> std::optional<double> { return std::nullopt; }},
        part);
    if (!own) return std::nullopt;
    product *= *own;
  }
  if (const std::optional<sensor::Halo> halo = halo_of(sensor))
    return (1.0 - halo->share) * product + halo->share * halo->mtf(cycles_px);
  return product;
}

}  // namespace ifov::session

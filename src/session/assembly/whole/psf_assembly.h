#pragma once

#include <memory>
#include <optional>

namespace ifov::io {
struct AiryPsf;
struct DocumentSources;
struct SensorDocument;
}  // namespace ifov::io
namespace ifov::sensor {
class Psf;
struct AiryAperture;
struct Pupil;
}  // namespace ifov::sensor

namespace ifov::session {

/// What a PSF of diffraction says of its aperture; nothing where it is another.
std::optional<io::AiryPsf> diffraction_of(const io::SensorDocument& sensor);
/// Of a PSF of a pupil, at a wavelength where it states none.
sensor::Pupil assemble_pupil(const io::SensorDocument& sensor, double wavelength_um);
/// Diffraction as an Airy PSF has it, in lengths whose ratios are right; the wavelength 0 where it is each channel's own.
sensor::AiryAperture airy_aperture(const io::SensorDocument& sensor);
/// At a wavelength, where the document says none; null without one: perfect optics. `contrast`: how many times as bright as the rest the
/// brightest is.
std::unique_ptr<const sensor::Psf> assemble_psf(const io::DocumentSources& sources,
                                                const io::SensorDocument& sensor, double wavelength_um,
                                                double contrast);

/// Whether channels of other wavelengths have others.
bool psf_depends_on_wavelength(const io::SensorDocument& sensor);
/// Whether it grows with the wavelength, as far as it changes at all.
bool psf_grows_with_wavelength(const io::SensorDocument& sensor);
/// Whether it has no end by itself, and no wings: what is beside something bright says how much is kept.
bool psf_has_tails(const io::SensorDocument& sensor);
/// Of all its parts, at cycles a pixel of the focal plane along x; nothing where one is known as an image alone.
std::optional<double> psf_mtf(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                              double wavelength_um, double cycles_px);

}  // namespace ifov::session

#include "sensor/pupil.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "sensor/mtf.h"
#include "sensor/zernike.h"

namespace ifov::sensor {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
constexpr double kMostObscured = 0.95, kWidestSpider = 0.5;
constexpr int kMostSpiders = 16;

}  // namespace

double Pupil::q_px() const {
  return aperture.wavelength_um * 1e-6 * aperture.focal_length_m / (aperture.diameter_m * aperture.pitch_m);
}

bool Pupil::passes(double x, double y) const {
  const double r2 = x * x + y * y;
  if (r2 > 1.0 || r2 < aperture.obscuration * aperture.obscuration) return false;
  for (int k = 0; k < spiders; ++k) {
    const double angle = spider_angle_rad + 2.0 * kHalfTurn * k / spiders, c = std::cos(angle),
                 s = std::sin(angle);
    if (x * c + y * s > 0.0 && std::abs(y * c - x * s) < spider_width) return false;
  }
  return true;
}

double Pupil::wavefront_waves(double x, double y) const {
  const double wavelength_m = 1e-6 * aperture.wavelength_um;
  const double f_number = aperture.focal_length_m / aperture.diameter_m;
  double waves = defocus_m / (8.0 * f_number * f_number * wavelength_m) * (x * x + y * y);
  for (const Coefficient& one : wavefront)
    waves += (one.rms_m / wavelength_m + one.rms_waves) * zernike(one.noll, x, y);
  return waves;
}

void check_pupil(const Pupil& pupil) {
  const AiryAperture& aperture = pupil.aperture;
  for (const double value :
       {aperture.wavelength_um, aperture.diameter_m, aperture.focal_length_m, aperture.pitch_m})
    if (!(value > 0.0) || !std::isfinite(value))
      throw InputError(
          "the PSF of a pupil needs a positive wavelength, aperture diameter, focal length and detector pitch");
  if (!(aperture.obscuration >= 0.0) || !(aperture.obscuration <= kMostObscured))
    throw InputError(format("a pupil with {} of its diameter covered; expected 0 to {}", aperture.obscuration,
                            kMostObscured));
  if (pupil.spiders < 0 || pupil.spiders > kMostSpiders)
    throw InputError(format("a pupil with {} vanes; expected 0 to {}", pupil.spiders, kMostSpiders));
  if (!(pupil.spider_width >= 0.0) || !(pupil.spider_width <= kWidestSpider))
    throw InputError(format("a pupil with vanes as wide as {} of its diameter; expected 0 to {}",
                            pupil.spider_width, kWidestSpider));
  for (const Pupil::Coefficient& one : pupil.wavefront)
    if (one.noll < kFirstNoll || one.noll > kLastNoll || !std::isfinite(one.rms_m + one.rms_waves))
      throw InputError(
          format("a wavefront with Noll's number {}; expected {} to {}", one.noll, kFirstNoll, kLastNoll));
  if (!std::isfinite(pupil.defocus_m)) throw InputError("a pupil's defocus must be finite");
  const double q_px = pupil.q_px();
  if (!(q_px > 1e-3) || !(q_px < 100.0))
    throw InputError(
        format("a pupil's PSF with wavelength times f-number of {:.3g} px; expected 0.001 to 100 px", q_px));
}

PupilCells pupil_cells(const Pupil& pupil, std::size_t across, double side, bool means) {
  constexpr int kParts = 8;
  PupilCells cells{across, {}, 0.0};
  cells.amplitude.reserve(across * across);
  const double first = -0.5 * static_cast<double>(across) * side;
  for (std::size_t j = 0; j < across; ++j)
    for (std::size_t i = 0; i < across; ++i) {
      const double x = first + static_cast<double>(i) * side, y = first + static_cast<double>(j) * side;
      int open = 0;
      double mx = 0.0, my = 0.0;  // of what is open, summed
      for (int b = 0; b < kParts; ++b)
        for (int a = 0; a < kParts; ++a) {
          const double px = x + (a + 0.5) * side / kParts, py = y + (b + 0.5) * side / kParts;
          if (!pupil.passes(px, py)) continue;
          ++open, mx += px, my += py;
        }
      if (open == 0) {
        cells.amplitude.emplace_back();
        continue;
      }
      const double share = static_cast<double>(open) / (kParts * kParts), cx = mx / open, cy = my / open;
      cells.open += share;
      double mean = 1.0;
      if (means && !pupil.is_flat()) {
        const double half = 0.5 * side;
        const auto of_turn = [](double waves) { return square_mtf(1.0, waves); };
        mean = of_turn(pupil.wavefront_waves(cx + half, cy) - pupil.wavefront_waves(cx - half, cy)) *
               of_turn(pupil.wavefront_waves(cx, cy + half) - pupil.wavefront_waves(cx, cy - half));
      }
      cells.amplitude.push_back(std::polar(1.0, -2.0 * kHalfTurn * pupil.wavefront_waves(cx, cy)) *
                                (share * mean));
    }
  return cells;
}

double strehl_ratio(const Pupil& pupil) {
  constexpr std::size_t kAcross = 256;
  std::complex<double> sum;
  double all = 0.0;
  for (const std::complex<double>& a : pupil_cells(pupil, kAcross, 2.0 / kAcross, false).amplitude)
    sum += a, all += std::abs(a);
  return all > 0.0 ? std::norm(sum) / (all * all) : 0.0;
}

double pupil_mtf(const Pupil& pupil, double cycles_px) {
  constexpr double kCells = 192.0;  // about, along the diameter: as many as let the shift be whole cells
  const double shift = pupil.q_px() * std::abs(cycles_px);  // in diameters
  if (!(shift < 1.0)) return 0.0;
  if (shift * kCells < 1.0) {  // nearly straight there
    const double first = shift > 0.0 ? pupil_mtf(pupil, std::abs(cycles_px) * 1.001 / (shift * kCells)) : 1.0;
    return std::lerp(1.0, first, shift * kCells);
  }
  const double steps = std::round(shift * kCells), side = 2.0 * shift / steps;
  const auto offset = static_cast<std::size_t>(steps);
  const PupilCells cells = pupil_cells(pupil, static_cast<std::size_t>(std::ceil(2.0 / side)), side, false);
  std::complex<double> sum;
  for (std::size_t j = 0; j < cells.across; ++j) {
    const std::complex<double>* row = &cells.amplitude[j * cells.across];
    for (std::size_t i = 0; i + offset < cells.across; ++i) sum += row[i] * std::conj(row[i + offset]);
  }
  return cells.open > 0.0 ? std::abs(sum) / cells.open : 0.0;
}

}  // namespace ifov::sensor

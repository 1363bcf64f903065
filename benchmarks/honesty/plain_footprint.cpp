#include "honesty/plain_footprint.h"

#include <math.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <variant>

#include "io/document/cameras/camera_settings.h"
#include "io/document/psf_document.h"

namespace ifov::benchmarks {

namespace {

constexpr int kQuantiles = 1024;
constexpr double kTail_sigmas = 6.0;

double normal_distribution(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double normal_ramp(double z) {
  return z * normal_distribution(z) + std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}

/// Radius within which an Airy pattern has this share of its energy, in units of q: 1 - J0(v)^2 - J1(v)^2 with
/// v = pi r / q (Born and Wolf, Principles of Optics, 8.5.2).
double airy_radius(double energy) {
  double low = 0.0, high = 4.0 / std::max(1e-12, 1.0 - energy);
  for (int k = 0; k < 60; ++k) {
    const double v = 0.5 * (low + high);
    const double inside = 1.0 - ::j0(v) * ::j0(v) - ::j1(v) * ::j1(v);
    (inside < energy ? low : high) = v;
  }
  return 0.5 * (low + high) / std::numbers::pi;
}

}  // namespace

PlainFootprint::PlainFootprint(const io::SensorDocument& sensor) : side_px_(std::sqrt(sensor.fill_factor)) {
  reach_px_ = 0.5 * side_px_;
  if (sensor.psf == nullptr) return;
  if (sensor.psf->parts.size() != 1)
    throw std::runtime_error("the plain tracer knows no PSF of several parts");
  const io::PsfPart& psf = sensor.psf->parts.front();
  if (const auto* gaussian = std::get_if<io::GaussianPsf>(&psf)) {
    sigma_px_ = gaussian->sigma_px;
    reach_px_ += kTail_sigmas * sigma_px_;
    for (int k = 0; k <= kQuantiles; ++k) {
      double low = -reach_px_ - 4.0 * sigma_px_, high = -low;
      for (int step = 0; step < 60; ++step) {
        const double x = 0.5 * (low + high);
        (distribution(x) < static_cast<double>(k) / kQuantiles ? low : high) = x;
      }
      quantiles_.push_back(0.5 * (low + high));
    }
  } else if (const auto* airy = std::get_if<io::AiryPsf>(&psf)) {
    const auto camera = sensor.camera.settings->optics();
    if (!camera) throw std::runtime_error("an Airy pattern without a frame camera");
    airy_q_px_ = airy->wavelength_um.value() * 1e-6 * camera->focal_length_m /
                 (airy->aperture_m.value() * camera->pitch_m);
    reach_px_ = std::numeric_limits<double>::infinity();
  } else {
    throw std::runtime_error("the plain tracer knows no PSF but a Gaussian and an Airy pattern");
  }
}

double PlainFootprint::profile(double x_px) const {
  const double half = 0.5 * side_px_;
  if (sigma_px_ == 0.0) return std::abs(x_px) <= half ? 1.0 / side_px_ : 0.0;
  return (normal_distribution((x_px + half) / sigma_px_) - normal_distribution((x_px - half) / sigma_px_)) /
         side_px_;
}

double PlainFootprint::distribution(double x_px) const {
  const double half = 0.5 * side_px_;
  return sigma_px_ * (normal_ramp((x_px + half) / sigma_px_) - normal_ramp((x_px - half) / sigma_px_)) /
         side_px_;
}

double PlainFootprint::quantile(double u) const {
  const double place = u * kQuantiles;
  const auto cell = static_cast<std::size_t>(place);
  double low = quantiles_[cell], high = quantiles_[cell + 1];
  double x = low + (place - static_cast<double>(cell)) * (high - low);
  for (int step = 0; step < 20 && high - low > 1e-9; ++step) {  // Newton's, kept within what is known
    const double error = distribution(x) - u;
    (error < 0.0 ? low : high) = x;
    const double next = x - error / profile(x);
    if (std::abs(next - x) < 1e-9) break;
    x = next > low && next < high ? next : 0.5 * (low + high);
  }
  return x;
}

sampling::FocalPoint PlainFootprint::draw(double u1, double u2, RandomStream& random) const {
  if (airy_q_px_ > 0.0) {
    const double radius = airy_q_px_ * airy_radius(u1), angle = 2.0 * std::numbers::pi * u2;
    return {radius * std::cos(angle) + side_px_ * (random.uniform() - 0.5),
            radius * std::sin(angle) + side_px_ * (random.uniform() - 0.5)};
  }
  if (sigma_px_ > 0.0) return {quantile(u1), quantile(u2)};
  return {side_px_ * (u1 - 0.5), side_px_ * (u2 - 0.5)};
}

double PlainFootprint::density(double dx_px, double dy_px) const { return profile(dx_px) * profile(dy_px); }

}  // namespace ifov::benchmarks

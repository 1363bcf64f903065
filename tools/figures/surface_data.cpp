#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "figure_data.h"
#include "materials/bsdf/oren_nayar.h"
#include "materials/bsdf/ross_li.h"
#include "materials/bsdf/rpv.h"
#include "radiometry/fresnel.h"
#include "radiometry/solar_spectrum.h"
#include "radiometry/spectral_nodes.h"
#include "sampling/pixel_footprint.h"
#include "sensor/airy_aperture.h"
#include "sensor/psf.h"
#include "sensor/psf_wings.h"

namespace ifov::figures {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// In the principal plane; angles above 0 are on the side of the light.
void print_lobe(const char* name, const materials::Bsdf& bsdf, double light_deg) {
  std::vector<float> rows;
  for (const radiometry::Spectrum& spectrum : bsdf.spectra())
    rows.push_back(static_cast<float>(spectrum.at(0.5)));
  std::vector<const float*> parameters;
  for (const float& value : rows) parameters.push_back(&value);
  for (int k = -160; k <= 160; ++k) {
    const double view = 0.5 * k * kDegree;
    materials::BsdfEvent event;
    event.normal = {0.0, 0.0, 1.0};
    event.incoming = {std::sin(light_deg * kDegree), 0.0, std::cos(light_deg * kDegree)};
    event.outgoing = {std::sin(view), 0.0, std::cos(view)};
    event.tangent = {1.0, 0.0, 0.0};
    float f = 0.0f;
    bsdf.evaluate(event, parameters, 1, &f);
    std::printf("%s %.1f %.6f\n", name, 0.5 * k, std::numbers::pi * static_cast<double>(f));
  }
}

}  // namespace

void print_bsdf() {
  using radiometry::Spectrum;
  const double light_deg = 30.0;
  print_lobe("oren_nayar", materials::OrenNayar(Spectrum::constant(0.3), 30.0 * kDegree), light_deg);
  print_lobe("rpv", materials::Rpv(Spectrum::constant(0.076), 0.648, -0.29), light_deg);
  print_lobe("ross_li",
             materials::RossLi(Spectrum::constant(0.3), Spectrum::constant(0.15), Spectrum::constant(0.02),
                               1.5 * kDegree),
             light_deg);
  print_lobe("ross_li_no_hot_spot",
             materials::RossLi(Spectrum::constant(0.3), Spectrum::constant(0.15), Spectrum::constant(0.02)),
             light_deg);
}

void print_footprint() {
  sensor::AiryAperture aperture;  // q = 1 px
  aperture.wavelength_um = 1.0;
  aperture.diameter_m = 0.1;
  aperture.focal_length_m = 1.0;
  aperture.pitch_m = 10e-6;
  const auto airy = sensor::make_airy_psf(aperture);
  const auto gaussian = sensor::make_gaussian_psf(0.5);
  const std::pair<const char*, const sensor::Psf*> psfs[] = {
      {"none", nullptr}, {"gaussian", gaussian.get()}, {"airy", airy.get()}};
  for (const auto& [name, psf] : psfs) {
    const sampling::PixelFootprint footprint = sensor::make_footprint(psf, 1.0);
    std::printf("half_width %s %.5f\n", name, footprint.half_width_px());
    for (int k = -400; k <= 400; k += 2)
      std::printf("h %s %.4f %.7f\n", name, 0.01 * k, footprint.density(0.01 * k, 0.0));
  }
  for (int k = 1; k <= 400; ++k) {
    const double r = 1e-2 * std::pow(2e4, k / 400.0);
    const double side = 0.02 * r;  // a small square on the x axis
    const double core = r < airy->half_width_px() ? airy->energy(r - side, -side, r + side, side) /
                                                        (4.0 * side * side) * airy->kept()
                                                  : 0.0;
    std::printf("airy %.5f %.6e %.6e\n", r, core, airy->cut_density(r, 0.0, true));
  }
  std::printf("kept %.5f %.5f\n", airy->kept(), airy->half_width_px());
}

void print_nodes() {
  using radiometry::Spectrum;
  // A leaf's red edge, and sand beside it, in a channel of 60 nm.
  const Spectrum leaf({0.62, 0.68, 0.70, 0.72, 0.74, 0.76, 0.80}, {0.06, 0.05, 0.12, 0.27, 0.40, 0.46, 0.48});
  const radiometry::Channel channel = radiometry::Channel::gaussian("red edge", 0.715, 0.03);
  const Spectrum& sun = radiometry::solar_irradiance_1au();
  const Spectrum surfaces[] = {leaf};
  for (const double tolerance : {0.1, 0.01, 0.002, 7e-4, 1e-4}) {
    radiometry::NodeDemands demands;
    demands.tolerance = tolerance;
    demands.hottest_k = 0.0;
    const auto nodes = radiometry::SpectralNodes::build({&channel, 1}, sun, surfaces, demands);
    std::vector<float> rho(nodes.node_count()), source(nodes.node_count());
    nodes.average_surface(leaf, rho);
    nodes.average_source(sun, source);
    std::array<double, 5> moments{};
    for (std::size_t i = 0; i < rho.size(); ++i) {
      double product = nodes.node_weight(i) * static_cast<double>(source[i]);
      for (double& moment : moments) {
        moment += product;
        product *= static_cast<double>(rho[i]);
      }
      std::printf("node %zu %.6f %.6f %.6f\n", nodes.node_count(), nodes.node_wavelength_um(i),
                  nodes.node_weight(i), static_cast<double>(rho[i]));
    }
    std::printf("moments %zu", nodes.node_count());
    for (const double moment : moments) std::printf(" %.8f", moment);
    std::printf("\n");
  }
  std::array<const Spectrum*, 6> factors{&channel.response, &sun, &leaf, &leaf, &leaf, &leaf};
  std::printf("moments 0");
  const double whole =
      radiometry::integral(channel.response, channel.response.first_um(), channel.response.last_um());
  for (std::size_t reflections = 0; reflections <= 4; ++reflections)
    std::printf(" %.8f",
                radiometry::integral_of_product(std::span(factors).first(2 + reflections),
                                                channel.response.first_um(), channel.response.last_um()) /
                    whole);
  std::printf("\n");
  for (int k = 0; k <= 120; ++k) {
    const double um = 0.655 + 0.001 * k;
    std::printf("spectrum %.4f %.5f %.5f %.2f\n", um, leaf.at(um), channel.response.at(um), sun.at(um));
  }
}

void print_fresnel() {
  for (int k = 0; k <= 180; ++k) {
    const double angle = 0.5 * k * kDegree;
    const radiometry::FresnelAmplitudes r =
        radiometry::fresnel_reflection_amplitudes({1.333, 0.0}, std::cos(angle));
    std::printf("water %.2f %.6f %.6f\n", 0.5 * k, std::norm(r.p), std::norm(r.s));
  }
}

}  // namespace ifov::figures

#include "transport/sky/material_ground.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "atmosphere/scattering/ground/directional_ground.h"
#include "core/error.h"
#include "core/format.h"
#include "materials/bsdf/node_bsdf.h"
#include "materials/material.h"
#include "radiometry/spectral_nodes.h"
#include "radiometry/spectrum_block.h"

namespace ifov::transport {
namespace {

using atmosphere::GroundEvent;
using atmosphere::GroundMatrix;

/// Azimuths of events count from the direction of sunlight.
class Events {
 public:
  explicit Events(double sun_azimuth_rad)
      : sunlight_rad_(0.5 * std::numbers::pi - sun_azimuth_rad + std::numbers::pi) {}
  materials::BsdfEvent of(const GroundEvent& event) const {
    materials::BsdfEvent result;
    result.outgoing = along(event.out_mu, event.out_azimuth_rad);
    result.incoming = -along(event.in_mu, event.in_azimuth_rad);
    result.normal = {0.0, 0.0, 1.0};
    result.tangent = {1.0, 0.0, 0.0};
    return result;
  }

 private:
  math::Vec3 along(double mu, double azimuth_rad) const {
    const double sine = std::sqrt(std::max(0.0, 1.0 - mu * mu)), angle = sunlight_rad_ + azimuth_rad;
    return {sine * std::cos(angle), sine * std::sin(angle), mu};
  }
  double sunlight_rad_;
};

class GroundNodes final : public atmosphere::GroundAtNodes {
 public:
  GroundNodes(const materials::Material& material, const Events& events,
              const radiometry::SpectralNodes& nodes, bool polarized)
      : events_(events),
        nodes_(nodes.node_count()),
        model_(material.bsdf, nodes, polarized),
        polarizes_(polarized && material.bsdf->polarizes()) {}

  void albedo(double mu, std::span<double> nodes) const override {
    radiometry::SpectrumBlock rows(2, nodes_);
    model_.emissivity(mu, rows.row(0), rows.row(1));
    for (std::size_t n = 0; n < nodes_; ++n) nodes[n] = 1.0 - static_cast<double>(rows.row(0)[n]);
  }

  void add_reflected(const GroundEvent& event, std::span<const double> incoming,
                     std::span<double> light) const override {
    const materials::BsdfEvent there = events_.of(event);
    static thread_local radiometry::SpectrumBlock rows;
    if (rows.rows() != 16 || rows.columns() != nodes_) rows.resize(16, nodes_);
    if (!polarizes_ || light.size() < 3 * nodes_) {
      model_.evaluate(there, rows.row(0));
      for (std::size_t n = 0; n < nodes_; ++n) light[n] += static_cast<double>(rows.row(0)[n]) * incoming[n];
      return;
    }
    model_.evaluate_mueller(there, {rows.row(0), rows.stride(), true});
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column) {
        const float* element = rows.row(4 * column + row);
        for (std::size_t n = 0; n < nodes_; ++n)
          light[row * nodes_ + n] += static_cast<double>(element[n]) * incoming[column * nodes_ + n];
      }
  }

 private:
  Events events_;
  std::size_t nodes_;
  materials::NodeBsdf model_;
  bool polarizes_;
};

/// Of a model that is not separable: Lambertian ground and mirrors are none (material_ground).
class MaterialGround final : public atmosphere::DirectionalGround {
 public:
  MaterialGround(const materials::Material& material, double sun_azimuth_rad)
      : material_(material), events_(sun_azimuth_rad) {}

  bool is_isotropic() const override { return material_.bsdf->is_isotropic(); }
  bool polarizes() const override { return material_.bsdf->polarizes(); }

  void reflect(double wavelength_um, std::span<const GroundEvent> events,
               std::span<GroundMatrix> brdf) const override {
    const materials::Bsdf& bsdf = *material_.bsdf;
    radiometry::SpectrumBlock parameters(bsdf.spectra().size() + bsdf.polarization_spectra().size() + 1, 1),
        rows(16, 1);
    std::vector<const float*> pointers;
    const auto add = [&](const radiometry::Spectrum& spectrum) {
      float* row = parameters.row(pointers.size());
      std::fill_n(row, parameters.stride(), static_cast<float>(spectrum.at(wavelength_um)));
      pointers.push_back(row);
    };
    for (const radiometry::Spectrum& spectrum : bsdf.spectra()) add(spectrum);
    for (const radiometry::Spectrum& spectrum : bsdf.polarization_spectra()) add(spectrum);
    const bool whole = polarizes();
    for (std::size_t k = 0; k < events.size(); ++k) {
      const materials::BsdfEvent event = events_.of(events[k]);
      brdf[k] = {};
      if (!whole) {
        bsdf.evaluate(event, pointers, 1, rows.row(0));
        brdf[k][0][0] = static_cast<double>(rows.row(0)[0]);
        continue;
      }
      bsdf.evaluate_mueller(event, pointers, 1, {rows.row(0), rows.stride(), true});
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
          brdf[k][row][column] = static_cast<double>(rows.row(4 * column + row)[0]);
    }
  }

  std::shared_ptr<const atmosphere::GroundAtNodes> at(const radiometry::SpectralNodes& nodes,
                                                      bool polarized) const override {
    return std::make_shared<const GroundNodes>(material_, events_, nodes, polarized);
  }

 private:
  materials::Material material_;
  Events events_;
};

bool lets_through(const materials::Material& material) {
  return material.transmittance || (!material.bsdf->is_separable() && material.bsdf->may_transmit());
}

}  // namespace

void check_ground(const materials::Material& material) {
  if (material.bsdf->is_delta())
    throw InputError(format(
        "the material '{}' sends all light in one direction: it is no ground for the air; expected a model that spreads light, such "
        "as 'sea', 'rpv' or 'ross_li'",
        material.name));
  if (lets_through(material))
    throw InputError(
        format("the material '{}' lets light through: it is no ground for the air; expected an opaque one",
               material.name));
}

bool reflects_by_direction(const materials::Material& material) {
  return !material.bsdf->is_lambertian() && !material.bsdf->is_delta() && !lets_through(material);
}

std::shared_ptr<const atmosphere::DirectionalGround> material_ground(const materials::Material& material,
                                                                     double sun_azimuth_rad) {
  check_ground(material);
  if (material.bsdf->is_lambertian()) return nullptr;
  return std::make_shared<const MaterialGround>(material, sun_azimuth_rad);
}

std::string left_out_of(const atmosphere::DirectionalGround& ground) {
  if (ground.is_isotropic()) return {};
  return "Ground that sends more to one side of the Sun's plane than to the other: what the air scatters of it again is as of the mean of "
         "both sides.";
}

}  // namespace ifov::transport

#include "atmosphere/particles/particle_mixture.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ifov::atmosphere {

ParticleMixture::ParticleMixture(std::vector<Part> parts) : parts_(std::move(parts)) {
  reference_um2_ = extinction_um2(kReference_um);
}

double ParticleMixture::extinction_um2(double um) const {
  double sum = 0.0;
  for (const Part& part : parts_) sum += part.number * part.spheres->cross_sections(um).extinction;
  return sum;
}

AerosolProperties ParticleMixture::properties(double um) const {
  MieMixture sum;
  for (const auto& [spheres, number, shape_error] : parts_) {
    const MieMixture here = spheres->cross_sections(um);
    sum.extinction += number * here.extinction;
    sum.scattering += number * here.scattering;
    sum.asymmetry += number * here.scattering * here.asymmetry;
  }
  return {sum.extinction / reference_um2_, std::max(0.0, sum.extinction - sum.scattering) / reference_um2_,
          sum.asymmetry / sum.scattering};
}

double ParticleMixture::scattering_error(double um) const {
  double sum = 0.0, scattering = 0.0;
  for (const Part& part : parts_) {
    const double here = part.number * part.spheres->cross_sections(um).scattering;
    scattering += here;
    sum += here * part.shape_error;
  }
  return sum / scattering;
}

PhaseFunction ParticleMixture::phase_function(double um) const {
  const std::size_t count = mie_angles()->angle_rad.size();
  std::vector<double> a1(count, 0.0);
  PolarizationRatios ratios{std::vector<double>(count, 1.0), std::vector<double>(count, 0.0),
                            std::vector<double>(count, 0.0)};
  double scattering = 0.0;
  for (const auto& [spheres, number, shape_error] : parts_) {
    const double of_part = number * spheres->cross_sections(um).scattering;
    const MieMixture matrix = spheres->matrix_at(um);
    scattering += of_part;
    for (std::size_t k = 0; k < count; ++k) {
      a1[k] += of_part * matrix.a1[k];
      ratios.a3[k] += of_part * matrix.a3[k];
      ratios.b1[k] += of_part * matrix.b1[k];
    }
  }
  std::vector<double> logarithms(count);
  for (std::size_t k = 0; k < count; ++k) {
    ratios.a3[k] /= a1[k], ratios.b1[k] /= a1[k];
    logarithms[k] = std::log(a1[k] / scattering);
  }
  return {mie_angles(), std::move(logarithms), std::make_shared<const PolarizationRatios>(std::move(ratios))};
}

}  // namespace ifov::atmosphere

#include "atmosphere/ground_coupling.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ifov::atmosphere {
namespace {

using Q = PathQuantity;

constexpr double kSameWavelength = 1e-5;  // relative: files round to 7 digits
constexpr double kLargestSphericalAlbedo = 0.9999;

void check(std::span<const AlbedoRun> runs) {
  if (runs.size() < 2 || runs.size() > 3)
    throw InputError(format("found {} runs of different albedo; expected 2 or 3", runs.size()));
  const ImportedPath& first = *runs[0].path;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const ImportedPath& path = *runs[k].path;
    if (!(runs[k].albedo >= 0.0 && runs[k].albedo <= 1.0))
      throw InputError(format("{}: found an albedo of {:g}; expected 0 to 1", path.source(), runs[k].albedo));
    for (std::size_t j = 0; j < k; ++j)
      if (std::abs(runs[j].albedo - runs[k].albedo) < 1e-3)
        throw InputError(format("{} and {} have the same albedo, {:g}; expected runs that differ",
                                runs[j].path->source(), path.source(), runs[k].albedo));
    if (path.wavelength_um().size() != first.wavelength_um().size())
      throw InputError(format("{} has {} wavelengths and {} has {}; expected runs over the same",
                              first.source(), first.wavelength_um().size(), path.source(),
                              path.wavelength_um().size()));
    for (std::size_t i = 0; i < path.wavelength_um().size(); ++i)
      if (std::abs(path.wavelength_um()[i] / first.wavelength_um()[i] - 1.0) > kSameWavelength)
        throw InputError(format("wavelength {} is {:g} um in {} and {:g} um in {}; expected the same", i + 1,
                                first.wavelength_um()[i], first.source(), path.wavelength_um()[i],
                                path.source()));
  }
}

bool all_have(std::span<const AlbedoRun> runs, Q quantity) {
  return std::all_of(runs.begin(), runs.end(), [&](const AlbedoRun& run) { return run.path->has(quantity); });
}

/// Radiance that depends on the ground's albedo through reflection.
std::vector<double> light_of(const AlbedoRun& run, bool parts) {
  if (!parts) {
    const auto total = run.path->need(Q::total_radiance);
    return {total.begin(), total.end()};
  }
  const auto scattered = run.path->column(Q::solar_path_radiance);
  const auto reflected = run.path->column(Q::ground_reflected_radiance);
  std::vector<double> sum(scattered.size());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = scattered[i] + reflected[i];
  return sum;
}

/// Solves L_i = L0 + A r_i / (1 - r_i S), i = 1 to 3, for S: with R = (L3 - L1) / (L2 - L1) and x = r / (1 -
/// r S), (x3 - x1) / (x2 - x1) = (r3 - r1) (1 - r2 S) / ((r2 - r1) (1 - r3 S)) = R.
double spherical_albedo_of(const double albedo[3], const double light[3]) {
  const double step2 = light[1] - light[0], step3 = light[2] - light[0];
  if (step2 == 0.0) return 0.0;  // nothing of the ground is seen
  const double ratio = step3 / step2;
  const double r21 = albedo[1] - albedo[0], r31 = albedo[2] - albedo[0];
  const double denominator = ratio * r21 * albedo[2] - r31 * albedo[1];
  return denominator == 0.0 ? 0.0 : (ratio * r21 - r31) / denominator;
}

/// From what two grounds reflect, g = D r / (1 - r S).
double spherical_albedo_of(double albedo1, double reflected1, double albedo2, double reflected2) {
  const double per1 = reflected1 / albedo1, per2 = reflected2 / albedo2;
  const double denominator = albedo2 * per2 - albedo1 * per1;
  return denominator == 0.0 ? 0.0 : (per2 - per1) / denominator;
}

std::vector<double> spherical_albedos(std::span<const AlbedoRun> runs,
                                      const std::vector<std::vector<double>>& light) {
  const std::size_t count = runs[0].path->wavelength_um().size();
  std::vector<double> result(count);
  if (runs.size() == 3) {
    const double albedo[3] = {runs[0].albedo, runs[1].albedo, runs[2].albedo};
    for (std::size_t i = 0; i < count; ++i) {
      const double three[3] = {light[0][i], light[1][i], light[2][i]};
      result[i] = spherical_albedo_of(albedo, three);
    }
    return result;
  }
  for (const AlbedoRun& run : runs)
    if (run.path->has(Q::spherical_albedo)) {
      const auto column = run.path->column(Q::spherical_albedo);
      return {column.begin(), column.end()};
    }
  if (!all_have(runs, Q::ground_reflected_radiance) || runs[0].albedo == 0.0 || runs[1].albedo == 0.0)
    throw InputError(
        format("{} and {} do not tell the spherical albedo; expected a third run, or a column of "
               "spherical_albedo, or albedos above 0 and columns of ground_reflected_radiance",
               runs[0].path->source(), runs[1].path->source()));
  const auto first = runs[0].path->column(Q::ground_reflected_radiance);
  const auto second = runs[1].path->column(Q::ground_reflected_radiance);
  for (std::size_t i = 0; i < count; ++i)
    result[i] = spherical_albedo_of(runs[0].albedo, first[i], runs[1].albedo, second[i]);
  return result;
}

}  // namespace

double GroundCoupling::radiance(std::size_t wavelength, double albedo) const {
  return path_radiance[wavelength] +
         reflected[wavelength] * albedo / (1.0 - albedo * spherical_albedo[wavelength]);
}

GroundCoupling ground_coupling(std::span<const AlbedoRun> given) {
  check(given);
  std::vector<AlbedoRun> runs(given.begin(), given.end());
  std::sort(runs.begin(), runs.end(),
            [](const AlbedoRun& a, const AlbedoRun& b) { return a.albedo < b.albedo; });
  const bool parts = all_have(runs, Q::solar_path_radiance) && all_have(runs, Q::ground_reflected_radiance);
  std::vector<std::vector<double>> light;
  for (const AlbedoRun& run : runs) light.push_back(light_of(run, parts));

  GroundCoupling coupling;
  const auto wavelengths = runs[0].path->wavelength_um();
  coupling.wavelength_um.assign(wavelengths.begin(), wavelengths.end());
  coupling.spherical_albedo = spherical_albedos(runs, light);
  const AlbedoRun &dark = runs.front(), &bright = runs.back();
  const auto reflected = bright.path->column(Q::ground_reflected_radiance);
  for (std::size_t i = 0; i < wavelengths.size(); ++i) {
    double& albedo = coupling.spherical_albedo[i];
    if (!(albedo >= 0.0 && albedo <= kLargestSphericalAlbedo)) {
      albedo = albedo > 0.0 ? kLargestSphericalAlbedo : 0.0;
      ++coupling.cut;
    }
    const double x1 = dark.albedo / (1.0 - dark.albedo * albedo);
    const double x2 = bright.albedo / (1.0 - bright.albedo * albedo);
    const double slope = (light.back()[i] - light.front()[i]) / (x2 - x1);
    coupling.reflected.push_back(slope);
    coupling.path_radiance.push_back(light.front()[i] - slope * x1);
    if (!reflected.empty()) coupling.direct_reflected.push_back(reflected[i] / x2);
  }
  return coupling;
}

}  // namespace ifov::atmosphere

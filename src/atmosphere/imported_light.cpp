#include "atmosphere/imported_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/ground_coupling.h"
#include "core/error.h"

namespace ifov::atmosphere {
namespace {

using Q = PathQuantity;
using Column = std::vector<double>;

constexpr double kBlack = 1e-3;  // albedo
/// Above these wavelengths sunlight is a small part of what a warm ground sends out, and what air emits is
/// not.
constexpr double kThermal_um = 3.0;

class Solver {
 public:
  Solver(const ImportedRuns& given, const std::optional<SunAbove>& sun)
      : given_(given), told_(given, sun), sun_(sun), count_(told_.dark().wavelength_um().size()) {}

  ImportedLight solve() {
    light_.source = told_.dark().source();
    const auto wavelengths = told_.dark().wavelength_um();
    light_.wavelength_um.assign(wavelengths.begin(), wavelengths.end());
    light_.width_um = told_.dark().width_um;
    if (given_.runs.size() > 1) {
      std::vector<AlbedoRun> runs;
      for (std::size_t k = 0; k < given_.runs.size(); ++k)
        runs.push_back({given_.albedo[k], &given_.runs[k]});
      coupling_ = ground_coupling(runs);
    }
    find_spherical_albedo();
    find_ways();
    find_beam();
    find_sky();
    find_path();
    return std::move(light_);
  }

 private:
  void find_spherical_albedo() {
    Column& albedo = light_.spherical_albedo;
    if (coupling_) {
      albedo = coupling_->spherical_albedo;
      if (coupling_->cut > 0)
        light_.remarks.push_back(
            format("{}: rounding took the spherical albedo out of 0 to 1 at {} wavelengths, where "
                   "it was cut",
                   light_.source, coupling_->cut));
      return;
    }
    albedo = told_.any(Q::spherical_albedo);
    if (!albedo.empty()) return;
    albedo.assign(count_, 0.0);
    light_.remarks.push_back(
        format("{} has no spherical_albedo: light that goes back from the ground to the air is left out (two "
               "or three "
               "runs over grounds of different albedo tell it)",
               light_.source));
  }

  /// Irradiance of level black ground where a run states irradiances; empty where none does.
  Column stated_irradiance() const {
    for (const bool of_run : {true, false}) {
      const auto take = [&](Q quantity) -> Column {
        return of_run ? told_.of_dark(quantity) : told_.of_lights(quantity);
      };
      Column all = take(Q::global_irradiance);
      if (all.empty()) {
        all = take(Q::direct_irradiance);
        const Column diffuse = take(Q::diffuse_irradiance);
        if (all.empty() || diffuse.empty()) continue;
        for (std::size_t i = 0; i < count_; ++i) all[i] += diffuse[i];
      }
      const double albedo = of_run ? told_.dark_albedo() : 0.0;
      for (std::size_t i = 0; i < count_; ++i) all[i] *= 1.0 - albedo * light_.spherical_albedo[i];
      return all;
    }
    return {};
  }

  /// Radiance per albedo that comes straight from the ground, without the ground's own light in turn; empty
  /// where no run tells.
  Column straight() const {
    if (coupling_ && !coupling_->direct_reflected.empty()) return coupling_->direct_reflected;
    if (coupling_ || told_.bright_albedo() < kBlack || !told_.bright().has(Q::ground_reflected_radiance))
      return {};
    Column result;
    for (std::size_t i = 0; i < count_; ++i)
      result.push_back(told_.bright().column(Q::ground_reflected_radiance)[i] *
                       (1.0 / told_.bright_albedo() - light_.spherical_albedo[i]));
    return result;
  }

  void find_ways() {
    Column& view = light_.view;
    Column& diffuse = light_.diffuse_transmittance;
    const Column straight = this->straight(), stated = stated_irradiance();
    view = told_.any(Q::ground_sensor_transmittance);
    if (view.empty()) {
      if (!coupling_ || stated.empty())
        told_.missing(
            "the light of the ground cannot be carried to the sensor", Q::ground_sensor_transmittance,
            "give runs in radiance mode of MODTRAN, or two or three runs of different albedo that state "
            "irradiances");
      for (std::size_t i = 0; i < count_; ++i)
        view.push_back(stated[i] > 0.0 ? std::min(1.0, std::numbers::pi * coupling_->reflected[i] / stated[i])
                                       : 0.0);
      diffuse.assign(count_, 0.0);
      light_.remarks.push_back(
          format("{} has no ground_sensor_transmittance: all light of the ground is taken to come "
                 "straight to the sensor, none from beside",
                 light_.source));
      return;
    }
    if (!straight.empty() && coupling_) {
      for (std::size_t i = 0; i < count_; ++i) {
        const double share = straight[i] > 0.0 ? coupling_->reflected[i] / straight[i] - 1.0 : 0.0;
        diffuse.push_back(std::clamp(share * view[i], 0.0, 1.0));
      }
      return;
    }
    diffuse = told_.any(Q::diffuse_ground_sensor_transmittance);
    if (!diffuse.empty()) return;
    if (coupling_ && !stated.empty()) {
      for (std::size_t i = 0; i < count_; ++i) {
        const double both = stated[i] > 0.0 ? std::numbers::pi * coupling_->reflected[i] / stated[i] : 0.0;
        diffuse.push_back(std::clamp(both - view[i], 0.0, 1.0));
      }
      return;
    }
    diffuse.assign(count_, 0.0);
    light_.remarks.push_back(
        format("{} has no diffuse_ground_sensor_transmittance: light from beside what a pixel looks "
               "at is left out",
               light_.source));
  }

  /// Irradiance above the air on a level plane: that of the runs, else of the scene's Sun.
  Column level_above() {
    Column above = told_.any(Q::solar_irradiance);
    if (above.empty())
      for (const double um : light_.wavelength_um) above.push_back(sun_->irradiance.at(um));
    else
      light_.own_irradiance = true;
    for (double& value : above) value *= sun_->cos_zenith;
    return above;
  }

  /// From radiance per albedo at the sensor to irradiance of level ground.
  Column at_ground(const Column& radiance, double factor) const {
    Column irradiance(count_, 0.0);
    for (std::size_t i = 0; i < count_; ++i)
      if (light_.view[i] > 0.0) irradiance[i] = factor * radiance[i] / light_.view[i];
    return irradiance;
  }

  /// level_: irradiance of level ground by the direct beam.
  void find_beam() {
    level_.assign(count_, 0.0);
    const bool reflected = told_.bright_albedo() > kBlack && told_.bright().has(Q::direct_reflected_radiance);
    const Column two_way = told_.any(Q::two_way_transmittance), stated = told_.any(Q::direct_irradiance),
                 transmittance = told_.any(Q::direct_sun_ground_transmittance);
    if (!sun_) {
      const auto shines = [](const auto& column) {
        return std::any_of(column.begin(), column.end(), [](double value) { return value > 0.0; });
      };
      if (shines(two_way) || shines(stated) || shines(transmittance) ||
          (reflected && shines(told_.bright().column(Q::direct_reflected_radiance))))
        throw InputError(
            format("{} holds direct sunlight, and the document has no Sun above the horizon; give "
                   "light.sun with the zenith angle of the runs",
                   light_.source));
      light_.sun = level_;
      return;
    }
    if (reflected) {
      const auto column = told_.bright().column(Q::direct_reflected_radiance);
      level_ = at_ground({column.begin(), column.end()}, std::numbers::pi / told_.bright_albedo());
      light_.own_irradiance = true;
    } else if (!two_way.empty()) {
      const Column above = level_above();
      Column seen(count_);
      for (std::size_t i = 0; i < count_; ++i) seen[i] = above[i] * two_way[i];
      level_ = at_ground(seen, 1.0);
    } else if (!stated.empty()) {
      level_ = stated;
      light_.own_irradiance = true;
    } else if (!transmittance.empty()) {
      const Column above = level_above();
      for (std::size_t i = 0; i < count_; ++i) level_[i] = above[i] * transmittance[i];
    } else if (light_.wavelength_um.front() < kThermal_um) {
      told_.missing("nothing tells the direct sunlight at the ground", Q::direct_sun_ground_transmittance,
                    "add a run over ground of albedo above 0 (direct_reflected_radiance), one in MODTRAN's "
                    "irradiance mode "
                    "(IEMSCT 3), or a column of direct_sun_ground_transmittance or direct_irradiance");
    }
    for (const double value : level_) light_.sun.push_back(value / sun_->cos_zenith);
  }

  void find_sky() {
    Column all;
    if (const Column radiance = straight();
        !radiance.empty() && told_.dark().has(Q::ground_sensor_transmittance))
      all = at_ground(radiance, std::numbers::pi);
    if (all.empty()) all = stated_irradiance();
    if (const Column share = told_.any(Q::sun_ground_transmittance); all.empty() && sun_ && !share.empty()) {
      all = level_above();
      for (std::size_t i = 0; i < count_; ++i) all[i] *= share[i];
    }
    if (const Column diffuse = told_.any(Q::diffuse_irradiance); all.empty() && !diffuse.empty()) {
      const double albedo = told_.dark().has(Q::diffuse_irradiance) ? told_.dark_albedo() : 0.0;
      for (std::size_t i = 0; i < count_; ++i)
        all.push_back((level_[i] + diffuse[i]) * (1.0 - albedo * light_.spherical_albedo[i]));
    }
    for (std::size_t i = 0; i < all.size(); ++i) light_.sky.push_back(std::max(0.0, all[i] - level_[i]));
  }

  /// Radiance over black ground that emits nothing.
  void find_path() {
    Column& path = light_.path;
    const bool parts = told_.dark().has(Q::solar_path_radiance) || told_.dark().has(Q::thermal_path_radiance);
    if (!parts && !told_.dark().has(Q::total_radiance))
      told_.missing(
          "nothing tells the path radiance", Q::solar_path_radiance,
          "give a run in radiance mode, or columns of solar_path_radiance and thermal_path_radiance");
    path.assign(count_, 0.0);
    const auto add = [&](const ImportedPath& run, Q quantity, double factor) {
      for (std::size_t i = 0; i < count_ && run.has(quantity); ++i)
        path[i] += factor * run.column(quantity)[i];
    };
    if (coupling_) {
      path = coupling_->path_radiance;
      if (parts && coupled_parts())
        add(told_.dark(), Q::thermal_path_radiance, 1.0);
      else
        add(told_.dark(), Q::surface_emission, -1.0);
    } else if (parts) {
      add(told_.dark(), Q::solar_path_radiance, 1.0);
      remove_ground_from_path();
      add(told_.dark(), Q::thermal_path_radiance, 1.0);
    } else {
      if (told_.dark_albedo() > kBlack)
        told_.missing("the ground's light cannot be told from the path's", Q::solar_path_radiance,
                      "give that column, a run over black ground, or two or three runs of different albedo");
      add(told_.dark(), Q::total_radiance, 1.0);
      add(told_.dark(), Q::surface_emission, -1.0);
    }
    for (double& value : path) value = std::max(0.0, value);
  }

  /// Whether ground_coupling went by parts of the radiance, without emission, or by the total.
  bool coupled_parts() const {
    return std::all_of(given_.runs.begin(), given_.runs.end(), [](const ImportedPath& run) {
      return run.has(Q::solar_path_radiance) && run.has(Q::ground_reflected_radiance);
    });
  }

  /// Of the scattered light of one run, what came from its ground.
  void remove_ground_from_path() {
    const double albedo = told_.dark_albedo();
    if (albedo < kBlack) return;
    const Column radiance = straight();
    for (std::size_t i = 0; i < radiance.size(); ++i)
      if (light_.view[i] > 0.0)
        light_.path[i] -= radiance[i] * light_.diffuse_transmittance[i] / light_.view[i] * albedo /
                          (1.0 - albedo * light_.spherical_albedo[i]);
  }

  const ImportedRuns& given_;
  const RunQuantities told_;
  const std::optional<SunAbove>& sun_;
  std::size_t count_ = 0;
  std::optional<GroundCoupling> coupling_;
  Column level_;
  ImportedLight light_;
};

}  // namespace

ImportedLight imported_light(const ImportedRuns& given, const std::optional<SunAbove>& sun) {
  return Solver(given, sun).solve();
}

}  // namespace ifov::atmosphere

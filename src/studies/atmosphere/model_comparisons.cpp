#include "studies/atmosphere/model_comparisons.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/gas_transmittance.h"
#include "atmosphere/scattering/column_solver.h"
#include "core/format.h"
#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/sky_emission.h"

namespace ifov::studies {
namespace {

using namespace atmosphere;
using Quantity = ModelComparison::Quantity;
/// What the sum over levels may be off by itself, relative: the numbers' half-width of an opaque sky.
constexpr double kNumbers = 0.005;
constexpr double kSpaceKm = 100.0, kResolution = 20.0, kAirScaleKm = 8.4;

AtmosphereColumn clear_column(const char* model, double co2_ppm, const char* aerosol = "none") {
  AtmosphereDescription description;
  description.air.model = model;
  description.air.co2_ppm = co2_ppm;
  description.air.ch4_ppm = 1.7;
  description.air.n2o_ppm = 0.32;
  description.aerosol.type = aerosol;
  return AtmosphereColumn(description);
}

/// Pieces of a path, each straight between two altitudes under an angle.
class ModelledPath {
 public:
  explicit ModelledPath(const AtmosphereColumn& column)
      : column_(column), gases_(vertical_amounts(column.profile(), ground(), ground())) {}

  ModelledPath& slant(double first_km, double last_km, double zenith_deg) {
    gases_.add(slant_amounts(column_.profile(), first_km, last_km, zenith_deg), 1.0);
    pieces_.push_back({first_km, last_km, 1.0 / std::cos(zenith_deg * std::numbers::pi / 180.0)});
    const Profile& profile = column_.profile();
    air_mass_ += pieces_.back().factor * (profile.pressure_at(first_km) - profile.pressure_at(last_km)) /
                 profile.pressure_hPa.front();
    water_ += pieces_.back().factor * profile.between(first_km, last_km).precipitable_water_g_cm2();
    return *this;
  }
  /// At the ground.
  ModelledPath& level(double length_km) {
    gases_.add(horizontal_amounts(column_.profile(), ground(), length_km), 1.0);
    air_mass_ += length_km / kAirScaleKm;
    water_ += 0.1 * length_km * column_.profile().water_vapour_g_m3(0);
    return *this;
  }

  PathContent content(double gas_depth, double haze_depth) const {
    return {air_mass_, water_, gas_depth, haze_depth};
  }
  double gas_depth(double nu) const {
    return -std::log(std::max(1e-30, gas_transmittance(nu, gases_, column_.description().gas_model)));
  }
  struct Scatterers {
    double molecules = 0.0, haze = 0.0;
    double both() const { return molecules + haze; }
  };
  Scatterers scatterers(double nu) const {
    Scatterers sum;
    if (pieces_.empty()) return sum;
    const LayerOptics layers = column_.at(nu).scattering;
    const std::vector<double>& z = column_.levels().altitude_km;
    for (const Piece& piece : pieces_)
      for (std::size_t l = 0; l < layers.rayleigh_scattering.size(); ++l) {
        const double inside = std::min(piece.last_km, z[l + 1]) - std::max(piece.first_km, z[l]);
        const double share = std::max(0.0, piece.factor * inside / (z[l + 1] - z[l]));
        sum.molecules += share * layers.rayleigh_scattering[l];
        sum.haze += share * (layers.aerosol_scattering[l] + layers.aerosol_absorption[l]);
      }
    return sum;
  }
  double ground() const { return column_.levels().altitude_km.front(); }

 private:
  struct Piece {
    double first_km, last_km, factor;
  };
  const AtmosphereColumn& column_;
  GasAmounts gases_;
  std::vector<Piece> pieces_;
  double air_mass_ = 0.0, water_ = 0.0;
};

double haze_share_at(const AtmosphereColumn& column, double nu) {
  const LayerOptics layers = column.at(nu).scattering;
  double haze = 0.0, all = 0.0;
  for (std::size_t l = 0; l < layers.rayleigh_scattering.size(); ++l) {
    haze += layers.aerosol_scattering[l];
    all += layers.aerosol_scattering[l] + layers.rayleigh_scattering[l];
  }
  return all > 0.0 ? haze / all : 0.0;
}

/// The other program's values and where they count: the triangle of the band model's resolution about a bin.
double smoothed(std::span<const std::pair<double, double>> rows, double nu, double& weight) {
  double sum = 0.0;
  weight = 0.0;
  for (auto it = std::lower_bound(rows.begin(), rows.end(), std::pair(nu - kResolution, -1e300));
       it != rows.end() && it->first <= nu + kResolution; ++it) {
    const double w = 1.0 - std::abs(it->first - nu) / kResolution;
    sum += w * it->second;
    weight += w;
  }
  return weight > 0.0 ? sum / weight : 0.0;
}

class Comparisons {
 public:
  explicit Comparisons(const ReferenceData& reference) : reference_(reference) {}

  void pasadena(const char* key, const char* name, double water, double aot, bool makes_table, int step);
  void reptran();
  void horizontal();
  void modtran5(const char* key, const char* file, const char* model, double first_km, double last_km,
                double zenith_deg, std::size_t column, bool emitted);
  void flux();

  std::vector<ModelComparison> all;

 private:
  void add_transmittance(const std::string& name, bool makes_table, const ModelledPath& path, double nu,
                         double reference) {
    ModelComparison& one = all.emplace_back();
    one.name = name, one.makes_table = makes_table;
    one.wavelength_um = 1e4 / nu;
    const ModelledPath::Scatterers scatterers = path.scatterers(nu);
    one.path = path.content(path.gas_depth(nu), scatterers.haze);
    one.ours = std::exp(-one.path.gas_depth - scatterers.both());
    one.reference = reference;
    one.stated = one.ours * std::expm1(table_.of_depth(one.wavelength_um, one.path));
  }
  /// Radiance of the sky (or its flux), with the absorption of the model and with less.
  void add_emission(const std::string& name, const AtmosphereColumn& column, double nu, double zenith_deg,
                    bool is_flux, double reference);

  const ReferenceData& reference_;
  const ModelErrorTable& table_ = ModelErrorTable::built_in();
};

void Comparisons::pasadena(const char* key, const char* name, double water, double aot, bool makes_table,
                           int step) {
  const auto file = reference_.file(format("atmosphere/modtran6_isofit_pasadena/{}.chn", name));
  if (!file) return;
  constexpr double kSunZenith_deg = 51.9928, kGround_km = 0.35, kSensor_km = 2.3;
  const double cosine = std::cos(kSunZenith_deg * std::numbers::pi / 180.0);
  AtmosphereDescription description;
  description.air.ground_altitude_km = kGround_km;
  description.air.water_vapour_g_cm2 = water;
  description.air.ozone_DU = 300.0;
  description.air.co2_ppm = 450.0;
  description.air.ch4_ppm = 1.7;
  description.air.n2o_ppm = 0.32;
  description.aerosol.aot550 = aot;
  const AtmosphereColumn column(description);
  ModelledPath path(column);
  path.slant(kGround_km, kSpaceKm, kSunZenith_deg).slant(kGround_km, kSensor_km, 0.0);
  const ColumnSolver solver;
  int i = 0;
  for (const auto& row : number_rows(*file, 24)) {
    // Both are means over the channel: a Gaussian of 5.6 nm.
    constexpr double kWidth_nm = 5.6;
    double sum = 0.0, depth = 0.0, haze = 0.0, stated = 0.0, weight = 0.0;
    for (double d = -2.0; d <= 2.0; d += 0.25) {
      const double nu = 5.0 * std::round(0.2 * 1e7 / (row[0] + d * kWidth_nm / 2.3548));
      const double w = std::exp(-0.5 * d * d), gas = path.gas_depth(nu);
      const ModelledPath::Scatterers scatterers = path.scatterers(nu);
      const double t = std::exp(-gas - scatterers.both());
      sum += w * t, depth += w * std::exp(-gas), haze += w * scatterers.haze, weight += w;
      stated += w * t * std::expm1(table_.of_depth(1e4 / nu, path.content(gas, scatterers.haze)));
    }
    ModelComparison one;
    one.name = key, one.makes_table = makes_table;
    one.wavelength_um = 1e-3 * row[0];
    one.path = path.content(-std::log(std::max(1e-30, depth / weight)), haze / weight);
    one.haze_share = haze_share_at(column, 5.0 * std::round(0.2 * 1e7 / row[0]));
    one.ours = sum / weight;
    one.reference = row[19] / row[18] * cosine / std::numbers::pi;
    one.stated = stated / weight;
    all.push_back(one);
    if (i++ % step != 0) continue;
    const double relative_surface = one.ours > 0.0 ? one.stated / one.ours : 0.0;
    one.quantity = Quantity::scattered;
    one.ours = 0.0;
    for (const auto& [shift_nm, share] : {std::pair{-2.8, 0.25}, {0.0, 0.5}, {2.8, 0.25}}) {
      const ColumnOptics optics = column.at(5.0 * std::round(0.2 * 1e7 / (row[0] + shift_nm)));
      for (std::size_t term = 0; term < optics.terms(); ++term)
        one.ours +=
            share * optics.weight(term) *
            solver.solve(column.levels(), optics.term(term), kSunZenith_deg * std::numbers::pi / 180.0)
                .sunlit()
                .path({1.0, 0.0}, kSensor_km)
                .radiance()
                .i *
            std::numbers::pi / cosine;
    }
    one.reference = (row[14] + row[15]) / row[18];
    one.stated = one.ours * (table_.of_scattered(one.wavelength_um, one.haze_share) + relative_surface) +
                 table_.at(one.wavelength_um).floor;
    all.push_back(one);
  }
}

void Comparisons::reptran() {
  const auto file = reference_.file("atmosphere/libradtran/transmittance_reptran.OUT");
  if (!file) return;
  const AtmosphereColumn column = clear_column("US standard 1976", 330.0);
  ModelledPath path(column);
  path.slant(0.0, kSpaceKm, 0.0);
  std::vector<std::pair<double, double>> theirs;
  for (const auto& row : number_rows(*file, 2)) theirs.emplace_back(1e7 / row[0], row[1]);
  std::sort(theirs.begin(), theirs.end());
  for (double nu = 5050.0; nu < 25200.0; nu += 10.0) {
    double weight = 0.0;
    const double reference = smoothed(theirs, nu, weight);
    if (weight >= 2.0) add_transmittance("reptran vertical", true, path, nu, reference);
  }
}

void Comparisons::horizontal() {
  const auto file = reference_.file("atmosphere/modtran_tape7_pyradi/horizon5kmtropical_first12cols.txt");
  if (!file) return;
  const AtmosphereColumn column = clear_column("tropical", 360.0);
  ModelledPath path(column);
  path.level(5.0);
  for (const auto& row : number_rows(*file, 12)) {
    if (row[0] > 28000.0) break;
    add_transmittance("modtran5 5 km", true, path, 5.0 * std::round(0.2 * row[0]),
                      row[2] * row[3] * row[4] * row[5] * row[6] * row[7]);
  }
}

void Comparisons::modtran5(const char* key, const char* name, const char* model, double first_km,
                           double last_km, double zenith_deg, std::size_t column_of, bool emitted) {
  const auto file = reference_.file(format("atmosphere/modtran_tape7_pyradi/{}", name));
  if (!file) return;
  const AtmosphereColumn column = clear_column(model, 360.0, "rural");
  ModelledPath path(column);
  path.slant(first_km, last_km, zenith_deg);
  std::vector<std::pair<double, double>> through, radiance;
  for (const auto& row : number_rows(*file, 4)) {
    if (row[0] < 200.0) continue;
    through.emplace_back(row[0], row[column_of]);
    // W cm-2 sr-1 (cm-1)-1 to W m-2 sr-1 um-1.
    if (emitted) radiance.emplace_back(row[0], row[2] * 1e4 * row[0] * row[0] * 1e-4);
  }
  if (through.size() < 2) return;
  for (double nu = 5.0 * std::ceil(0.2 * (through.front().first + kResolution));
       nu <= through.back().first - kResolution; nu += 10.0) {
    double weight = 0.0;
    add_transmittance(key, false, path, nu, smoothed(through, nu, weight));
    if (emitted)
      add_emission(format("{} sky", key), column, nu, zenith_deg, false, smoothed(radiance, nu, weight));
  }
}

void Comparisons::add_emission(const std::string& name, const AtmosphereColumn& column, double nu,
                               double zenith_deg, bool is_flux, double reference) {
  const EmittingColumn emitting(column, table_);
  const SkyEmission sky =
      is_flux ? emitting.flux(nu, 8)
              : emitting.towards_ground(nu, 1.0 / std::cos(zenith_deg * std::numbers::pi / 180.0));
  ModelComparison& one = all.emplace_back();
  one.name = name, one.quantity = Quantity::emitted, one.makes_table = is_flux;
  one.wavelength_um = 1e4 / nu;
  one.ours = sky.radiance, one.by_depth = sky.by_depth;
  one.stated = one.by_depth + (table_.at(one.wavelength_um).emitted + kNumbers) * one.ours;
  one.reference = reference;
}

void Comparisons::flux() {
  const auto file = reference_.file("atmosphere/libradtran/spectrum_terrestrial_reptran.OUT");
  if (!file) return;
  AtmosphereDescription description;
  description.air.model = "subarctic summer";
  description.air.ozone_DU = 300.0;
  description.aerosol.type = "none";
  const AtmosphereColumn column(description);
  std::vector<std::pair<double, double>> theirs;
  for (const auto& row : number_rows(*file, 3)) theirs.emplace_back(row[1], row[2] * row[1] * row[1] * 1e-4);
  std::sort(theirs.begin(), theirs.end());
  for (double nu = 280.0; nu < 2880.0; nu += 20.0) {
    double weight = 0.0;
    add_emission("reptran flux", column, nu, 0.0, true, smoothed(theirs, nu, weight));
  }
}

}  // namespace

bool ModelComparison::covered() const {
  // Beside the model's error: the last figure that programs print, and what no radiance would show.
  constexpr double kPrinted = 5e-5;
  const double least = quantity == Quantity::transmittance ? kPrinted : 0.0;
  return std::abs(ours - reference) <= stated + least;
}

std::vector<ModelComparison> model_comparisons(const ReferenceData& reference, int step) {
  Comparisons comparisons(reference);
  comparisons.pasadena("modtran6 hazy", "AOT550-0.1000_H2OSTR-1.5000", 1.5, 0.1, true, step);
  comparisons.pasadena("modtran6 clear", "AOT550-0.0100_H2OSTR-2.0000", 2.0, 0.0392, false, step);
  comparisons.reptran();
  comparisons.horizontal();
  comparisons.modtran5("modtran5 lwir", "tape7.LWIRSun", "tropical", 0.0, kSpaceKm, 0.0, 1, true);
  comparisons.modtran5("modtran5 mwir", "tape7.MWIRSun", "tropical", 0.0, kSpaceKm, 0.0, 1, true);
  comparisons.modtran5("modtran5 sun", "tape7-sunE", "tropical", 0.0, kSpaceKm, 0.0, 1, false);
  comparisons.modtran5("modtran5 2 to 10 km", "tape7-03", "US standard 1976", 2.0, 10.0, 30.0, 1, false);
  comparisons.modtran5("modtran5 sky at 20 deg", "tape7-05", "US standard 1976", 0.0, kSpaceKm, 20.0, 1,
                       true);
  comparisons.flux();
  return comparisons.all;
}

std::string comparisons_csv(const std::vector<ModelComparison>& comparisons) {
  static constexpr const char* kNames[] = {"transmittance", "scattered", "emitted"};
  std::string text =
      "case,use,quantity,wavelength_um,air_mass,water_g_cm2,gas_depth,haze_depth,haze_share,ours,reference,by_depth,stated\n";
  for (const ModelComparison& one : comparisons)
    text += format("{},{},{},{:.6g},{:.5g},{:.5g},{:.6g},{:.5g},{:.4g},{:.6g},{:.6g},{:.5g},{:.5g}\n",
                   one.name, one.makes_table ? "make" : "test", kNames[static_cast<int>(one.quantity)],
                   one.wavelength_um, one.path.air_mass, one.path.water_g_cm2, one.path.gas_depth,
                   one.path.haze_depth, one.haze_share, one.ours, one.reference, one.by_depth, one.stated);
  return text;
}

}  // namespace ifov::studies

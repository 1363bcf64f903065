#include "io/atmosphere/modtran_columns.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ifov::io {
namespace {

using Q = atmosphere::PathQuantity;

constexpr double kPerSquareMetre = 1e4;  // from per cm2

struct Spelling {
  std::string_view compact, column;
};

// Of tape7 in versions 4 to 6, of the JSON output and of the spectral libraries of version 6, without blanks,
// underscores and case.
constexpr std::array kSpellings{
    Spelling{"tottrans", "TOT_TRANS"},
    Spelling{"totaltransmittance", "TOT_TRANS"},
    Spelling{"combintrans", "TOT_TRANS"},
    Spelling{"trans", "TOT_TRANS"},
    Spelling{"combin", "TOT_TRANS"},
    Spelling{"pththrml", "PTH_THRML"},
    Spelling{"thrmlem", "THRML_EM"},
    Spelling{"pathemission", "THRML_EM"},
    Spelling{"thrmlsct", "THRML_SCT"},
    Spelling{"paththermalscat", "THRML_SCT"},
    Spelling{"surfemis", "SURF_EMIS"},
    Spelling{"surfaceemission", "SURF_EMIS"},
    Spelling{"solscat", "SOL_SCAT"},
    Spelling{"multscat", "MULT_SCAT"},
    Spelling{"pathmultiplescat", "MULT_SCAT"},
    Spelling{"singscat", "SING_SCAT"},
    Spelling{"pathsinglescat", "SING_SCAT"},
    Spelling{"grndrflt", "GRND_RFLT"},
    Spelling{"groundreflect", "GRND_RFLT"},
    Spelling{"drctrflt", "DRCT_RFLT"},
    Spelling{"directreflect", "DRCT_RFLT"},
    Spelling{"totalrad", "TOTAL_RAD"},
    Spelling{"totalradiance", "TOTAL_RAD"},
    Spelling{"refsol", "REF_SOL"},
    Spelling{"referenceirradiance", "REF_SOL"},
    Spelling{"sol@obs", "SOL@OBS"},
    Spelling{"solatobs", "SOL@OBS"},
    Spelling{"irradianceatobserver", "SOL@OBS"},
    Spelling{"direm", "DIR_EM"},
    Spelling{"directionalemissivity", "DIR_EM"},
    Spelling{"toasun", "TOA_SUN"},
    Spelling{"toarad", "TOA_SUN"},
    Spelling{"topofatmosphereirradiance", "TOA_SUN"},
    Spelling{"soltr", "SOL_TR"},
    Spelling{"solar", "SOLAR"},
    Spelling{"bbodyt[k]", "BBODY_T[K]"},
    Spelling{"bbodytk", "BBODY_T[K]"},
    Spelling{"brightnesstemp", "BBODY_T[K]"},
    Spelling{"depth", "DEPTH"},
    Spelling{"natlogpathtrans", "DEPTH"},
    Spelling{"los", "LOS"},
};

std::string compact(std::string_view text) {
  std::string result;
  for (const char symbol : lower_case(text))
    if (symbol != ' ' && symbol != '_' && symbol != '-' && symbol != '\t') result += symbol;
  return result;
}

bool contains_any(const std::string& text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

std::vector<double> sum(std::initializer_list<std::vector<double>> parts) {
  std::vector<double> total;
  for (const std::vector<double>& part : parts) {
    if (total.empty()) total.resize(part.size());
    for (std::size_t i = 0; i < part.size(); ++i) total[i] += part[i];
  }
  return total;
}

/// a / b, where both are there and b is above 0 everywhere.
std::vector<double> ratio(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || b.empty() || std::any_of(b.begin(), b.end(), [](double x) { return !(x > 0.0); }))
    return {};
  std::vector<double> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] / b[i];
  return result;
}

/// The sum of the parts of the radiance at the first wavelength where it is not the total; nothing where it
/// is the total throughout, within the rounding of the file, or where there is nothing to compare.
struct Mismatch {
  std::size_t at = 0;
  double parts = 0.0;
};
std::optional<Mismatch> mismatch(const atmosphere::ImportedPath& path) {
  const auto total = path.column(Q::total_radiance);
  constexpr std::array kParts{Q::thermal_path_radiance, Q::surface_emission, Q::solar_path_radiance,
                              Q::ground_reflected_radiance};
  if (!path.has(Q::thermal_path_radiance) && !path.has(Q::solar_path_radiance)) return std::nullopt;
  for (std::size_t i = 0; i < total.size(); ++i) {
    double parts = 0.0;
    for (const Q part : kParts)
      if (path.has(part)) parts += path.column(part)[i];
    if (std::abs(parts - total[i]) > 2e-3 * std::max(std::abs(parts), std::abs(total[i])) + 1e-18)
      return Mismatch{i, parts};
  }
  return std::nullopt;
}

/// PTH_THRML and SOL_SCAT are all of the thermal path radiance and of the scattered light. Under the names
/// THRML_EM and MULT_SCAT versions give the parts without thermal scatter and without single scatter, or all
/// of it: the one that adds up to the total is taken, the parts first.
void set_path_radiances(const SpectralTable& table, atmosphere::ImportedPath& path) {
  const auto radiance = [&](std::string_view name) { return table.density(name, kPerSquareMetre); };
  std::vector<std::vector<double>> thermal{radiance("PTH_THRML")}, solar{radiance("SOL_SCAT")};
  if (table.has("THRML_EM"))
    thermal = {sum({radiance("THRML_EM"), radiance("THRML_SCT")}), radiance("THRML_EM")};
  if (table.has("MULT_SCAT"))
    solar = {sum({radiance("MULT_SCAT"), radiance("SING_SCAT")}), radiance("MULT_SCAT")};
  std::optional<Mismatch> first;
  for (const std::vector<double>& emitted : thermal)
    for (const std::vector<double>& scattered : solar) {
      path.set(Q::thermal_path_radiance, emitted);
      path.set(Q::solar_path_radiance, scattered);
      const std::optional<Mismatch> found = mismatch(path);
      if (!found) return;
      if (!first) first = found;
    }
  table.file().fail(
      table.first_line(), 0,
      format("at {:g} um the parts of the radiance add up to {:g}, and TOTAL_RAD is {:g} W m-2 sr-1 um-1; "
             "expected the same, so the columns are not what the heading says",
             path.wavelength_um()[first->at], first->parts, path.column(Q::total_radiance)[first->at]));
}

void set_radiances(const SpectralTable& table, atmosphere::ImportedPath& path) {
  const auto radiance = [&](std::string_view name) { return table.density(name, kPerSquareMetre); };
  path.set(Q::total_radiance, radiance("TOTAL_RAD"));
  path.set(Q::single_scatter_path_radiance, radiance("SING_SCAT"));
  path.set(Q::surface_emission, radiance("SURF_EMIS"));
  path.set(Q::ground_reflected_radiance, radiance("GRND_RFLT"));
  path.set(Q::direct_reflected_radiance, radiance("DRCT_RFLT"));
  path.set(Q::sun_at_sensor, radiance("SOL@OBS"));
  path.set(Q::solar_irradiance, radiance("TOA_SUN"));
  path.set(Q::surface_emissivity, table.column("DIR_EM"));
  path.set(Q::two_way_transmittance, ratio(table.column("REF_SOL"), table.column("TOA_SUN")));
  set_path_radiances(table, path);
}

}  // namespace

std::optional<std::string> modtran_column(std::string_view heading) {
  const std::string key = compact(heading);
  for (const Spelling& spelling : kSpellings)
    if (spelling.compact == key) return std::string(spelling.column);
  return std::nullopt;
}

std::optional<SpectralHeading> modtran_spectral_heading(std::string_view heading) {
  const std::string key = lower_case(heading);
  const bool frequency =
      key.starts_with("freq") || key.starts_with("wavenumber") || key.starts_with("wavenum");
  if (!frequency && !key.starts_with("wavlen") && !key.starts_with("wavelen")) return std::nullopt;
  if (contains_any(key, {"nanom", "(nm", "[nm", " nm", "_nm"}))
    return SpectralHeading{WavelengthUnit::nanometres};
  if (contains_any(key, {"mcrn", "micron", "microm", "(um", "[um", " um", "_um"}))
    return SpectralHeading{WavelengthUnit::micrometres};
  if (frequency) return SpectralHeading{WavelengthUnit::wavenumber_per_cm};
  return SpectralHeading{};
}

atmosphere::ImportedPath modtran_path(const SpectralTable& table, ModtranMode mode, std::string source) {
  atmosphere::ImportedPath path(std::move(source), table.wavelength_um());
  switch (mode) {
    case ModtranMode::transmittance:
      path.set(Q::ground_sensor_transmittance, table.column("TOT_TRANS"));
      break;
    case ModtranMode::thermal_radiance:
    case ModtranMode::radiance:
      path.set(Q::ground_sensor_transmittance, table.column("TOT_TRANS"));
      set_radiances(table, path);
      break;
    case ModtranMode::solar_irradiance:
      path.set(Q::direct_sun_ground_transmittance, table.column("TOT_TRANS"));
      path.set(Q::sun_at_sensor, table.density("SOL_TR", kPerSquareMetre));
      path.set(Q::solar_irradiance, table.density("SOLAR", kPerSquareMetre));
      break;
  }
  return path;
}

}  // namespace ifov::io

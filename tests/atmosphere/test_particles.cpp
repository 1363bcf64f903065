#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/particles/rayleigh.h"
#include "atmosphere/profile/column_integral.h"
#include "core/error.h"
#include "lowtran_output.h"
#include "measured.h"
#include "support/truth_data.h"

namespace ifov::atmosphere::test_particles {
namespace {

AtmosphereDescription us_standard_rural() {
  AtmosphereDescription description;
  description.air.model = "US standard 1976";
  description.air.co2_ppm = description.air.ch4_ppm = description.air.n2o_ppm = std::nullopt;
  description.aerosol.visibility_km = 23.0;
  description.gas_model = GasModel::lowtran7;
  return description;
}

// Bodhaine et al. (1999), table 3 and equation 30: the optical depth of a standard atmosphere at sea level,
// 360 ppm CO2.
TEST(Rayleigh, OpticalDepthOfTheStandardAtmosphere) {
  // 1013.25 hPa over 28.9595 g/mol and the mean gravity of the column.
  constexpr double kMoleculesCm2 = 2.1528e25;
  for (const double wavelength : {0.30, 0.40, 0.55, 0.70, 1.00}) {
    const double s = 1.0 / (wavelength * wavelength), w = wavelength * wavelength;
    const double equation_30 =
        0.0021520 * (1.0455996 - 341.29061 * s - 0.90230850 * w) / (1.0 + 0.0027059889 * s - 85.968563 * w);
    const double depth = rayleigh_cross_section_cm2(wavelength, 360.0) * kMoleculesCm2;
    EXPECT_NEAR(depth / equation_30, 1.0, 3e-3) << wavelength;
    EXPECT_GT(std::abs(depth / king_factor(wavelength, 360.0) / equation_30 - 1.0), 0.03) << "no King factor";
  }
  EXPECT_NEAR(rayleigh_cross_section_cm2(0.55, 360.0) / 4.513e-27, 1.0, 1e-3);
  EXPECT_NEAR(rayleigh_depolarization(0.55, 360.0), 0.0279, 5e-4);
  AtmosphereDescription description = us_standard_rural();
  const ColumnOptics optics = AtmosphereColumn(description).at(1e4 / 0.55);
  double depth = 0.0;
  for (const double layer : optics.scattering.rayleigh_scattering) depth += layer;
  RecordProperty("tau_550", format("{:.5f}", depth));
  EXPECT_NEAR(depth, 0.0971, 0.0003);
}

/// Transmittance of the aerosol and of its absorption alone between two altitudes, or along a path at one.
struct AerosolTransmittance {
  double total = 1.0, absorbed = 1.0;
};
AerosolTransmittance transmittance(const AerosolColumn& aerosol, double wavelength, const auto& thickness) {
  double extinction = 0.0, absorption = 0.0;
  for (std::size_t r = 0; r < AerosolColumn::kRegions; ++r) {
    const AerosolProperties p = aerosol.properties(r, wavelength);
    extinction += thickness(r) * p.extinction;
    absorption += thickness(r) * p.absorption;
  }
  return {std::exp(-extinction), absorption};
}

TEST(Aerosol, VerticalAsLowtran7) {
  const auto file = ifov::test::truth_file("atmosphere/lowtran7/B_US76_rural23_vertical_trans.tape7.txt");
  if (!file)
    GTEST_SKIP() << "reference data not found: atmosphere/lowtran7/B_US76_rural23_vertical_trans.tape7.txt";
  const AtmosphereColumn column(us_standard_rural());
  AtmosphereDescription faulty = us_standard_rural();
  faulty.aerosol.type = "urban";
  const AtmosphereColumn urban(faulty);
  ifov::test::Measured extinction, absorption, wrong;
  const auto of = [](const AtmosphereColumn& air, double nu) {
    return transmittance(air.aerosol(), 1e4 / nu,
                         [&](std::size_t r) { return air.aerosol().thickness_550(r, 0.0, 100.0); });
  };
  for (const ifov::test::LowtranRow& row : ifov::test::lowtran_rows(*file)) {
    const double nu = row.wavenumber_cm1;
    extinction.add(nu, of(column, nu).total, row.aerosol);
    absorption.add(nu, of(column, nu).absorbed, row.aerosol_absorbed);
    wrong.add(nu, of(urban, nu).absorbed, row.aerosol_absorbed);
  }
  extinction.record("extinction");
  absorption.record("absorption");
  RecordProperty("humidity", format("{:.2f}", column.aerosol().boundary_humidity_percent()));
  EXPECT_LT(extinction.largest(), 0.002) << extinction.text();
  EXPECT_LT(absorption.largest(), 0.002) << absorption.text();
  EXPECT_GT(wrong.largest(), 0.01);
}

TEST(Aerosol, HorizontalAsLowtran7) {
  const auto file =
      ifov::test::truth_file("atmosphere/lowtran7/G_TROP_rural23_horizontal5km_trans.tape7.txt");
  if (!file)
    GTEST_SKIP()
        << "reference data not found: atmosphere/lowtran7/G_TROP_rural23_horizontal5km_trans.tape7.txt";
  AtmosphereDescription description;
  description.air.model = "tropical";
  const AtmosphereColumn column(description);
  // On this path the program takes the humidity at the ground, not the mean of the layer.
  const AerosolOptics rural("rural", column.profile().relative_humidity_percent(0));
  const AerosolOptics dry("rural", 0.0);
  const double thickness = 5.0 * column.aerosol().extinction_550_km(0, 0.0);
  ifov::test::Measured extinction, wrong;
  for (const ifov::test::LowtranRow& row : ifov::test::lowtran_rows(*file)) {
    const double nu = row.wavenumber_cm1;
    extinction.add(nu, std::exp(-thickness * rural.at(1e4 / nu).extinction), row.aerosol);
    wrong.add(nu, std::exp(-thickness * dry.at(1e4 / nu).extinction), row.aerosol);
  }
  extinction.record("extinction");
  EXPECT_LT(extinction.largest(), 0.002) << extinction.text();
  EXPECT_GT(wrong.largest(), 0.01);
}

// Kneizys et al. (1988): molecular scattering of LOWTRAN7, km-1 at 273.15 K and 1013.25 hPa.
double rayleigh_of_lowtran7(double nu) { return nu * nu * nu * nu / (9.38076e18 - 1.08426e9 * nu * nu); }

// Nitric acid, which we leave out, takes up to 0.006 here.
bool in_nitric_acid(double nu) {
  return (nu >= 850 && nu <= 920) || (nu >= 1275 && nu <= 1350) || (nu >= 1675 && nu <= 1735);
}

TEST(DirectSun, AsLowtran7) {
  const auto file =
      ifov::test::truth_file("atmosphere/lowtran7/F_US76_rural23_direct_solar_zenith48.tape7.txt");
  if (!file)
    GTEST_SKIP()
        << "reference data not found: atmosphere/lowtran7/F_US76_rural23_direct_solar_zenith48.tape7.txt";
  constexpr double kZenith = 48.19;
  const AtmosphereColumn column(us_standard_rural());
  const std::vector<double>& z = column.levels().altitude_km;
  const Profile& profile = column.profile();
  double air_km = 0.0;
  std::array<double, AerosolColumn::kRegions> thickness{};
  std::vector<double> air;
  for (std::size_t i = 0; i < profile.levels(); ++i) air.push_back(profile.air_per_cm3(i) / kLoschmidtCm3);
  for (std::size_t l = 0; l + 1 < z.size(); ++l) {
    const double factor = slant_factor(0.0, kZenith, z[l], z[l + 1]);
    air_km += factor * column_integral(profile.altitude_km, air, z[l], z[l + 1]);
    for (std::size_t r = 0; r < thickness.size(); ++r)
      thickness[r] += factor * column.aerosol().thickness_550(r, z[l], z[l + 1]);
  }
  const GasAmounts slant = slant_amounts(profile, 0.0, 100.0, kZenith);
  const GasAmounts vertical = vertical_amounts(profile, 0.0, 100.0);
  ifov::test::Measured total, wrong;
  for (const std::vector<double>& row : ifov::test::numeric_rows(*file, 5)) {
    const double nu = row[0];
    if (nu > 33000.0 || row.size() > 5 || in_nitric_acid(nu)) continue;
    const double particles =
        std::exp(-rayleigh_of_lowtran7(nu) * air_km) *
        transmittance(column.aerosol(), 1e4 / nu, [&](std::size_t r) { return thickness[r]; }).total;
    total.add(nu, particles * gas_transmittance(nu, slant, GasModel::lowtran7), row[1]);
    wrong.add(nu, particles * gas_transmittance(nu, vertical, GasModel::lowtran7), row[1]);
  }
  total.record("total");
  EXPECT_GT(total.count(), 1000);
  EXPECT_LT(total.largest(), 0.002) << total.text();
  EXPECT_GT(wrong.largest(), 0.02);
}

TEST(Aerosol, OpticalThicknessIsMet) {
  for (const double aot : {0.0, 0.01, 0.1, 0.5, 2.0}) {
    AerosolDescription description;
    description.aot550 = aot;
    const Profile profile = build_profile({}).profile;
    const AerosolColumn aerosol(description, profile, "mid-latitude summer");
    EXPECT_NEAR(aerosol.thickness_550(0.0, 100.0), aot, 1e-6 + 1e-6 * aot);
  }
}

// MODTRAN6's log for ground at 0.35 km and an optical thickness of 0.1: 82.726 km, of which 0.0499 in the
// boundary layer, 0.0428 in the troposphere, 0.0072 above.
TEST(Aerosol, VisibilityOfAThicknessAsModtran6) {
  ProfileDescription air;
  air.ground_altitude_km = 0.35;
  air.water_vapour_g_cm2 = 1.5;
  AerosolDescription description;
  description.aot550 = 0.1;
  const AerosolColumn aerosol(description, build_profile(air).profile, "mid-latitude summer");
  RecordProperty("visibility_km", format("{:.2f}", aerosol.visibility_km()));
  EXPECT_NEAR(aerosol.visibility_km(), 82.726, 0.8);
  EXPECT_NEAR(aerosol.thickness_550(0, 0.35, 100.0), 0.04992, 5e-4);
  EXPECT_NEAR(aerosol.thickness_550(1, 0.35, 100.0), 0.04285, 5e-4);
  EXPECT_NEAR(aerosol.thickness_550(2, 0.35, 100.0), 0.00720, 1e-4);
}

TEST(Aerosol, EveryTypeHasItsVisibility) {
  const Profile profile = build_profile({}).profile;
  const std::map<std::string, double> expected{{"none", 0.0},
                                               {"rural", 23.0},
                                               {"urban", 5.0},
                                               {"maritime", 23.0},
                                               {"tropospheric", 50.0},
                                               {"advective fog", 0.2},
                                               {"radiative fog", 0.5},
                                               {"continental clean", 23.0},
                                               {"continental average", 23.0},
                                               {"continental polluted", 23.0},
                                               {"desert", 23.0},
                                               {"biomass burning", 23.0},
                                               {"savanna burning", 23.0}};
  ASSERT_EQ(aerosol_types().size(), expected.size());
  for (const std::string& type : aerosol_types()) {
    AerosolDescription description;
    description.type = type;
    const AerosolColumn aerosol(description, profile, "mid-latitude summer");
    EXPECT_EQ(aerosol.visibility_km(), expected.at(type)) << type;
    if (type == "none") continue;
    // Koschmieder: 3.912 over the extinction of aerosol and air (0.01159 km-1) at the ground.
    const double range = 3.912 / (aerosol.extinction_550_km(0, 0.0) + 0.01159);
    EXPECT_NEAR(range / aerosol.visibility_km(), 1.0, 0.02) << type;
  }
}

TEST(Aerosol, WrongWordsAreNamed) {
  const Profile profile = build_profile({}).profile;
  const auto message = [&](const AerosolDescription& description) -> std::string {
    try {
      AerosolColumn(description, profile, "tropical");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  AerosolDescription description;
  description.type = "rurl";
  EXPECT_EQ(
      message(description),
      "'rurl' is no aerosol type; expected 'none', 'rural', 'urban', 'maritime', 'tropospheric', 'advective "
      "fog', 'radiative fog', 'continental clean', 'continental average', 'continental polluted', 'desert', "
      "'biomass burning' or 'savanna burning'; did you mean 'rural'?");
  description.type = "rural";
  description.visibility_km = 23.0;
  description.aot550 = 0.2;
  EXPECT_EQ(message(description), "an aerosol has a visibility or an optical thickness at 550 nm, not both");
  description.aot550.reset();
  description.visibility_km = 0.0;
  EXPECT_EQ(message(description), "visibility of 0 km: expected 0.05 to 300 km");
}

}  // namespace
}  // namespace ifov::atmosphere::test_particles

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "atmosphere/particles/aerosol_column.h"
#include "atmosphere/particles/aerosol_components.h"
#include "atmosphere/particles/aerosol_description.h"
#include "atmosphere/particles/aerosol_types.h"
#include "atmosphere/particles/cloud_error.h"
#include "atmosphere/profile/built_profile.h"
#include "atmosphere/profile/profile_description.h"
#include "atmosphere/scattering/phase/scattering_matrix.h"

namespace ifov::atmosphere::test_aerosol_components {
namespace {

constexpr double kPerKm = 1e-3;  ///< of um^2 and a particle per cm^3
constexpr double kDegree = std::numbers::pi / 180.0;

double albedo(const Particles& particles, double um) {
  const AerosolProperties here = particles.properties(um);
  return 1.0 - here.absorption / here.extinction;
}

double angstrom(const ParticleMixture& mixture, double first_um, double last_um) {
  return -std::log(mixture.extinction_um2(first_um) / mixture.extinction_um2(last_um)) /
         std::log(first_um / last_um);
}

/// Figures of OPAC's files of components: extinction (km-1 for a particle per cm3), single-scattering albedo, asymmetry.
struct OpacRow {
  const char* component;
  double humidity_percent, um, extinction, albedo, asymmetry;
};
const OpacRow kOpac[] = {
    {"insoluble", 0, 0.55, 8.496e-3, 0.7300, 0.831},     {"insoluble", 0, 1.0, 9.039e-3, 0.8039, 0.777},
    {"insoluble", 0, 10.0, 7.206e-3, 0.5802, 0.658},     {"insoluble", 0, 40.0, 3.146e-3, 0.3402, 0.401},
    {"water_soluble", 0, 0.55, 3.905e-6, 0.9615, 0.614}, {"water_soluble", 0, 1.0, 1.366e-6, 0.8770, 0.548},
    {"water_soluble", 0, 10.0, 5.279e-8, 0.0481, 0.149}, {"water_soluble", 50, 0.55, 6.366e-6, 0.9765, 0.672},
    {"water_soluble", 50, 1.0, 2.295e-6, 0.9235, 0.604}, {"water_soluble", 80, 0.55, 9.584e-6, 0.9843, 0.704},
    {"water_soluble", 80, 1.0, 3.592e-6, 0.9496, 0.639}, {"water_soluble", 80, 10.0, 1.524e-7, 0.0400, 0.177},
    {"water_soluble", 80, 40.0, 1.994e-7, 5e-4, 0.0307}, {"water_soluble", 99, 0.55, 4.740e-5, 0.9967, 0.770},
    {"water_soluble", 99, 1.0, 2.229e-5, 0.9910, 0.729}, {"water_soluble", 99, 10.0, 7.759e-7, 0.0604, 0.271},
    {"soot", 0, 0.55, 5.540e-7, 0.2088, 0.336},          {"soot", 0, 1.0, 2.467e-7, 0.0965, 0.225},
    {"soot", 0, 10.0, 2.133e-8, 4e-4, 0.0121},           {"soot", 0, 40.0, 4.699e-9, 0.0, 0.001},
};

/// How far a component is from a row, in what it may be: 1 % of extinction (2 % at 10 um, between whose wavelengths OPAC tells
/// nothing), 0.003 of the albedo, 0.006 of the asymmetry.
double off(const OpacRow& row, double humidity_percent) {
  const MieMixture here = component_spheres(row.component, humidity_percent)->cross_sections(row.um);
  const double of_extinction = std::abs(here.extinction * kPerKm / row.extinction - 1.0),
               of_albedo = std::abs(here.scattering / here.extinction - row.albedo),
               of_asymmetry = std::abs(here.asymmetry - row.asymmetry);
  return std::max({of_extinction / (row.um == 10.0 ? 0.02 : 0.01), of_albedo / 0.003, of_asymmetry / 0.006});
}

}  // namespace

TEST(AerosolComponents, AreThoseOfOpac) {
  for (const OpacRow& row : kOpac)
    EXPECT_LT(off(row, row.humidity_percent), 1.0) << row.component << row.humidity_percent << " " << row.um;
  // Twin: ten per cent more of humidity are found out.
  for (const OpacRow& row : kOpac) {
    if (row.humidity_percent != 80.0) continue;
    EXPECT_GT(off(row, 90.0), 2.0) << row.um;
  }
}

// Hess, Koepke and Schult (1998), table 4: extinction (km-1), single-scattering albedo and asymmetry at 550 nm, Angstrom's exponents
// from 350 to 500 and from 500 to 800 nm, at 80 % relative humidity, to the digits printed.
TEST(AerosolComponents, MixAsOpacDoes) {
  const std::map<std::string, std::array<double, 5>> known{
      {"continental_clean", {0.026, 0.972, 0.709, 1.10, 1.42}},
      {"continental_average", {0.075, 0.925, 0.703, 1.11, 1.42}},
      {"continental_polluted", {0.175, 0.892, 0.698, 1.13, 1.45}},
      {"desert", {0.145, 0.888, 0.729, 0.20, 0.17}}};
  const auto figures = [](const ParticleMixture& mixture) {
    return std::array{mixture.extinction_um2(0.55) * kPerKm, albedo(mixture, 0.55),
                      mixture.properties(0.55).asymmetry, angstrom(mixture, 0.35, 0.5),
                      angstrom(mixture, 0.5, 0.8)};
  };
  const std::array<double, 5> may{0.0005, 0.0015, 0.0015, 0.007, 0.007};
  const auto worst = [&](const std::array<double, 5>& found, const std::array<double, 5>& printed) {
    double most = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k)
      most = std::max(most, std::abs(found[k] - printed[k]) / may[k]);
    return most;
  };
  for (const auto& [name, printed] : known) {
    EXPECT_LT(worst(figures(*composed_aerosol(name, 80.0)), printed), 1.0) << name;
    EXPECT_GT(worst(figures(*composed_aerosol(name, 70.0)), printed), 1.0) << name << ": drier air passes";
  }
}

// The same mixture's phase function by the files of OPAC's components, at 80 %.
TEST(AerosolComponents, ScatterWhereOpacSays) {
  const std::map<double, std::map<double, double>> known{{0.55,
                                                          {{1, 47.0},
                                                           {5, 15.99},
                                                           {20, 6.829},
                                                           {60, 0.7456},
                                                           {90, 0.2205},
                                                           {120, 0.1308},
                                                           {150, 0.1627},
                                                           {170, 0.1917},
                                                           {180, 0.2106}}},
                                                         {2.0,
                                                          {{1, 66.9},
                                                           {5, 27.21},
                                                           {20, 5.687},
                                                           {60, 0.7236},
                                                           {90, 0.2632},
                                                           {120, 0.1928},
                                                           {150, 0.2206},
                                                           {170, 0.2543},
                                                           {180, 0.2602}}}};
  const auto off_by = [&](double humidity_percent) {
    const auto mixture = composed_aerosol("continental_average", humidity_percent);
    double worst = 0.0;
    for (const auto& [um, by_angle] : known) {
      const PhaseFunction function = mixture->phase_function(um);
      EXPECT_NEAR(function.given_mean(), 1.0, 1e-3);
      EXPECT_NEAR(function.moment(1), mixture->properties(um).asymmetry, 1e-3);
      for (const auto& [degrees, value] : by_angle)
        worst = std::max(worst, std::abs(function.at(std::cos(degrees * kDegree)) / value - 1.0));
    }
    return worst;
  };
  EXPECT_LT(off_by(80.0), 0.006);
  EXPECT_GT(off_by(70.0), 0.02);
}

// Koepke, Gasteiger and Hess (2015) have mineral particles as spheroids in OPAC 4. What the guide and `ifov check` say of spheres, and
// the error of the model holds.
TEST(AerosolComponents, SpheresAreNoDust) {
  const std::map<double, double> spheroids{{1, 220.1},    {20, 5.010},   {60, 0.5727},
                                           {90, 0.2043},  {120, 0.1578}, {130, 0.1623},
                                           {150, 0.1818}, {170, 0.2161}, {180, 0.3462}};
  const auto desert = composed_aerosol("desert", 80.0);
  const PhaseFunction function = desert->phase_function(0.55);
  const auto ratio = [&](double degrees) {
    return spheroids.at(degrees) / function.at(std::cos(degrees * kDegree));
  };
  for (const double degrees : {1.0, 20.0, 60.0, 90.0}) EXPECT_NEAR(ratio(degrees), 1.0, 0.1) << degrees;
  EXPECT_NEAR(ratio(130.0), 1.5, 0.03);
  EXPECT_NEAR(ratio(170.0), 0.44, 0.02);
  double most = 0.0;
  for (const auto& [degrees, value] : spheroids) most = std::max(most, std::abs(ratio(degrees) - 1.0));
  EXPECT_GT(desert->scattering_error(0.55), most);
  EXPECT_LT(desert->scattering_error(0.55), 1.2 * most);
  EXPECT_EQ(composed_aerosol("continental_average", 80.0)->scattering_error(0.55), 0.0);
  // Of a column it is the haze's, beside what has none.
  const auto of_column = [](const char* type) {
    AerosolDescription description;
    description.type = type;
    description.aot550 = 0.5;
    return haze_error(AerosolColumn(description, build_profile({}).profile, "mid-latitude summer"), 0.55);
  };
  EXPECT_GT(of_column("desert"), 0.4 * desert->scattering_error(0.55));
  EXPECT_LT(of_column("desert"), desert->scattering_error(0.55));
  EXPECT_EQ(of_column("rural"), 0.0);
}

// Dubovik et al. (2002), table 1: what was retrieved at 440, 670, 870 and 1020 nm beside sizes and indices. The volumes are those of a
// depth of 1 at 440 nm.
TEST(AerosolComponents, SmokeIsWhatPhotometersSaw) {
  struct Seen {
    std::array<double, 4> albedo, asymmetry;
  };
  const std::map<std::string, Seen> known{
      {"biomass_burning", {{0.94, 0.93, 0.91, 0.90}, {0.69, 0.58, 0.51, 0.48}}},
      {"savanna_burning", {{0.88, 0.84, 0.80, 0.78}, {0.64, 0.53, 0.48, 0.47}}}};
  const std::array<double, 4> um{0.44, 0.67, 0.87, 1.02};
  const auto worst = [&](const ParticleMixture& smoke, const Seen& seen) {
    double most = 0.0;
    for (std::size_t k = 0; k < um.size(); ++k)
      most = std::max({most, std::abs(albedo(smoke, um[k]) - seen.albedo[k]) / 0.03,
                       std::abs(smoke.properties(um[k]).asymmetry - seen.asymmetry[k]) / 0.035});
    return most;
  };
  const auto forest = composed_aerosol("biomass_burning", 50.0),
             savanna = composed_aerosol("savanna_burning", 50.0);
  EXPECT_LT(worst(*forest, known.at("biomass_burning")), 1.0);
  EXPECT_LT(worst(*savanna, known.at("savanna_burning")), 1.0);
  EXPECT_GT(worst(*savanna, known.at("biomass_burning")), 1.5) << "the other smoke passes";
  EXPECT_NEAR(forest->extinction_um2(0.44), 1.0, 0.02);
  EXPECT_NEAR(savanna->extinction_um2(0.44), 1.0, 0.15);
  EXPECT_GT(angstrom(*forest, 0.44, 0.87), 1.2);
  EXPECT_LT(angstrom(*forest, 0.44, 0.87), 2.1);
}

// Dust-like particles of WMO (1983), a median of 0.5 um and a deviation of 2.99, as 6S (Vermote et al. 1997) tells their extinction,
// scattering and asymmetry. Its sums end near 50 um.
TEST(AerosolComponents, WideDistributionsAreThoseOf6s) {
  struct Row {
    double um, n, k, extinction, scattering, asymmetry;
  };
  const Row known[] = {{0.400, 1.53, 0.008, 1.796674e-2, 1.126647e-2, 0.896},
                       {0.550, 1.53, 0.008, 1.827016e-2, 1.196792e-2, 0.877},
                       {0.860, 1.52, 0.008, 1.881427e-2, 1.319347e-2, 0.845},
                       {2.250, 1.22, 0.009, 1.910712e-2, 1.531952e-2, 0.905},
                       {3.750, 1.27, 0.011, 1.876025e-2, 1.546761e-2, 0.871}};
  const auto worst = [&](const SizeDistribution& sizes) {
    double most = 0.0;
    const double reference = mie_mixture(sizes.resolved(0.55), 0.55, {1.53, 0.008}, {}).extinction;
    for (const Row& row : known) {
      const MieMixture here = mie_mixture(sizes.resolved(row.um), row.um, {row.n, row.k}, {});
      most = std::max({most,
                       std::abs(here.scattering / here.extinction - row.scattering / row.extinction) / 0.001,
                       std::abs(here.asymmetry - row.asymmetry) / 0.002,
                       std::abs(here.extinction / reference - row.extinction / known[1].extinction) / 0.001});
    }
    return most;
  };
  EXPECT_LT(worst(lognormal(0.5, 2.99, {0.001, 50.0})), 1.0);
  EXPECT_GT(worst(lognormal(0.5, 2.90, {0.001, 50.0})), 1.5);
  // Documents have no end: spheres to a millimetre, which were refused.
  const MieParticles dust(lognormal(0.5, 2.99), radiometry::Spectrum::constant(1.53),
                          radiometry::Spectrum::constant(0.008));
  EXPECT_NEAR(albedo(dust, 0.55), 0.6524, 0.002);
}

// A mixture of twice the same is the same, polarization included; and a type's regions are those of the tables.
TEST(AerosolComponents, AddUp) {
  const auto spheres = component_spheres("mineral_nucleation", 0.0);
  const ParticleMixture twice({{spheres, 1.0}, {spheres, 3.0}});
  EXPECT_NEAR(twice.properties(0.7).extinction / spheres->properties(0.7).extinction, 1.0, 1e-12);
  EXPECT_NEAR(twice.properties(0.7).asymmetry, spheres->properties(0.7).asymmetry, 1e-12);
  const PhaseFunction one = spheres->phase_function(0.7), both = twice.phase_function(0.7);
  for (const double degrees : {0.0, 30.0, 90.0, 150.0}) {
    const ScatteringMatrix a = one.matrix(std::cos(degrees * kDegree), 0.1),
                           b = both.matrix(std::cos(degrees * kDegree), 0.1);
    EXPECT_NEAR(b.a1 / a.a1, 1.0, 1e-9);
    EXPECT_NEAR(b.b1, a.b1, 1e-9);
    EXPECT_NEAR(b.a3, a.a3, 1e-9);
  }
  AerosolDescription description;
  description.type = "desert";
  description.aot550 = 0.4;
  const AerosolColumn column(description, build_profile({}).profile, "mid-latitude summer");
  const auto moist = composed_aerosol("desert", column.boundary_humidity_percent());
  EXPECT_NEAR(column.properties(0, 0.865).extinction, moist->properties(0.865).extinction, 1e-12);
  EXPECT_NEAR(column.thickness_550(0.0, 100.0), 0.4, 1e-6);
}

}  // namespace ifov::atmosphere::test_aerosol_components

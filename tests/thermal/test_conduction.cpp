#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <sstream>

#include "exchanges.h"
#include "support/truth_data.h"
#include "thermal/cells.h"
#include "thermal/conduction.h"
#include "thermal/faces/time_table.h"
#include "thermal/solid.h"

namespace ifov::thermal::test_conduction {
namespace {

using test::concrete;
using test::LinearExchange;

constexpr double kBase_k = 300.0, kDay_s = 86400.0, kOmega = 2.0 * std::numbers::pi / kDay_s;

/// Carslaw and Jaeger (1959), Conduction of heat in solids, section 2.6: the solid under a flux q cos(omega t).
double periodic_k(const SolidLayer& solid, double flux, double time_s, double depth_m) {
  const double depths = depth_m / daily_depth_m(solid);
  return flux / (thermal_inertia(solid) * std::sqrt(kOmega)) * std::exp(-depths) *
         std::cos(kOmega * time_s - depths - 0.25 * std::numbers::pi);
}

std::vector<double> uniform(const Cells& cells) { return std::vector<double>(cells.depth_m.size(), kBase_k); }

std::vector<double> periodic_start(const Cells& cells, double flux) {
  std::vector<double> start;
  for (const double depth : cells.depth_m)
    start.push_back(kBase_k + periodic_k(concrete(1), flux, 0.0, depth));
  return start;
}

/// The largest difference from rows of the reference file: a case, solved with steps of so many seconds.
struct Compared {
  double worst_k = 0.0;
  int rows = 0;
};

Compared against_file(const std::filesystem::path& file, const std::string& name, double step_s,
                      const SurfaceExchange& exchange, const std::vector<double>& start_k,
                      const Cells& cells) {
  std::ifstream in(file);
  Compared result;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(name + ",", 0) != 0) continue;
    std::stringstream row(line.substr(line.find(',', name.size() + 1) + 1));
    double time_s = 0.0, depth_m = 0.0, expected = 0.0;
    char comma = ' ';
    row >> time_s >> comma >> depth_m >> comma >> expected;
    const double count = time_s / step_s;
    if (count != std::floor(count)) continue;
    const History history = conduct(cells, start_k, exchange, {0.0, step_s, static_cast<int>(count)});
    const double found = temperature_at_depth_k(cells, history, depth_m) - kBase_k;
    result.worst_k = std::max(result.worst_k, std::abs(found - expected));
    ++result.rows;
  }
  return result;
}

class ConductionTruth : public testing::TestWithParam<double> {
 protected:
  void SetUp() override {
    const auto found = ifov::test::truth_file("atmosphere/derived/thermal_analytic.csv");
    if (!found) GTEST_SKIP() << "reference data not found: atmosphere/derived/thermal_analytic.csv";
    file_ = *found;
  }
  double tolerance_k() const { return GetParam() > 300.0 ? 0.2 : 0.1; }

  std::filesystem::path file_;
  const Cells cells_ = cut_into_cells({{concrete(0.1)}, DeepGround{kBase_k}});
};

TEST_P(ConductionTruth, StepOfFlux) {
  const LinearExchange exchange([](double) { return 500.0; });
  const Compared found = against_file(file_, "step_flux", GetParam(), exchange, uniform(cells_), cells_);
  EXPECT_GE(found.rows, 8);
  EXPECT_LT(found.worst_k, tolerance_k());
}

TEST_P(ConductionTruth, StepOfAir) {
  const LinearExchange exchange([](double) { return 0.0; }, 20.0, kBase_k + 10.0);
  const Compared found =
      against_file(file_, "convective_step", GetParam(), exchange, uniform(cells_), cells_);
  EXPECT_GE(found.rows, 8);
  EXPECT_LT(found.worst_k, tolerance_k());
}

TEST_P(ConductionTruth, PeriodicFlux) {
  const LinearExchange exchange([](double t) { return 400.0 * std::cos(kOmega * t); });
  const Compared found =
      against_file(file_, "periodic_flux", GetParam(), exchange, periodic_start(cells_, 400.0), cells_);
  EXPECT_EQ(found.rows, 32);
  EXPECT_LT(found.worst_k, tolerance_k());
}

TEST_P(ConductionTruth, PeriodicFluxInAir) {
  const LinearExchange exchange([](double t) { return 400.0 * std::cos(kOmega * t); }, 15.0, kBase_k);
  // Ten days make any start forgotten.
  const int days = static_cast<int>(10.0 * kDay_s / GetParam());
  const History spun = conduct(cells_, uniform(cells_), exchange, {-10.0 * kDay_s, GetParam(), days});
  const Compared found =
      against_file(file_, "periodic_flux_with_h15", GetParam(), exchange, spun.cells_k, cells_);
  EXPECT_EQ(found.rows, 8);
  EXPECT_LT(found.worst_k, tolerance_k());
}

// A fault: a solid that conducts 2 % better.
TEST_P(ConductionTruth, NoticesAnotherConductivity) {
  SolidLayer other = concrete(0.1);
  other.conductivity_w_m_k *= 1.02;
  const Cells cells = cut_into_cells({{other}, DeepGround{kBase_k}});
  const LinearExchange exchange([](double) { return 500.0; });
  EXPECT_GT(against_file(file_, "step_flux", GetParam(), exchange, uniform(cells), cells).worst_k, 0.2);
}

INSTANTIATE_TEST_SUITE_P(FiveAndFifteenMinutes, ConductionTruth, testing::Values(300.0, 900.0));

/// Carslaw and Jaeger (1959), section 3.7: a wave exp(i omega t) through layers, by matrices of temperature and flux from
/// the insulated back to the surface. Temperature of the surface for a flux of 1.
std::complex<double> layered_wave(const std::vector<SolidLayer>& layers) {
  std::complex<double> temperature = 1.0, flux = 0.0;
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    temperature += layer->gap_behind_m2_k_w * flux;
    const std::complex<double> q = std::complex<double>(1.0, 1.0) / daily_depth_m(*layer);
    const std::complex<double> x = q * layer->thickness_m, kq = layer->conductivity_w_m_k * q;
    const std::complex<double> above = std::cosh(x) * temperature + std::sinh(x) / kq * flux;
    flux = kq * std::sinh(x) * temperature + std::cosh(x) * flux;
    temperature = above;
  }
  return temperature / flux;
}

double layered_error_k(const std::vector<SolidLayer>& layers, double step_s, const CellSizes& sizes = {}) {
  const Cells cells = cut_into_cells({layers, Insulated{}}, sizes);
  const LinearExchange exchange([](double t) { return 100.0 * std::sin(kOmega * t); });
  const int days = 40;
  const History history =
      conduct(cells, uniform(cells), exchange, {0.0, step_s, static_cast<int>(days * kDay_s / step_s)});
  // What the start left behind is a constant: that of no heat since.
  double mean = 0.0;
  const std::size_t a_day = static_cast<std::size_t>(kDay_s / step_s), last = history.nodes.size() - a_day;
  for (std::size_t i = last; i < history.nodes.size(); ++i)
    mean += history.nodes[i].surface_k / double(a_day);
  const std::complex<double> wave = 100.0 * layered_wave(layers);
  double worst = 0.0;
  for (std::size_t i = last; i < history.nodes.size(); ++i) {
    const double phase = kOmega * history.nodes[i].time_s;
    const double expected = (wave * std::polar(1.0, phase)).imag();
    worst = std::max(worst, std::abs(history.nodes[i].surface_k - mean - expected));
  }
  return worst;
}

TEST(Conduction, LayersAsTheWaveThroughThem) {
  const std::vector<SolidLayer> road{{0.06, 0.75, 2360.0, 920.0}, {0.25, 0.30, 1600.0, 800.0}};
  const std::vector<SolidLayer> wall{{0.01, 0.72, 1860.0, 780.0}, {0.05, 0.035, 30.0, 1400.0}, concrete(0.2)};
  std::vector<SolidLayer> cavity{{0.003, 0.72, 1860.0, 780.0}, concrete(0.1)};
  cavity[0].gap_behind_m2_k_w = 0.18;  // air
  for (const auto& layers : {road, wall, cavity}) {
    EXPECT_LT(layered_error_k(layers, 300.0), 0.1);
    EXPECT_LT(layered_error_k(layers, 900.0), 0.2);
  }
  // A fault: the second layer's heat capacity is that of the first. The wave tells.
  std::vector<SolidLayer> faulty = road;
  faulty[1].density_kg_m3 = 2360.0;
  EXPECT_GT(100.0 * std::abs(layered_wave(road) - layered_wave(faulty)), 0.5);
  // Another: the air is left out.
  faulty = cavity;
  faulty[0].gap_behind_m2_k_w = 0.0;
  EXPECT_GT(100.0 * std::abs(layered_wave(cavity) - layered_wave(faulty)), 0.5);
}

/// Carslaw and Jaeger (1959), section 3.8, eq. 3: a slab under a step of flux, its back insulated.
TEST(Conduction, SlabUnderAStepOfFlux) {
  const double thickness_m = 0.1, flux = 300.0;
  const SolidLayer slab = concrete(thickness_m);
  const double diffusivity = slab.conductivity_w_m_k / (slab.density_kg_m3 * slab.specific_heat_j_kg_k);
  const Cells cells = cut_into_cells({{slab}, Insulated{}});
  const LinearExchange exchange([&](double) { return flux; });
  for (const double step_s : {300.0, 900.0}) {
    const History history = conduct(cells, uniform(cells), exchange, {0.0, step_s, int(7200.0 / step_s)});
    const double fourier = diffusivity * 7200.0 / (thickness_m * thickness_m);
    double sum = fourier + 1.0 / 3.0;
    for (int n = 1; n < 50; ++n) {
      const double a = n * std::numbers::pi;
      sum -= 2.0 / (a * a) * std::exp(-a * a * fourier);
    }
    const double expected = flux * thickness_m / slab.conductivity_w_m_k * sum;
    EXPECT_NEAR(history.nodes.back().surface_k - kBase_k, expected, 0.05);
  }
}

/// Errors of the surface over a day with nothing but cells, or steps, that are halved three times.
double order(const std::vector<double>& errors) {
  double lowest = 1e9;
  for (std::size_t i = 1; i < errors.size(); ++i)
    lowest = std::min(lowest, std::log2(errors[i - 1] / errors[i]));
  return lowest;
}

double periodic_error_k(const CellSizes& sizes, double step_s, const History* reference = nullptr) {
  const Cells cells = cut_into_cells({{concrete(0.1)}, DeepGround{kBase_k}}, sizes);
  const LinearExchange exchange([](double t) { return 400.0 * std::cos(kOmega * t); });
  const History history = conduct(cells, periodic_start(cells, 400.0), exchange,
                                  {0.0, step_s, static_cast<int>(0.75 * kDay_s / step_s)});
  const double expected = reference != nullptr ? reference->nodes.back().surface_k
                                               : kBase_k + periodic_k(concrete(1), 400.0, 0.75 * kDay_s, 0.0);
  return std::abs(history.nodes.back().surface_k - expected);
}

TEST(Conduction, SecondOrderInCells) {
  std::vector<double> errors;
  for (const int parts : {1, 2, 4, 8}) errors.push_back(periodic_error_k({1.0 / 20.0, 1.2, parts}, 30.0));
  EXPECT_GT(order(errors), 1.9) << testing::PrintToString(errors);
}

TEST(Conduction, SecondOrderInSteps) {
  const Cells cells = cut_into_cells({{concrete(0.1)}, DeepGround{kBase_k}});
  const LinearExchange exchange([](double t) { return 400.0 * std::cos(kOmega * t); });
  const History fine =
      conduct(cells, periodic_start(cells, 400.0), exchange, {0.0, 5.0, int(0.75 * kDay_s / 5.0)});
  std::vector<double> errors;
  for (const double step_s : {3600.0, 1800.0, 900.0, 450.0})
    errors.push_back(periodic_error_k({}, step_s, &fine));
  EXPECT_GT(order(errors), 1.9) << testing::PrintToString(errors);
}

TEST(Conduction, HeatIsConserved) {
  for (const Back& back :
       {Back{Insulated{}}, Back{HeldBack{290.0}}, Back{RoomAir{293.0, 8.0}}, Back{DeepGround{285.0}}}) {
    const Cells cells = cut_into_cells({{concrete(0.1), {0.05, 0.04, 50.0, 1000.0}}, back});
    const LinearExchange exchange([](double t) { return 400.0 * std::max(0.0, std::sin(kOmega * t)); }, 12.0,
                                  288.0);
    const History history = conduct(cells, uniform(cells), exchange, {0.0, 300.0, 288});
    const double left = history.into_surface_j_m2 - history.out_of_back_j_m2 - history.stored_j_m2;
    EXPECT_LT(std::abs(left), 1e-6 * 400.0 * kDay_s / std::numbers::pi);
  }
}

TEST(Conduction, BacksHoldWhatTheySay) {
  const auto settled = [](const Back& back) {
    const Cells cells = cut_into_cells({{concrete(0.1)}, back});
    const LinearExchange exchange([](double) { return 50.0; }, 10.0, kBase_k);
    return conduct(cells, uniform(cells), exchange, {0.0, 900.0, 20000}).nodes.back().surface_k;
  };
  // Steady: 50 + 10 (300 - T) = (T - back) / resistance.
  const auto expected = [](double back_k, double resistance) {
    return (50.0 + 3000.0 + back_k / resistance) / (10.0 + 1.0 / resistance);
  };
  EXPECT_NEAR(settled(Insulated{}), 305.0, 1e-6);
  EXPECT_NEAR(settled(HeldBack{280.0}), expected(280.0, 0.1 / 1.4), 1e-6);
  EXPECT_NEAR(settled(RoomAir{280.0, 8.0}), expected(280.0, 0.1 / 1.4 + 1.0 / 8.0), 1e-6);
  EXPECT_NEAR(settled(RoomAir{280.0, 0.0}), 305.0, 1e-6);
  EXPECT_NEAR(settled(DeepGround{280.0}), expected(280.0, kGroundDepths * daily_depth_m(concrete(1)) / 1.4),
              1e-3);
}

/// A day's wave behind a slab that is insulated in front: its front has 1 / cosh((1 + i) L / d) of it (Carslaw and Jaeger, section 2.6 with
/// the image of the slab). Ten daily waves let the start fade.
TEST(Conduction, AWaveBehindComesThrough) {
  TimeTable wave;
  for (int i = 0; i <= 2880; ++i) {
    wave.time_s.push_back(300.0 * i);
    wave.value.push_back(kBase_k + 10.0 * std::cos(kOmega * wave.time_s.back()));
  }
  const auto over_time = std::make_shared<const TimeTable>(wave);
  const auto worst_k = [&](const Back& back, double thickness_m) {
    const Cells cells = cut_into_cells({{concrete(0.2)}, back});
    const LinearExchange still([](double) { return 0.0; });
    const History history = conduct(cells, uniform(cells), still, {0.0, 300.0, 2880});
    EXPECT_NEAR(history.into_surface_j_m2 - history.out_of_back_j_m2 - history.stored_j_m2, 0.0, 1.0);
    const std::complex<double> depths(thickness_m / daily_depth_m(concrete(1.0)),
                                      thickness_m / daily_depth_m(concrete(1.0)));
    const std::complex<double> conductance =
        std::holds_alternative<RoomAir>(back) ? std::get<RoomAir>(back).conductance_w_m2_k : 1e12;
    // Of the slab's admittance Y = k q tanh(q L) and the conductance in series.
    const std::complex<double> q = depths / thickness_m, admittance = 1.4 * q * std::tanh(depths);
    const std::complex<double> share = conductance / (conductance + admittance) / std::cosh(depths);
    double worst = 0.0;
    for (std::size_t i = history.nodes.size() - 289; i < history.nodes.size(); ++i)
      worst = std::max(worst,
                       std::abs(history.nodes[i].surface_k - kBase_k -
                                10.0 * std::real(share * std::polar(1.0, kOmega * history.nodes[i].time_s))));
    return worst;
  };
  EXPECT_LT(worst_k(HeldBack{0.0, over_time}, 0.2), 0.02);
  EXPECT_LT(worst_k(RoomAir{0.0, 7.7, over_time}, 0.2), 0.02);
  // A fault: a slab of another thickness shows.
  EXPECT_GT(worst_k(RoomAir{0.0, 7.7, over_time}, 0.21), 0.05);
}

}  // namespace
}  // namespace ifov::thermal::test_conduction

// A single Rayleigh layer over Lambertian ground, rendered: what leaves it upward against a published table, and its sky by way of
// a mirror against the solver.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/profile/gas_requests.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "materials/bsdf/mirror.h"
#include "radiometry/polarization_frame.h"
#include "render/image_renderer.h"
#include "render/polarized/polarimetry.h"
#include "render/polarized/stokes_columns.h"
#include "render/tile_sink.h"
#include "sampling/grid_sampler.h"
#include "sampling/pixel_footprint.h"
#include "sampling/tile.h"
#include "sensor/orthographic_camera.h"
#include "support/truth_data.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::render::test_polarized_rayleigh {
namespace {

using radiometry::StokesVector;

constexpr double kPi = std::numbers::pi, kUm = 0.352, kDepth = 0.5;
const double kSunZenith = std::acos(0.2);
constexpr const char* kTable = "atmosphere/rayleigh_polarized/coulson_natraj_tau0.5_mu0_0.2.csv";

atmosphere::AtmosphereColumn air_above(double ground_km) {
  atmosphere::AtmosphereDescription description;
  description.air.model = "US standard 1976";
  description.air.ground_altitude_km = ground_km;
  description.air.water_vapour_g_cm2 = description.air.ozone_DU = 0.0;
  atmosphere::GasRequests gases;
  gases.of[static_cast<std::size_t>(atmosphere::Gas::no2)].emplace().off = true;
  description.air.gases = std::make_shared<const atmosphere::GasRequests>(gases);
  description.air.co2_ppm = description.air.ch4_ppm = description.air.n2o_ppm = 0.0;
  description.aerosol.type = "none";
  description.depolarization = 0.0;
  return atmosphere::AtmosphereColumn(description);
}

double depth_of(const atmosphere::AtmosphereColumn& column) {
  const auto layers = column.at(5.0 * std::round(1e4 / kUm / 5.0)).term(0);
  return std::accumulate(layers.rayleigh_scattering.begin(), layers.rayleigh_scattering.end(), 0.0);
}

/// So much air that its optical depth is 0.5: where it lies does not matter to light that leaves it.
const atmosphere::AtmosphereColumn& layer() {
  static const atmosphere::AtmosphereColumn column = [] {
    double low = 0.0, high = 2.0;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (depth_of(air_above(middle)) > kDepth ? low : high) = middle;
    }
    return air_above(low);
  }();
  return column;
}

atmosphere::ScatteringOptions flat_and_fine() {
  atmosphere::ScatteringOptions options;
  options.nodes_per_hemisphere = 16;
  options.sublayer_depth = 0.0025;
  options.spherical_earth = false;
  return options;
}

struct TheTile final : TileSink {
  void begin(const ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

/// The Stokes vector of the one pixel of a camera that looks along -`towards` on level ground, about the meridional frame of light
/// that goes `towards` it. Sunlight of irradiance pi goes towards +x.
StokesVector rendered(double mu, double azimuth_rad, double albedo, bool by_mirror,
                      const std::optional<atmosphere::SkyDirections>& sky = {}) {
  atmosphere::SensorAtmosphere::Inputs inputs;
  const std::vector<radiometry::Channel> channels{radiometry::Channel::monochromatic("only", kUm)};
  inputs.channels = channels;
  inputs.solar_irradiance = radiometry::Spectrum::constant(kPi);
  inputs.geometry.sun_zenith_rad = kSunZenith;
  inputs.geometry.view_zenith_rad = std::acos(mu);
  inputs.geometry.view_azimuth_rad = azimuth_rad - kPi;  // of the sensor from the Sun
  inputs.geometry.sensor_altitude_km = by_mirror ? layer().levels().altitude_km.front() + 1e-3 : 100.0;
  inputs.scattering = flat_and_fine();
  inputs.polarized = true;
  inputs.threads = 1;
  inputs.sky = sky;
  const atmosphere::SensorAtmosphere air(layer(), inputs);

  test::SmallScene small;
  small.place(geometry::Plane{},
              by_mirror ? small.material(1.0, 0.0, materials::Mirror::shared()) : small.material(albedo));
  const math::Vec3 towards_sun{-std::sin(kSunZenith), 0.0, std::cos(kSunZenith)};
  small.sun(towards_sun, kPi, 0.0);
  small.build();
  scene::Scene& scene = small.scene();
  scene.materials[scene.surroundings.material].reflectance = radiometry::Spectrum::constant(albedo);
  const transport::SpectralScene spectral(scene, air, true);

  sensor::OrthographicCamera::Settings settings;
  settings.width_px = settings.height_px = 1;
  settings.view_zenith_rad = std::acos(mu);
  settings.view_azimuth_rad = 0.5 * kPi - azimuth_rad;  // from north, clockwise
  settings.start_height_m = 100.0;
  const sensor::OrthographicCamera camera(settings);
  const sampling::PixelFootprint footprint = sampling::PixelFootprint::box(1.0);
  const int rays = albedo > 0.0 && !by_mirror ? 128 : 1;
  const sampling::GridSampler sampler(rays, rays);
  RenderJob job{spectral, camera, footprint, sampler};
  const Polarimetry polarimetry{true};
  job.polarimetry = &polarimetry;
  TheTile tile;
  RenderControl control;
  control.threads = 1;
  render_image(job, control, tile);
  const auto others = tile.result.layer(StokesLayers::kMean)->values<float>();
  const StokesVector light{static_cast<double>(tile.result.mean[0]), static_cast<double>(others[0]),
                           static_cast<double>(others[1]), static_cast<double>(others[2])};
  const sampling::FocalPoint middle{0.5, 0.5};
  math::Ray ray;
  camera.rays({&middle, 1}, {&ray, 1});
  return turned(sensor::focal_frame(camera, {0.5, 0.5}, ray), radiometry::meridional_frame(mu, azimuth_rad)) *
         light;
}

struct Row {
  double albedo, mu, azimuth_rad, i, q, u;
};
std::vector<Row> table(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream stream(line);
    Row row{};
    // The table has the other sign of Q.
    if (stream >> row.albedo >> row.mu >> row.azimuth_rad >> row.i >> row.q >> row.u) {
      row.azimuth_rad *= kPi / 180.0, row.q = -row.q;
      rows.push_back(row);
    }
  }
  return rows;
}

TEST(PolarizedRayleigh, AnImageFromAboveIsNatrajsTable) {
  const auto file = test::truth_file(kTable);
  if (!file) GTEST_SKIP() << "reference data not found: " << kTable;
  EXPECT_NEAR(depth_of(layer()), kDepth, 1e-6);
  const std::vector<Row> rows = table(*file);
  ASSERT_EQ(rows.size(), 12u);
  double off_scale = 0.0;
  for (const Row& row : rows) {
    const StokesVector light = rendered(row.mu, row.azimuth_rad, row.albedo, false);
    EXPECT_NEAR(light.i, row.i, 1e-4) << row.mu << " " << row.azimuth_rad;
    EXPECT_NEAR(light.q, row.q, 1e-4) << row.mu << " " << row.azimuth_rad;
    EXPECT_NEAR(light.u, row.u, 1e-4) << row.mu << " " << row.azimuth_rad;
    off_scale = std::max({off_scale, std::abs(light.q + row.q), std::abs(light.u + row.u)});
  }
  EXPECT_GT(off_scale, 0.05) << "Q and U of the other sign pass";
}

/// The standard directions and as many halvings of the steps between them.
atmosphere::SkyDirections halved(int times) {
  atmosphere::SkyDirections sky = atmosphere::SkyDirections::standard(kSunZenith);
  for (int k = 0; k < times; ++k)
    for (std::vector<double>* list : {&sky.zenith_rad, &sky.azimuth_rad}) {
      std::vector<double> finer;
      for (std::size_t i = 0; i + 1 < list->size(); ++i)
        finer.insert(finer.end(), {(*list)[i], 0.5 * ((*list)[i] + (*list)[i + 1])});
      finer.push_back(list->back());
      *list = finer;
    }
  return sky;
}

// What comes down, seen by way of a level mirror, which turns U about.
TEST(PolarizedRayleigh, TheSkyIsTheSolversBetweenItsDirections) {
  const auto& levels = layer().levels();
  const atmosphere::ColumnSolution solved =
      atmosphere::ColumnSolver(flat_and_fine())
          .solve(levels, layer().at(5.0 * std::round(1e4 / kUm / 5.0)).term(0), kSunZenith);
  const auto worst = [&](int times, bool degree) {
    double off = 0.0;
    for (const double zenith_deg : {5.0, 25.0, 45.0, 64.0})
      for (const double azimuth_deg : {25.0, 75.0, 127.0, 200.0}) {
        const double mu = std::cos(zenith_deg * kPi / 180.0), azimuth = azimuth_deg * kPi / 180.0;
        const StokesVector seen = rendered(mu, azimuth, 0.0, true, halved(times)),
                           exact = kPi *
                                   solved.sunlit().sky({-mu, azimuth}, levels.altitude_km.front()).radiance();
        const double i = degree ? seen.i : 1.0, exact_i = degree ? exact.i : 1.0;
        if (!degree) off = std::max(off, std::abs(seen.i - exact.i));
        off = std::max(
            {off, std::abs(seen.q / i - exact.q / exact_i), std::abs(-seen.u / i - exact.u / exact_i)});
      }
    return off;
  };
  // Refined by cubic polynomials; linear between the standard directions 5.2e-4 are missed, and a degree of 0.014.
  const double coarse = worst(0, false), fine = worst(2, false);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_LT(fine, 2e-5);
  EXPECT_LT(fine, 0.25 * coarse);
  EXPECT_LT(worst(0, true), 2e-3);
}

}  // namespace
}  // namespace ifov::render::test_polarized_rayleigh

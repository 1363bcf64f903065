// Ground that glows lights the air: what haze takes out of the straight path comes back from beside it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/sensor/channel_light.h"
#include "atmosphere/sensor/sensor_geometry.h"
#include "core/format.h"
#include "io/document/document.h"
#include "radiometry/planck.h"
#include "session/assembly/atmosphere/atmosphere_assembly.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "transport/spectral_scene.h"

namespace ifov::session::test_warm_surroundings {
namespace {

constexpr double kGround_k = 300.0, kReflectance = 0.05;

Session plain(const char* surroundings) {
  return Session::load(
      io::parse_document(
          format(
              R"({{"ifov": 1, "scene": {{"materials": {{"soil": {{"reflectance": 0.05, "temperature": "300 K"}}}},
                     "objects": [{{"plane": {{}}, "material": "soil"}}]}},
                     "light": {{{}}},
                     "atmosphere": {{"profile": "US standard 1976", "aerosol": {{"visibility": "5 km"}}}},
                     "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [2, 2]}}}},
                       "channels": [{{"name": "8.6", "gaussian": {{"center": "8.6 um", "fwhm": "300 nm"}}}},
                                    {{"name": "10.9", "gaussian": {{"center": "10.9 um", "fwhm": "600 nm"}}}}]}},
                     "sampling": {{"single": {{}}}}}})",
              surroundings),
          "warm.json"),
      nullptr);
}

/// Of the channel, at the sensor: path as the renderer has it, and the surface in the sky as it has it.
double at_sensor(const Session& session, std::size_t channel) {
  const transport::SpectralScene& scene = *session.parts().spectral_scene;
  const radiometry::SpectralNodes& nodes = scene.nodes();
  std::vector<double> planck(nodes.node_count());
  nodes.planck(kGround_k, std::span<double>(planck));
  double sum = 0.0;
  for (std::size_t n = nodes.first_node(channel); n < nodes.first_node(channel + 1); ++n) {
    const double leaving = (1.0 - kReflectance) * planck[n] + kReflectance * scene.sky_radiance()[n];
    sum += nodes.node_weight(n) * (scene.view_radiance()[n] + leaving * scene.view_transmittance()[n]);
  }
  return sum;
}

TEST(WarmSurroundings, ScatterIntoThePathWhatTheyEmit) {
  const Session warm = plain(R"("surroundings": {"reflectance": 0.05, "temperature": "300 K"})"),
                cold = plain(R"("surroundings": {"reflectance": 0.05, "temperature": "20 K"})");
  const io::Document& document = warm.parts().document;
  const atmosphere::AtmosphereColumn column =
      assemble_column(document.sources, *document.atmosphere.modelled, document.scene.origin);
  atmosphere::SensorGeometry geometry;
  for (std::size_t c = 0; c < 2; ++c) {
    const auto all =
        atmosphere::solve_all_terms(column, warm.parts().channels[c], radiometry::Spectrum(), geometry);
    std::vector<double> emitted;
    for (const atmosphere::ChannelLight& part : all)
      emitted.push_back((1.0 - kReflectance) * radiometry::planck_w_m2_sr_um(part.wavelength_um, kGround_k));
    const double expected = atmosphere::lambertian_radiance(
        all, geometry, std::vector<double>(all.size(), kReflectance), emitted);
    EXPECT_NEAR(at_sensor(warm, c), expected, warm.parts().air[c].of(expected)) << c;
    EXPECT_NEAR(at_sensor(warm, c) / expected, 1.0, 5e-3) << c;
    // The planted fault: ground around that does not glow. 5 km of haze: 2 to 3 %.
    EXPECT_LT(at_sensor(cold, c), 0.985 * expected) << c;
  }
}

// Ground and ground around of one temperature without haze scatter nothing: both are the same.
TEST(WarmSurroundings, CountForNothingInClearAir) {
  const auto clear = [](const char* temperature) {
    return Session::load(
        io::parse_document(
            format(
                R"({{"ifov": 1, "scene": {{"materials": {{"soil": {{"reflectance": 0.05, "temperature": "300 K"}}}},
                       "objects": [{{"plane": {{}}, "material": "soil"}}]}},
                       "light": {{"surroundings": {{"reflectance": 0.05, "temperature": "{}"}}}},
                       "atmosphere": {{"profile": "US standard 1976", "aerosol": {{"type": "none"}}}},
                       "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [2, 2]}}}},
                         "channels": [{{"name": "10.9", "gaussian": {{"center": "10.9 um", "fwhm": "600 nm"}}}}]}},
                       "sampling": {{"single": {{}}}}}})",
                temperature),
            "clear.json"),
        nullptr);
  };
  // Nodes are chosen for the temperatures of the scene: the two differ by what their nodes leave.
  EXPECT_NEAR(at_sensor(clear("300 K"), 0) / at_sensor(clear("20 K"), 0), 1.0, 1e-3);
}

}  // namespace
}  // namespace ifov::session::test_warm_surroundings

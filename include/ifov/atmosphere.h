#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ifov/document.h"
#include "ifov/run_control.h"

namespace ifov {

/// What is asked about a document's atmosphere, and what is to be otherwise than the document says.
struct AtmosphereQuestion {
  struct Direction {
    double zenith_rad = 0.0, azimuth_rad = 0.0;  ///< from the ground towards it; azimuth clockwise from north
  };
  std::optional<Direction> sun = {}, view = {};
  bool night = false;  ///< no Sun
  std::optional<double> sensor_altitude_km = {};
  std::filesystem::path gas_model =
      {};  ///< in place of the document's (docs/formats/gas_model.md); empty: as it says
  double ground_reflectance = 0.0;  ///< of AtmosphereEffects::OverGround, 0 to 1
  /// In its place, a material of the document, whose scattering may depend on direction; or "surroundings", those of the document.
  std::string ground_material = {};
  bool spectrum =
      false;  ///< at the resolution of the band model, or of the gas model's bins, over the range of the sensor
  bool sky = false;              ///< the whole sky in one channel
  std::string sky_channel = {};  ///< empty: the one next to 0.45 um by day, to 10 um without a Sun
  int threads = 0;
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;
  LogSink* log = nullptr;
};

/// What the air does to the light of one channel: means over the response. Radiances in W m-2 sr-1 um-1, irradiances in
/// W m-2 um-1 on a level surface, both over black ground but for `over_ground`. Without a Sun, what is sunlight is 0.
struct AtmosphereEffects {
  double wavelength_um = 0.0;
  double solar_irradiance = 0.0;       ///< above the air, across the beam
  double sun_transmittance = 0.0;      ///< of direct sunlight, down to the ground
  double view_transmittance = 0.0;     ///< direct, from the ground to the sensor
  double diffuse_transmittance = 0.0;  ///< from bright ground all around to the sensor, scattered on the way
  double solar_path = 0.0, thermal_path = 0.0;  ///< radiance that the path to the sensor adds
  double direct_irradiance = 0.0;
  double solar_sky = 0.0, thermal_sky = 0.0;  ///< irradiance of the sky
  double spherical_albedo = 0.0;  ///< of the air for light from below, 0 where it was not computed
  /// Q and U of solar_path, about the vertical plane of the line of sight: Q > 0 where light swings in it, U > 0 where it swings
  /// 45 degrees counterclockwise of that as the sensor sees it.
  double path_q = 0.0, path_u = 0.0;

  /// The same air over level, uniform ground of the question's reflectance (Lambertian) or material, which emits nothing.
  /// Irradiances of level surfaces, sunlight and emission of the air together.
  struct OverGround {
    double ground_diffuse = 0.0, ground_up = 0.0;  ///< beside direct_irradiance
    double sensor_direct = 0.0, sensor_diffuse = 0.0,
           sensor_up = 0.0;                   ///< through the level at the sensor's altitude
    double radiance = 0.0, q = 0.0, u = 0.0;  ///< that the sensor receives
  } over_ground = {};
};

/// The sky over black ground, without the Sun's disc.
struct SkyLight {
  /// Where the sky's light is unpolarized, on the circle through the Sun and the zenith.
  struct NeutralPoint {
    std::string name;           ///< Babinet, Brewster, Arago
    double zenith_rad = 0.0;    ///< less than 0 on the side away from the Sun
    double distance_rad = 0.0;  ///< from the Sun; of Arago's from the point opposite
  };
  std::string channel;
  double wavelength_um = 0.0;
  bool thermal = false;            ///< emission outweighs sunlight
  std::vector<double> zenith_rad;  ///< 0 to pi / 2
  /// Counterclockwise from the Sun's, 0 to pi; the other half mirrors it, with -U.
  std::vector<double> azimuth_rad;
  std::vector<std::array<double, 3>> stokes;  ///< [zenith][azimuth]: I, Q, U in W m-2 sr-1 um-1
  std::vector<NeutralPoint> neutral_points;   ///< by day
};

/// What there is to tell of a document's atmosphere.
class IFOV_API AtmosphereReport {
 public:
  struct Channel {
    std::string name;
    double first_um = 0.0, last_um = 0.0;  ///< where the response is above half of its maximum
    AtmosphereEffects light;
  };
  std::vector<std::string> description;  ///< air, aerosol and geometry, a line each
  std::optional<double> sun_zenith_rad;  ///< none: no Sun above the horizon
  std::optional<double> sun_azimuth_rad;
  double view_zenith_rad = 0.0, sensor_altitude_km = 0.0;
  std::vector<Channel> channels;
  std::vector<AtmosphereEffects> spectrum;  ///< from short to long wavelengths; empty if not asked for
  double step_cm1 = 0.0;                    ///< of the spectrum
  std::optional<SkyLight> sky;              ///< none if not asked for

  /// The table of channels, for a terminal: at most 110 columns.
  std::string table() const;
  /// The spectrum as a table of paths (docs/formats/atmosphere_import.md). The report has a spectrum.
  std::string csv() const;
  /// The sky by direction, with its polarization. The report has a sky.
  std::string sky_csv() const;
  /// What correction codes ask for, a row for each channel, or with `steps` for each step of the spectrum, which the report has:
  /// CSV or NetCDF, as the name ends (.csv, .nc). Throws InputError for other endings, SystemError where it cannot be written.
  void write_summary(const std::filesystem::path& path, bool steps = false) const;
  /// Spectra and sky as PNG; the report has both. Throws SystemError where it cannot be drawn.
  std::string figure() const;

 private:
  struct Inside;
  std::shared_ptr<const Inside> inside_;
  friend struct FacadeAccess;
};

/// Answers without reading the scene's meshes and maps. Throws InputError where the document has no modelled
/// atmosphere, or names no such channel, and what Simulation::load does for atmosphere, light and sensor; Cancelled.
IFOV_API AtmosphereReport survey_atmosphere(const Document& document,
                                            const AtmosphereQuestion& question = {});

/// A cube of radiance at the sensor that is to become reflectance.
struct InversionQuestion {
  /// An ENVI file, its header, or a folder with one file NAME_radiance.img. Half-widths come from NAME_half_width.img beside
  /// it, where there is one of the same size.
  std::filesystem::path cube;
  /// NAME of NAME_reflectance.img and NAME_reflectance_half_width.img; empty: that of the cube, beside it.
  std::filesystem::path stem = {};
  int threads = 0;
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;
  LogSink* log = nullptr;
};

struct InversionOutcome {
  std::filesystem::path reflectance, half_width;  ///< what was written, ENVI, BIL, single precision
  std::uint64_t values = 0;
  std::uint64_t negative = 0;         ///< darker than the path alone: kept as they are
  std::string most_negative = {};     ///< the channel that has most of them
  std::uint64_t missing = 0;          ///< the cube holds no value there
  std::vector<std::string> left_out;  ///< channels that see no reflected sunlight: not a number
};

/// Reflectance of level, uniform Lambertian ground that the document's atmosphere, Sun and sensor make of a radiance, pixel by
/// pixel (docs/theory/atmosphere_inversion.md). Half-widths hold what the cube's do and the air's error, of its model too
/// where the document's intervals hold that. Reads the whole document. Throws InputError where it has no modelled
/// atmosphere, where the cube is not of its channels, or no channel sees reflected sunlight; SystemError of files;
/// Cancelled.
IFOV_API InversionOutcome invert_radiance(const Document& document, const InversionQuestion& question);

}  // namespace ifov

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/sensor/channel_points.h"
#include "atmosphere/sensor/kept_solutions.h"

namespace ifov::atmosphere {

class DirectionalGround;
class GroundModes;
struct SkyDirections;

/// All numbers that the solution of a column for a sensor depends on: whoever keeps answers keeps them by
/// these and by the program's version.
std::vector<double> solution_question(const ScatteringOptions& options, const SensorGeometry& geometry,
                                      const Levels& levels, const LayerOptics& optics);

/// Sunlight and light of the ground that the air scatters, at all points of a channel, from a few full
/// solutions: at one to four wavelengths across the channel, and up to six depths of gas. Light scattered
/// once on the way to the sensor is exact at every point, and so are the direct beams; what is interpolated
/// between the solutions are the ratios of everything else to them, which are smooth in wavelength and depth.
class ChannelScattering {
 public:
  /// Decides what is to be solved. Keeps references to the first four, and to the ground. `polarized`: Q and U are told, too.
  /// `ground`: what a ground that reflects by direction does to light of the air is told; null: none.
  ChannelScattering(const AtmosphereColumn& column, const ChannelPoints& points,
                    const SensorGeometry& geometry, const SkyDirections& directions,
                    const ScatteringOptions& options, bool polarized = false,
                    const DirectionalGround* ground = nullptr);

  std::size_t solutions() const { return nodes_.size(); }
  const LayerOptics& optics(std::size_t solution) const { return nodes_[solution].optics; }
  double wavelength_um(std::size_t solution) const;
  /// Whether there is sunlight; else only light of the ground is told.
  bool sunlit() const { return sunlit_; }
  /// Solves one of them, or takes it from what is kept (may be null); different ones may be solved at the
  /// same time.
  void solve(const ColumnSolver& solver, std::size_t solution, KeptSolutions* kept = nullptr);

  /// A point that lies far from the solutions, and the share of the channel's light that it stands for.
  struct WeakPoint {
    std::size_t point = 0;
    double share = 0.0;
  };
  /// One or two, of different gaps between the solutions; their shares add up to 1.
  std::vector<WeakPoint> weak_points() const;

  /// By point, once everything is solved. Radiances and irradiances are of the Sun's light at the point.
  struct AtPoints {
    std::vector<double> once;  ///< of the path: light scattered once
    std::vector<double> path, sky_irradiance, diffuse_transmittance, spherical_albedo;
    /// [line][point] and [height][point].
    std::vector<std::vector<double>> line_of_sight_path, line_of_sight_diffuse, sky_at_height;
    /// [solution]: the share of each solution in the shapes of the sky.
    std::vector<std::vector<double>> share;
    /// The same in light that the air emits.
    std::vector<std::vector<double>> emission_share;
    /// Q and U of the paths, Q of what they let through diffusely, about the vertical plane: of the geometry's
    /// own line of sight, then of its sights, [line][point], with azimuths read as counterclockwise. Empty
    /// unless asked for.
    std::vector<std::vector<double>> path_q, path_u, diffuse_q;
    /// Where the geometry wants level fluxes: sunlight that goes up through the sensor's level; of all light that leaves level
    /// ground alike in every direction, what goes up there, and what comes down.
    std::vector<double> level_up, ground_up, ground_down;
    /// Of light that leaves a directional ground with an exitance of pi: I, Q and U that reach the sensor diffusely, the
    /// geometry's own line of sight first, [line][point]; what comes back to it, over pi; and where the geometry wants level
    /// fluxes, as ground_up and ground_down. Empty without such a ground.
    std::vector<std::vector<double>> reflected_i, reflected_q, reflected_u;
    std::vector<double> reflected_albedo, reflected_up, reflected_down;
  };
  AtPoints at_points() const;

  /// The sky of a solution, [zenith][azimuth], for an irradiance of 1 on level ground, and [zenith] the sky
  /// over ground of radiance 1 for a spherical albedo of 1.
  const std::vector<double>& sky_shape(std::size_t solution) const { return nodes_[solution].sky; }
  const std::vector<double>& groundlit_shape(std::size_t solution) const {
    return nodes_[solution].groundlit;
  }
  /// Q and U of these, in the same units, about the vertical planes of directions with azimuths counted
  /// counterclockwise from the Sun's. Empty unless asked for.
  struct SkyPolarization {
    std::vector<double> q, u, groundlit_q;
  };
  const SkyPolarization& sky_polarization(std::size_t solution) const {
    return nodes_[solution].sky_polarization;
  }
  /// The sky over directional ground, [component of (I, Q, U)][zenith][azimuth], for an exitance of pi and an albedo of the air
  /// for it (reflected_albedo) of 1.
  std::span<const double> reflected_shape(std::size_t solution) const {
    return std::span(nodes_[solution].reflected).subspan(reflected_head());
  }

 private:
  /// Of one line of sight: light scattered more than once over its I, diffuse transmittance over its I.
  struct LinePolarization {
    double q = 0.0, u = 0.0, diffuse_q = 0.0;
  };
  struct Node {
    std::size_t wavelength = 0, depth = 0;
    LayerOptics optics;
    // Logarithms of all light over path_base(), of the sky's light over the direct beam's, of the
    // diffuse over the direct transmittance, of the spherical albedo.
    double path = 0.0, sky_irradiance = 0.0, diffuse_transmittance = 0.0, spherical_albedo = 0.0;
    // The same by line of sight and by height.
    std::vector<double> line_of_sight_path, line_of_sight_diffuse, sky_at_height;
    std::vector<double> sky, groundlit;
    std::vector<LinePolarization> lines;  // the geometry's own, then its lines of sight
    SkyPolarization sky_polarization;
    // The flux up through the sensor's level over light scattered once towards it, of ground's light what goes up there over what
    // does so straight, and what comes down.
    double level_up = 0.0, ground_up = 0.0, ground_down = 0.0;
    /// Of directional ground, relative to Lambertian: reflected_albedo, what goes up and comes down at the level; by line diffuse
    /// transmittance, and its Q and U over its I; then the shape of the sky.
    std::vector<double> reflected;
    std::vector<double> packed(bool level_fluxes) const;
    void unpack(std::span<const double> answer, const SensorGeometry& geometry,
                const SkyDirections& directions, bool polarized, std::size_t reflected_count);
  };
  /// What a solution counts at a point.
  struct Part {
    const Node* node;
    std::size_t solution;
    double plain, scaled, emitted;
  };
  std::vector<Part> parts_at(std::size_t point) const;
  /// The same, whose `plain` goes by an amount of gas at the point and in all solutions in place of the whole column's.
  std::vector<Part> parts_by_gas(std::vector<Part> parts, double here,
                                 std::span<const double> of_solutions) const;
  /// Of the layers' depths the part between two altitudes above mean sea level.
  double between(double low_km, double high_km, std::span<const double> depth) const;
  void solve(const ColumnSolver& solver, Node& node) const;
  std::vector<double> question(const ColumnSolver& solver, const Node& node) const;
  void choose_nodes();
  void make_room_for_modes();
  LayerOptics optics_at(double log_wavelength, double depth) const;
  void solve_lines_of_sight(const ColumnSolution& solved, const std::optional<ChannelPoints::Beams>& base,
                            Node& node) const;
  /// `once`: sunlight scattered once into the sensor's line of sight.
  /// What the light of a path is interpolated over: what is scattered once towards the sensor; under a low Sun, whose light may not
  /// reach that way or through so much gas that hardly any is left, a little of what is scattered once on the way to space besides.
  static double path_base(double once, double once_to_space) {
    constexpr double kOfSpace = 0.03;
    return once + kOfSpace * once_to_space;
  }
  bool low_sun() const;
  /// 0 unless the Sun is low.
  double once_to_space(const SlantSource& ring, double view_azimuth_rad, double surface_km) const;
  /// Logarithm of all light of a path over path_base().
  double over_base(const PathLight& path, double once_to_space) const;
  void solve_fluxes(const ColumnSolution& solved, double base, Node& node) const;
  /// Of the points, by what solutions count there; `below`: to ground's light on the way to the sensor.
  void add_fluxes(std::size_t point, const std::vector<Part>& parts, const std::vector<Part>& below,
                  double base, AtPoints& at) const;
  /// Vertical extinction depth between the ground and the sensor.
  double depth_to_sensor(const LayerOptics& layers) const;
  /// `scale` and `groundlit_scale`: of the shapes of the sky.
  void solve_polarization(const ColumnSolution& solved, double scale, double groundlit_scale,
                          Node& node) const;
  /// Q and U of a line at a point, whose light scattered once, whole path radiance and diffuse transmittance
  /// are known.
  void polarize(std::size_t line, std::size_t point, const std::vector<Part>& parts, const StokesVector& once,
                double path, double diffuse, AtPoints& at) const;
  /// Numbers of Node::reflected before the shape of the sky, and all.
  std::size_t reflected_head() const { return 3 + 3 * (1 + geometry_.lines_of_sight.size()); }
  std::size_t reflected_count() const;
  /// The ground's modes at a wavelength of the solutions, made once.
  std::shared_ptr<const GroundModes> ground_modes(const ColumnSolver& solver, std::size_t wavelength) const;
  void solve_reflected(const ColumnSolution& solved, Node& node) const;
  void add_reflected(std::size_t point, const std::vector<Part>& parts, AtPoints& at) const;
  /// The geometry's own line of sight, then its lines of sight.
  std::vector<LineOfSight> lines() const;
  Propagation towards_sensor() const;
  /// Of light that may be none.
  static double log_ratio(double a, double b);
  /// Depth as the ratio of all light to light scattered once varies with it.
  static double scaled_depth(double gas_depth);
  /// The same as light varies that gas emits: to what is an opaque body, and from the more distant air the less.
  static double emitted_depth(double gas_depth);

  const AtmosphereColumn& column_;
  const ChannelPoints& points_;
  const SensorGeometry& geometry_;
  const SkyDirections& directions_;
  ScatteringOptions options_;
  bool sunlit_, polarized_;
  const DirectionalGround* ground_;
  struct Modes;
  std::shared_ptr<Modes> modes_;
  std::vector<double> log_wavelength_, depth_, scaled_depth_, emitted_depth_;  // of the nodes, rising
  std::vector<Node> nodes_;                                                    // [wavelength][depth]
};

}  // namespace ifov::atmosphere

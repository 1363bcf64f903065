#include "io/document/cameras/flight_motion.h"

#include <algorithm>
#include <array>

#include "core/overloaded.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/cameras/framed_places.h"
#include "io/document/cameras/jitter_table.h"
#include "io/document/cameras/mounts.h"
#include "io/document/mount_document.h"
#include "io/document/platform_document.h"
#include "platform/power_spectrum.h"
#include "platform/trajectory.h"
#include "platform/wander.h"

namespace ifov::io {
namespace {

using platform::PowerSpectrum;
using platform::Wander;

/// East, north, up, yaw, pitch, roll, as of Deviation::motion.
using Spectra = std::array<PowerSpectrum, 6>;

/// Draws of one seed that are not to be alike.
enum class Stream : std::uint64_t { jitter, reported };

/// Of three deviations, from yaw, pitch and roll.
template <class Make>
Spectra turns(const geodesy::Attitude& rms, const Make& make) {
  Spectra spectra;
  const std::array<double, 3> each{rms.yaw_rad, rms.pitch_rad, rms.roll_rad};
  for (std::size_t k = 0; k < 3; ++k)
    if (each[k] > 0.0) spectra[3 + k] = make(each[k]);
  return spectra;
}

Spectra spectra_of(const JitterDocument& jitter) {
  return std::visit(
      Overloaded{[](const WhiteJitter& white) {
                   return turns(white.rms,
                                [&](double rms) { return PowerSpectrum::flat(white.up_to_hz, rms); });
                 },
                 [](const FallingJitter& falling) {
                   return turns(falling.rms, [&](double rms) {
                     return PowerSpectrum::falling(falling.corner_hz, falling.slope, falling.up_to_hz, rms);
                   });
                 },
                 [](const TabulatedJitter& tabulated) {
                   JitterSpectra table = read_jitter_table(tabulated.file.path);
                   Spectra spectra;
                   spectra[3] = std::move(table.yaw), spectra[4] = std::move(table.pitch);
                   spectra[5] = std::move(table.roll);
                   return spectra;
                 }},
      jitter);
}

Spectra noise_of(const ReportedPose& reported) {
  const auto flat = [&](double rms) { return PowerSpectrum::flat(reported.noise_up_to_hz, rms); };
  Spectra spectra = turns(reported.attitude_noise, flat);
  const math::Vec3 noise = reported.position_noise_m;
  const std::array<double, 3> places{noise.x, noise.y, noise.z};
  for (std::size_t k = 0; k < 3; ++k)
    if (places[k] > 0.0) spectra[k] = flat(places[k]);
  return spectra;
}

/// At the ends, and often enough between them for what turns by a few turns meanwhile.
std::vector<double> bearing_times_s(double from_s, double to_s) {
  constexpr int kChecks = 256;
  std::vector<double> times_s;
  for (int k = 0; k <= (to_s > from_s ? kChecks : 0); ++k)
    times_s.push_back(from_s + (to_s - from_s) * k / kChecks);
  return times_s;
}

}  // namespace

Motions motions_of(const PlatformFlight& flight, const SceneFrame& scene, double from_s, double to_s,
                   double beyond_s) {
  const PlatformDocument& of = flight.platform;
  const platform::Trajectory path = trajectory_of(flight, scene, from_s, to_s);
  const auto drawn = [&](const Spectra& spectra, Stream stream) {
    return std::make_shared<const Wander>(spectra, flight.seed, static_cast<std::uint64_t>(stream),
                                          from_s - beyond_s, to_s + beyond_s);
  };
  const auto carrying = [&](platform::Deviation deviation) {
    return std::make_shared<const platform::Trajectory>(path.carrying(std::move(deviation)));
  };
  const std::vector<platform::Mount> mounts = mounts_of(flight, scene, from_s, to_s);
  Motions motions;
  if (!mounts.empty() || of.jitter) {
    platform::Deviation deviation{.mounts = mounts};
    if (of.jitter) deviation.motion = drawn(spectra_of(*of.jitter), Stream::jitter);
    motions.truth = carrying(std::move(deviation));
    motions.truth->check_bearings(bearing_times_s(from_s, to_s));
  } else {
    motions.truth = std::make_shared<const platform::Trajectory>(path);
  }
  if (of.reported) {
    platform::Deviation deviation{of.reported->position_bias_m,
                                  of.reported->attitude_bias,
                                  drawn(noise_of(*of.reported), Stream::reported),
                                  mounts,
                                  {}};
    const std::span<const MountDocument> measured = mounts_in(of.reported->mounts);
    deviation.mounts.resize(std::max(mounts.size(), measured.size()));
    for (std::size_t k = 0; k < measured.size(); ++k) {
      deviation.mounts[k].lever_arm_m = measured[k].lever_arm_m;
      deviation.mounts[k].boresight = measured[k].boresight;
    }
    if (std::any_of(mounts.begin(), mounts.end(),
                    [](const platform::Mount& mount) { return mount.bearing != nullptr; }))
      deviation.read_on = carrying({.mounts = mounts});
    motions.reported = carrying(std::move(deviation));
  }
  return motions;
}

std::vector<std::string> bearings_told(const PlatformFlight& flight, const SceneFrame& scene, double from_s,
                                       double to_s) {
  constexpr double kBeyond_s = 0.01;
  if (mounts_in(flight.platform.mounts).empty()) return {};
  return motions_of(flight, scene, from_s, to_s, kBeyond_s)
      .truth->bearings_told(bearing_times_s(from_s, to_s));
}

}  // namespace ifov::io

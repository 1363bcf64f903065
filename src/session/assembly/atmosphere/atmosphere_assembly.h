#pragma once

#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "radiometry/spectral_nodes.h"
#include "session/assembly/atmosphere/atmosphere_subject.h"

namespace ifov::atmosphere {
class AtmosphereColumn;
class KeptSolutions;
class SensorAtmosphere;
struct SensorAltitudes;
struct SensorGeometry;
struct GasTermTable;
struct LineOfSightRange;
}  // namespace ifov::atmosphere
namespace ifov::io {
struct AtmosphereDocument;
struct CameraDocument;
struct ChannelDocument;
struct ModelledAtmosphere;
struct OriginDocument;
struct SensorDocument;
}  // namespace ifov::io
namespace ifov::scene {
struct Sun;
}

namespace ifov::session {

/// Lines of sight closer to the horizon than this are not those of a plane-parallel atmosphere.
inline constexpr double kLowestView_rad = 80.0 * std::numbers::pi / 180.0;

/// Where the tables of the modelled atmosphere begin and end.
inline constexpr double kShortest_um = 0.2, kLongest_um = 50.0;

/// Throws InputError at the first of the channels, `written` so in the document, that reaches beyond these.
void check_channels(const io::DocumentSources& sources, std::span<const io::ChannelDocument> written,
                    std::span<const radiometry::Channel> channels);

/// What was changed in what was asked for, and clouds that cannot be.
void warn_of_column(const io::ModelledAtmosphere& air, const atmosphere::AtmosphereColumn& column,
                    LogSink& log);

/// The air that a document describes, over ground as high as the scene's origin where it does not say. Throws InputError.
atmosphere::AtmosphereColumn assemble_column(const io::DocumentSources& sources,
                                             const io::ModelledAtmosphere& air,
                                             const io::OriginDocument& origin);

/// Sun and sensor over ground at this altitude. Throws InputError, at the place in the document.
atmosphere::SensorGeometry sensor_geometry(const io::DocumentSources& sources,
                                           const io::ModelledAtmosphere& air,
                                           const io::CameraDocument& written, const sensor::Camera& camera,
                                           const std::optional<scene::Sun>& sun, double ground_km);

/// The altitudes that the sensor has while the lines of an image are exposed, over ground at this altitude.
atmosphere::SensorAltitudes sensor_altitudes(const io::ModelledAtmosphere& air, const sensor::Camera& camera,
                                             double ground_km);

/// The lines of sight of an image, over surfaces up to this height.
atmosphere::LineOfSightRange line_of_sight_range(const sensor::Camera& camera,
                                                 const std::optional<scene::Sun>& sun, double highest_m);

/// The warning about channels that are narrower than the band model or the bins of a gas model (may be null) resolve; empty
/// without any.
std::string narrow_channels(std::span<const radiometry::Channel> channels,
                            const atmosphere::GasTermTable* terms);

/// How an atmosphere is worked out; the pointers may be null.
struct AtmosphereWork {
  int threads = 0;
  atmosphere::KeptSolutions* kept = nullptr;
  std::function<void(std::size_t, std::size_t)> progress;  ///< solutions done, of how many; may throw
  LogSink* log = nullptr;
};

/// A document's modelled atmosphere as the channels of its sensor see it from its camera. `surfaces` and `demands`
/// as for radiometry::SpectralNodes::build. Throws InputError, at the place in the document.
std::unique_ptr<atmosphere::SensorAtmosphere> assemble_atmosphere(
    const io::AtmosphereDocument& written, const io::OriginDocument& origin, const io::SensorDocument& sensor,
    const AtmosphereSubject& subject, std::span<const radiometry::Spectrum> surfaces,
    radiometry::NodeDemands demands, const AtmosphereWork& work);

}  // namespace ifov::session

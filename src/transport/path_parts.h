#pragma once

#include <array>
#include <cstdint>

#include "math/ray.h"
#include "transport/emitters.h"
#include "transport/mirrors/mirror_paths.h"
#include "transport/path_tracer.h"
#include "transport/separate_images.h"

/// What a PathTracer keeps of paths and rays while it traces them: for its own sources alone.
namespace ifov::transport {

/// What next-event estimation to emitters has to know of a scattered ray.
struct PathTracer::Departure {
  Receiver receiver;
  double density = 0.0;             // of the ray's direction, 1/sr, choice of the side included
  double seek_probability = 0.0;    // that emitters were sought on this side; 0: they were not
  double mirror_probability = 0.0;  // that they were sought by way of a certain plane of mirrors
  bool unfolded = false;            // the receiver stands behind the mirror that the path has come by
  bool by_pane = false;             // only by panes: the receiver stands where it stood
  bool by_rounds = false;           // they were sought by way of round mirrors
  std::uint32_t round = kNone;      // that the path has come by, with the coefficients of its image
  std::array<double, 3> widens{};
};

/// The mirrors that a path came by since the sensor or the last surface where sunlight was sought.
struct PathTracer::Way {
  std::array<std::uint16_t, SunImages::kMostReflections> facings{};
  std::uint8_t reflections = 0;
  bool from_sensor = true;
  bool flat = true;     // all of them have a facing
  bool unseen = false;  // sunlight by this way is found by random paths alone
  bool by_lobe =
      false;  // it began at a surface whose lobe is too narrow for what is sent to what throws light
  // Of panes and media that the path came through.
  bool passed = false;     // any
  bool in_medium = false;  // the path is within one
  bool entered = false;    // which it entered on this way, flying along `outside` before
  bool broken = false;     // it was refracted in a way that is not sought
  math::Vec3 outside{};
};

struct PathTracer::Path {
  math::Ray ray;
  PathKey key;
  std::uint32_t number = 0;  // in the record
  bool sees_sun = true;      // no next-event estimation was made for this segment
  Departure left;            // where it left the surface before
  Way way;
  SeparateImages::Mirror mirror = SeparateImages::kNone;  // that it came by straight from the sensor
  bool direct = true;                                     // by mirrors and boundaries alone
  std::uint8_t forks = 0;        // at which it took one side and another path the other
  float share = 1.0f;            // of light that it brings to the sensor, at most
  std::uint32_t medium = kNone;  // that its ray is in: index into media_
  // Of the sunlight on a lobe that is sought (SunLobes::sought), if that is what it meets: the rest was sought from where it comes from.
  float sunlight = 1.0f;
  bool to_lobe = false;  // it was sent for that sunlight, and for nothing else
};

struct PathTracer::SurfaceEvent {  // a path that scatters at this depth
  std::uint32_t path = 0;
  std::uint32_t number = 0;      // in the record: the path's, or that of the other side of a fork
  std::uint32_t shadow = kNone;  // index of its shadow ray
  PathVertex vertex;             // sunlight as if nothing blocked it
  math::Ray next;
  bool next_sees_sun = false;
  Departure left;
  std::uint32_t seek = kNone;  // index of its ray to an emitter
  // Probability that one was sought for what is reflected; below 0: none was sought.
  double seek_reflected = -1.0;
  Way next_chain;
  float rare_sun =
      0.0f;  // of the Sun's irradiance, 1/sr: may come to the sensor where its shadow ray is free
  SeparateImages::Mirror next_mirror = SeparateImages::kNone;
  bool next_direct = false;
  std::uint8_t next_forks = 0;
  float next_share = 0.0f;
  std::uint32_t next_medium = kNone;
  float sunlight = 1.0f;       // share of sunlight that counts here
  float next_sunlight = 1.0f;  // of the path that goes on
  bool next_to_lobe = false;
  bool sun_outside = false;  // its shadow ray leaves the path's medium
};

/// A ray towards light on its way through what may let it pass.
struct PathTracer::PassingRay {
  std::uint32_t event = 0;
  math::Ray ray;
  math::Vec3 towards;                        // in which direction it must leave
  double share = 1.0;                        // of light that comes through, at most
  std::uint32_t passes = PathVertex::kNone;  // in the record
  std::uint32_t medium = kNone;
  std::uint32_t light = kNone;  // index into sunken_, of a ray from within a medium
};

struct PathTracer::Seek {  // a ray that was sent to an emitter
  Emitters::Aim aim;
  double weight = 0.0;  // what the sought emission counts if it is seen
};

struct PathTracer::MirrorSeek {  // a ray that was sent to an emitter by way of a mirror
  Emitters::Piece piece;
  std::uint32_t event = 0;
  std::uint32_t plane = kNone;  // of a flat one, and the direction from there
  math::Vec3 onward;
  std::uint32_t round = kNone;  // a round one, the place on it and that of the light
  math::Point3 at, light_at;
  math::Ray ray;
  PathRecord::Mirrored light;
};

/// Where the Sun's light may reach a surface from, and what is made of it there.
struct PathTracer::SunRay {
  math::Ray ray;
  double weight = 0.0;  // 0: none
  bool transmitted = false;
};

struct PathTracer::MirrorRay : MirrorPath {
  std::uint32_t event = 0;  // index into events_
  PathRecord::Mirrored light;
};

/// A sphere about what throws sunlight that is not sought.
struct PathTracer::Thrower {
  math::Point3 centre_m;
  double radius_m = 0.0;
};

/// A ray towards such things.
struct PathTracer::UnseenRay {
  std::uint32_t event = 0;
  float weight = 0.0f;
  math::Ray ray;
};

}  // namespace ifov::transport

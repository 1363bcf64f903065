#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/vec3.h"
#include "scene/resolved_surface.h"
#include "transport/surface_lobe.h"

namespace ifov::transport {

/// A surface that a path met, as far as its light is concerned. Spectra are in spectral nodes.
struct PathVertex {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t next = kNone;         ///< the next of the same path
  std::uint32_t mixed = kNone;        ///< index into PathRecord::mixed, whose spectra have to be computed
  const float* emission = nullptr;    ///< null: nothing, or that of `mixed`
  const float* sun_factor = nullptr;  ///< what is made of sunlight; null: of `mixed`
  /// What is made of the light of the path's next segment; null: of `mixed`.
  const float* continuation_factor = nullptr;
  float sun_weight = 0.0f;           ///< of factor times solar irradiance; 0: none arrives
  float continuation_weight = 0.0f;  ///< of the factor, probabilities included; 0: the path ends here
  bool sun_transmitted = false, continuation_transmitted = false;  ///< transmitted, not reflected
  bool sought_transmitted = false;
  /// Share of its own emission that the ray which came here counts; the rest was sought.
  float emission_weight = 1.0f;
  /// Of factor times emission of an emitter that was sought from here; 0: none was seen.
  float sought_weight = 0.0f;
  const float* sought_factor = nullptr;    ///< null: of `mixed`
  const float* sought_emission = nullptr;  ///< null: of `sought_mixed`
  std::uint32_t sought_mixed = kNone;      ///< index into PathRecord::mixed
  std::uint32_t mirrored = kNone;  ///< index into PathRecord::mirrored: sunlight that came by way of mirrors
  /// Indices into PathRecord::passes: what the Sun's light, and that of the emitter, came through.
  std::uint32_t sun_passes = kNone, sought_passes = kNone;
  /// Index into PathRecord::segments: the medium that the path came through to here.
  std::uint32_t segment = kNone;
  bool segment_shines = true;  ///< what the medium emits counts here
  double height_m = 0.0;
};

/// What paths did between the sensor and the light, without a spectrum: all that rays and random numbers decide.
struct PathRecord {
  struct Path {
    /// Another path that began as this one and took the other side of a boundary: its light is added to this one's.
    std::uint32_t also = PathVertex::kNone;
    std::uint32_t first = PathVertex::kNone, last = PathVertex::kNone;  ///< of its vertices
    math::Vec3 towards_sensor;
    double sensor_height_m = 0.0;           ///< where the first segment starts
    double seen_height_m = 0.0;             ///< of what the first segment met
    double seen_x_m = 0.0, seen_y_m = 0.0;  ///< of that; of where it comes through z = 0 if it met nothing
    std::uint32_t seen_material = 0;        ///< its first constituent's, if it met anything
    bool met = false;                       ///< the first segment met something
    bool escaped = false;                   ///< its last segment met nothing
    bool escaped_sees_sun = false;          ///< no sunlight was sent for where that segment starts
    math::Vec3 escaped_direction;
    double escaped_from_m = 0.0;  ///< height at which that segment starts
    /// At least the throughput in any node; kept where there are mirrors (SunMirrors).
    float brightest = 1.0f;
    /// Of the Sun's irradiance, 1/sr: what may come by ways that are not sought (WideSun).
    float unseen = 0.0f;

    /// TransportOptions::sky_shares of its first surface; 0: none.
    float sky_share = 0.0f;
    /// Whether the Sun was seen where the ray that was sent to it from the first surface went; if one was, and came through nothing.
    enum class SunSeen : std::uint8_t { not_asked, seen, hidden } first_sun = SunSeen::not_asked;
    math::Vec3 first_normal,
        left_first;  ///< of that surface, and the direction in which it leaves; where sky_share is not 0

    /// Whether it brings nothing.
    bool empty() const { return first == PathVertex::kNone && !escaped; }
  };
  /// A surface whose spectra are not kept: mixed, of mapped temperature, or of a model that depends on direction.
  struct Mixed {
    scene::ResolvedSurface surface;
    SurfaceLobe lobe;
    math::Vec3 outgoing;  ///< towards where the path comes from
    /// Index into PathRecord::events; none where the lobe is separable.
    std::uint32_t events = PathVertex::kNone;
  };
  /// Of one surface, by what light met it.
  struct Events {
    LobeEvent sun, sought, continuation;
  };
  /// Light that reached a vertex by way of mirrors: the Sun's, or an emitter's.
  struct Mirrored {
    static constexpr std::size_t kMost = 8;
    std::uint32_t next = PathVertex::kNone;  ///< of the same vertex
    float weight = 0.0f;       ///< of the factors' product with the Sun's irradiance, or the emission
    bool transmitted = false;  ///< transmitted by the vertex, not reflected
    std::uint8_t count = 0;    ///< of mirrors
    struct Factor {
      const float* spectrum = nullptr;  ///< null: of `mixed`
      std::uint32_t mixed = PathVertex::kNone;
      std::uint32_t event = PathVertex::kNone;  ///< index into PathRecord::way_events
    };
    Factor surface;                                ///< of the vertex
    std::array<Factor, kMost> mirrors;             ///< the surface's next one first
    std::array<std::uint32_t, kMost> passes_at{};  ///< of each: the passes between the surface and it
    std::uint32_t passes = PathVertex::kNone;      ///< index into PathRecord::passes
    double height_m = 0.0;                         ///< of the mirror that sees the Sun
    bool emitted = false;                          ///< not sunlight, but:
    const float* emission = nullptr;               ///< null: of `emission_mixed`
    std::uint32_t emission_mixed = PathVertex::kNone;
  };
  /// A way through a medium.
  struct Segment {
    scene::Constituent medium;
    double length_m = 0.0;
  };
  /// What light comes through on its way to a surface, farthest first: a pane or boundary, or a segment of a medium.
  struct Pass {
    Mirrored::Factor factor;
    std::uint32_t segment = PathVertex::kNone;
    std::uint32_t next = PathVertex::kNone;
  };
  /// Of a vertex, where polarization is asked for (SpectralScene::polarized()).
  struct Directions {
    math::Vec3 outgoing;                          ///< unit, towards where the path comes from
    math::Vec3 incoming;                          ///< unit, along the path's next segment
    math::Vec3 normal;                            ///< that its lobe scatters about, on the side of `outgoing`
    const materials::Bsdf* polarizing = nullptr;  ///< its lobe's model; null: that depolarizes
  };
  std::vector<Path> paths;
  std::vector<PathVertex> vertices;
  std::vector<Mixed> mixed;
  std::vector<Events> events;
  std::vector<LobeEvent> way_events;  ///< at surfaces that mirrors light
  std::vector<Mirrored> mirrored;
  std::vector<Segment> segments;
  std::vector<Pass> passes;
  std::vector<Directions> directions;  ///< by vertex; empty where nobody asks

  void start(std::size_t count) {
    paths.assign(count, {});
    vertices.clear();
    mixed.clear();
    events.clear();
    way_events.clear();
    mirrored.clear();
    segments.clear();
    passes.clear();
    directions.clear();
  }
  void add(std::uint32_t path, const PathVertex& vertex) {
    const auto index = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(vertex);
    Path& p = paths[path];
    if (p.last == PathVertex::kNone)
      p.first = index;
    else
      vertices[p.last].next = index;
    p.last = index;
  }
};

}  // namespace ifov::transport

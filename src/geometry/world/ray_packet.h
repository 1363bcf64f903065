#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "geometry/height_field.h"
#include "geometry/surface_point.h"
#include "geometry/world/presence_table.h"
#include "geometry/world/primitive_sets.h"

namespace ifov::geometry {

inline constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

inline constexpr int kLanes = 8;

/// What a lane of a packet has met. Embree's numbers: `prim` within the set, `instance`
/// RTC_INVALID_GEOMETRY_ID for the sets of the scene itself.
struct Candidate {
  enum Kind : std::uint32_t { none, plane, triangle, analytic, field } kind = none;
  std::uint32_t instance = RTC_INVALID_GEOMETRY_ID;
  std::uint32_t prim = 0;
  std::uint32_t face = 0;
  const void* set = nullptr;  ///< of a plane: its object's number
};

/// A body in the scene, as an instance or copied: its numbers are added to those within the body's set. A
/// copy's triangles begin at `set_triangle` of the set it shares; additions are modulo 2^32.
struct Piece {
  std::uint32_t object = 0;
  std::uint32_t of = 0;         ///< template with the body
  std::uint32_t materials = 0;  ///< where its materials begin
  std::uint32_t first_patch = 0, first_analytic = 0, first_triangle = 0;
  std::uint32_t set_triangle = 0;
};

/// A height field in the scene. "Centred": about the scene's centre.
struct PlacedField {
  std::shared_ptr<const HeightField> field;
  math::Transform centred_from_field, field_from_centred;
  double padding_m = 0.0;  ///< by which bounds are widened against Embree's rounding
  std::uint32_t object = 0, material = 0;
};

/// How instances and objects are looked up while a packet is under way.
struct InstanceTable {
  const math::Transform* set_from_scene = nullptr;  ///< by Embree's instance number
  const Piece* instances = nullptr;                 ///< by Embree's instance number
  const Piece* copies = nullptr;                    ///< by the owner of a primitive in a shared set
};

struct RayPacket;

/// Asked whether a triangle has a hole where a lane of a packet meets it. `t`: distance in double, NaN where it is not known;
/// `seen`: Embree's.
class HoleTest {
 public:
  virtual bool is_open(const RayPacket& packet, std::size_t k, const TriangleSet& set, std::uint32_t instance,
                       std::uint32_t prim, double t, double seen) const = 0;

 protected:
  ~HoleTest() = default;
};

/// Eight rays in double beside Embree's float ones. Embree proposes primitives; which is nearest is decided
/// here, by its float distance where that is clear and by the exact distance where two lie within `window_m`
/// of each other or of the ray's ends. Of surfaces of unlike objects within `same_m` of the nearest, which lie in one
/// place but for the rounding of doubles, that of the object placed last counts. So neither the order in which Embree
/// visits primitives nor rounding shows in the answer.
struct RayPacket {
  static constexpr int kMostSame = 6;  ///< surfaces in one place besides the nearest that are told apart

  RTCIntersectContext context;  // first: Embree hands back a pointer to it
  InstanceTable table;
  const HoleTest* holes = nullptr;        ///< null: nothing has any
  const PresenceTable* visits = nullptr;  ///< null: everything is always there
  double window_m = 0.0, same_m = 0.0;

  // Rays from a start near the scene, in the frame about the scene's centre; distances count from that start.
  alignas(64) double x[kLanes], y[kLanes], z[kLanes], dx[kLanes], dy[kLanes], dz[kLanes];
  alignas(64) double low[kLanes], high[kLanes];
  double time_s[kLanes];             ///< read where there are `visits`
  alignas(64) double near[kLanes];   ///< distance of the best candidate as Embree sees it
  alignas(64) double exact[kLanes];  ///< the same in double; NaN: not asked for yet
  Candidate best[kLanes];
  struct Same {
    double exact = 0.0;
    Candidate candidate;
  };
  Same same[kLanes][kMostSame];  ///< behind the best, at most same_m
  std::uint8_t same_count[kLanes];

  math::Point3 start(std::size_t k) const { return {x[k], y[k], z[k]}; }
  math::Vec3 direction(std::size_t k) const { return {dx[k], dy[k], dz[k]}; }

  /// Distance in double of a triangle's plane.
  double facet_distance(std::size_t k, const TriangleSet& set, std::uint32_t instance,
                        std::uint32_t prim) const {
    const Facet& f = set.facets[prim];
    math::Point3 p = start(k);
    math::Vec3 d = direction(k);
    if (instance != RTC_INVALID_GEOMETRY_ID) {
      const math::Transform& map = table.set_from_scene[instance];
      p = map(p), d = map(d);
    }
    return (f.offset_m - (f.normal.x * p.x + f.normal.y * p.y + f.normal.z * p.z)) / dot(f.normal, d);
  }

  /// Instance number and primitive number in the object, for ties.
  std::uint64_t rank(const Candidate& c) const {
    if (c.kind == Candidate::plane) return std::uint64_t{*static_cast<const std::uint32_t*>(c.set)} << 32;
    if (c.kind == Candidate::field)
      return (std::uint64_t{static_cast<const PlacedField*>(c.set)->object} << 32) | c.prim;
    const bool triangle = c.kind == Candidate::triangle;
    const auto* triangles = triangle ? static_cast<const TriangleSet*>(c.set) : nullptr;
    const Piece* piece;
    if (c.instance != RTC_INVALID_GEOMETRY_ID)
      piece = &table.instances[c.instance];
    else
      piece = &table.copies[triangle ? triangles->owner(c.prim)
                                     : static_cast<const AnalyticSet*>(c.set)->owners[c.prim]];
    const std::uint32_t number =
        triangle ? triangles->number(c.prim) + piece->first_triangle : c.prim + piece->first_analytic;
    return (std::uint64_t{piece->object} << 32) | number;
  }

  /// Whether a candidate at Embree's distance `seen` becomes the best one. `t` is its exact distance, or NaN.
  bool take(std::size_t k, double seen, double t, const Candidate& c) {
    if (seen >= near[k] - window_m) {
      if (seen > near[k] + window_m) return false;
      if (std::isnan(t)) t = distance(k, c);
      if (std::isnan(exact[k])) exact[k] = distance(k, best[k]);
      if (!(t <= exact[k] + same_m)) return false;
      if (t > exact[k] || (t == exact[k] && rank(c) >= rank(best[k]))) {
        note_same(k, t, c);
        return false;
      }
      if (exact[k] <= t + same_m) note_same(k, exact[k], best[k]);
      forget_beyond(k, t + same_m);
    } else {
      same_count[k] = 0;
    }
    near[k] = seen, exact[k] = t, best[k] = c;
    return true;
  }

  /// Puts what counts in place of the nearest where several objects lie in one place; the number of another of them,
  /// kNoMaterial where there is none.
  std::uint32_t settle(std::size_t k) {
    std::uint32_t other = kNoMaterial;
    for (int j = 0; j < same_count[k]; ++j) {
      const Same& one = same[k][j];
      const std::uint32_t its = object(one.candidate), last = object(best[k]);
      if (its == last) continue;
      other = std::min(its, last);
      if (its > last) best[k] = one.candidate, exact[k] = one.exact;
    }
    return other;
  }
  std::uint32_t object(const Candidate& c) const { return static_cast<std::uint32_t>(rank(c) >> 32); }

  /// Whether the object that a candidate belongs to is there at the lane's time.
  bool is_there(std::size_t k, const Candidate& c) const {
    if (visits == nullptr) return true;
    const Presence* const presence = visits->of(object(c));
    return presence == nullptr || presence->at(time_s[k]);
  }

  bool within(std::size_t k, double t) const { return t > low[k] && t < high[k]; }
  /// Embree's distance says by itself that the hit lies between the ray's ends.
  bool clearly_within(std::size_t k, double seen) const {
    return seen > low[k] + window_m && seen < high[k] - window_m;
  }

 private:
  /// Where there are too many, the objects placed last stay.
  void note_same(std::size_t k, double t, const Candidate& c) {
    if (same_count[k] < kMostSame) {
      same[k][same_count[k]++] = {t, c};
      return;
    }
    Same* first = same[k];
    for (Same& s : same[k])
      if (rank(s.candidate) < rank(first->candidate)) first = &s;
    if (rank(first->candidate) < rank(c)) *first = {t, c};
  }
  void forget_beyond(std::size_t k, double t) {
    int kept = 0;
    for (int j = 0; j < same_count[k]; ++j)
      if (same[k][j].exact <= t) same[k][kept++] = same[k][j];
    same_count[k] = static_cast<std::uint8_t>(kept);
  }

  /// Only triangles of meshes come without their exact distance.
  double distance(std::size_t k, const Candidate& c) const {
    return facet_distance(k, *static_cast<const TriangleSet*>(c.set), c.instance, c.prim);
  }
};

/// The packet that a traversal of Embree's belongs to.
inline RayPacket& packet_of(RTCIntersectContext* context) { return *reinterpret_cast<RayPacket*>(context); }

}  // namespace ifov::geometry

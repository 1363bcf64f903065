// Lamps of documents, by night.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "honesty/wild_makers.h"

namespace ifov::benchmarks {

namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

std::string lamp(WildDraft& draft, double sky_radiance) {
  RandomStream& random = draft.random;
  const double radius = random.magnitude(0.005, 0.3), height = random.magnitude(0.7, 8.0) + radius;
  const double x = random.between(-7.0, 7.0), y = random.between(-7.0, 7.0);
  // On the ground below, 0.3 to 100 times what the sky makes there.
  const double radiance = sky_radiance * random.magnitude(0.3, 100.0) * (height / radius) * (height / radius);
  PlainHints::Source source{{draft.place(x, y, height), radius * draft.gsd_m}, radiance};
  const std::string where = format(R"("at": {}, "radius": {}, "radiance": "{} W m-2 sr-1 um-1")",
                                   draft.point(x, y, height), draft.length(radius), radiance);
  const double lean = random.with(0.5) ? 0.0 : random.between(0.0, 60.0) * kRadians,
               bearing = random.between(0.0, 2.0 * std::numbers::pi);
  source.towards = {std::sin(lean) * std::sin(bearing), std::sin(lean) * std::cos(bearing), -std::cos(lean)};
  const std::string towards =
      format(R"("towards": [{}, {}, {}])", source.towards.x, source.towards.y, source.towards.z);
  const double half_angle_deg = random.between(10.0, 80.0),
               edge_deg = random.one_of({0.0, 1.0, random.between(2.0, 40.0)});
  std::string document;
  switch (random.index(4)) {
    case 0: document = format(R"({{"sphere": {{{}}}}})", where); break;
    case 1: document = format(R"({{"point": {{{}}}}})", where); break;
    case 2:
      source.form = PlainHints::Source::Form::disk;
      document = format(R"({{"disk": {{{}, {}}}}})", where, towards);
      break;
    default:
      source.form = PlainHints::Source::Form::spot;
      source.half_angle_rad = half_angle_deg * kRadians, source.edge_rad = edge_deg * kRadians;
      document = format(R"({{"spot": {{{}, {}, "half_angle": "{} deg", "edge": "{} deg"}}}})", where, towards,
                        half_angle_deg, edge_deg);
  }
  draft.hints.sources.push_back(source);
  return document;
}

}  // namespace

void make_street(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  for (const char* what : {"house", "post", "slab"}) draft.surface(what);
  const double sky_radiance = random.magnitude(0.01, 10.0);
  std::string lamps;
  for (std::size_t left = 1 + random.index(4); left > 0; --left)
    lamps += (lamps.empty() ? "" : ", ") + lamp(draft, sky_radiance);
  draft.light = format(R"("light": {{"sky": {{"radiance": "{} W m-2 sr-1 um-1"}}, "sources": [{}]}})",
                       sky_radiance, lamps);
  draft.atmosphere.clear();
  draft.channels = R"({"name": "red", "top_hat": {"from": "0.63 um", "to": "0.68 um"}})";
  const auto clear = [&](double x, double y, double reach, double top) {
    return std::all_of(draft.hints.sources.begin(), draft.hints.sources.end(), [&](const auto& source) {
      const math::Vec3 way = source.ball.centre_m - draft.place(x, y, 0.0);
      const double safe = reach * draft.gsd_m + 2.0 * source.ball.radius_m;
      return way.z - source.ball.radius_m > top * draft.gsd_m * 1.01 || std::hypot(way.x, way.y) > safe;
    });
  };
  const auto stand = [&](double x, double y, double width, double length, double low, double high,
                         const char* what) {
    if (clear(x, y, 0.5 * std::hypot(width, length), high))
      draft.box({x - 0.5 * width, y - 0.5 * length, low}, {x + 0.5 * width, y + 0.5 * length, high}, what);
  };
  for (std::size_t left = random.index(3); left > 0; --left)
    stand(random.between(-8.0, 8.0), random.between(-8.0, 8.0), random.between(1.0, 6.0),
          random.between(1.0, 6.0), 0.0, random.between(0.3, 4.0), "house");
  for (std::size_t left = random.index(5); left > 0; --left) {
    const double side = random.magnitude(0.02, 0.5);
    stand(random.between(-8.0, 8.0), random.between(-8.0, 8.0), side, side, 0.0, random.between(0.5, 5.0),
          "post");
  }
  if (random.with(0.4)) {  // a beam in the air
    const double width = random.magnitude(0.03, 0.5), low = random.between(0.1, 1.5);
    const double y = random.between(-7.0, 7.0);
    stand(0.0, y, 2.0 * kReach_px, width, low, low + width, "slab");
  }
}

}  // namespace ifov::benchmarks

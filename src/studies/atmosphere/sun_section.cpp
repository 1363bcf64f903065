#include <algorithm>
#include <cmath>
#include <numbers>

#include "geodesy/sun_position.h"
#include "studies/atmosphere/atmosphere_results.h"

namespace ifov::studies {
namespace {

/// Positions by NREL's Solar Position Algorithm (Reda and Andreas 2004): the worked example of its report,
/// then as computed by pvlib 0.16.1, elevation without refraction.
struct Reference {
  const char* time;
  double latitude_deg, longitude_deg, height_m, elevation_deg, azimuth_deg;
};
constexpr Reference kReferences[] = {
    {"2003-10-17T12:30:30-07:00", 39.742476, -105.1786, 1830.14, 39.872046, 194.340241},
    {"1950-12-18T16:53:00Z", 44.110, -98.925, 900, 18.768489, 155.995399},
    {"1954-04-25T21:00:00Z", 51.397, 106.945, 1404, -5.854809, 60.196669},
    {"1958-10-09T08:16:00Z", -39.221, -19.773, 1514, 17.292391, 83.678799},
    {"1962-07-16T12:59:00Z", 46.826, 43.985, 2967, 37.634014, 261.454274},
    {"1966-06-07T20:09:00Z", 18.006, -164.181, 107, 50.826886, 75.795738},
    {"1970-02-15T23:27:00Z", 66.747, 46.521, 1542, -31.097865, 40.486346},
    {"1974-04-14T09:14:00Z", -78.113, -110.735, 2076, -19.796979, 150.858561},
    {"1978-11-06T17:22:00Z", -79.403, 118.817, 463, 6.262320, 157.419549},
    {"1982-07-08T23:52:00Z", 1.567, 124.974, 1919, 29.746563, 64.917692},
    {"1986-01-21T11:05:00Z", 6.583, 2.798, 2614, 60.237348, 153.192370},
    {"1990-09-11T15:35:00Z", -70.520, -40.453, 969, 14.387578, 345.442525},
    {"1994-03-05T09:48:00Z", -19.289, 172.349, 1770, -40.199675, 243.746599},
    {"1998-06-17T10:38:00Z", 28.232, -125.716, 1321, -29.085610, 35.512375},
    {"2002-05-07T01:24:00Z", -64.527, 168.418, 645, 8.367698, 350.049833},
    {"2006-01-19T00:18:00Z", 59.852, 58.397, 395, -32.349803, 74.415788},
    {"2010-11-24T11:56:00Z", 64.627, 25.099, 436, 2.201691, 205.572880},
    {"2014-07-06T18:55:00Z", 8.372, -115.001, 2652, 71.386821, 38.584075},
    {"2018-12-18T14:34:00Z", -19.794, -32.056, 718, 82.329016, 240.725482},
    {"2022-09-02T23:52:00Z", -5.163, 17.149, 966, -74.635300, 79.947005},
    {"2026-06-22T01:01:00Z", -20.450, -169.074, 369, 39.472035, 328.982332},
    {"2030-05-28T02:39:00Z", -11.485, 8.546, 2618, -42.179787, 71.371306},
    {"2034-09-10T01:35:00Z", 29.389, -52.051, 1557, -46.635348, 317.799729},
    {"2038-07-22T18:54:00Z", -55.830, 156.031, 16, -23.286450, 88.101764},
    {"2042-07-22T17:48:00Z", -58.118, -29.195, 2446, -0.929991, 308.737223},
    {"2046-12-01T20:37:00Z", 46.884, 4.681, 2178, -47.181146, 290.429644},
    {"2050-03-07T04:11:00Z", -21.900, -115.414, 1038, -29.383382, 250.194038}};

}  // namespace

AtmosphereSection sun_section(const AtmosphereOptions&) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  AtmosphereSection section;
  section.title = "The Sun";
  section.text = "Positions of the Sun (ERFA) against NREL's Solar Position Algorithm.";
  double example = 0.0, worst = 0.0;
  for (const Reference& reference : kReferences) {
    const geodesy::SunPosition sun =
        geodesy::sun_position(geodesy::parse_utc(reference.time), reference.latitude_deg * kDegree,
                              reference.longitude_deg * kDegree, reference.height_m);
    const double off =
        math::length(sun.direction_enu - geodesy::direction_enu(reference.azimuth_deg * kDegree,
                                                                reference.elevation_deg * kDegree)) /
        kDegree;
    if (&reference == kReferences) example = off;
    worst = std::max(worst, off);
  }
  section.figures.at_most("sun_example", example, 1e-4, "degrees",
                          "the report's worked example: angle between both");
  section.figures.at_most("sun_sweep", worst, 1e-4, "degrees",
                          "places and times from 1950 to 2050: largest angle");
  return section;
}

}  // namespace ifov::studies

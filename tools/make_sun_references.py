#!/usr/bin/env python3
"""Prints the rows of src/studies/atmosphere/sun_references.h for the times and places that stand there.

    pip install pvlib==0.16.1 pyerfa; apt install libswe2.0 swe-basic-data
    tools/make_sun_references.py src/studies/atmosphere/sun_references.h

Two computations that share nothing with ERFA's ephemeris but the time scales (UT1 = UTC): NREL's Solar
Position Algorithm by pvlib, and JPL's DE431 by the Swiss Ephemeris: its apparent place of date (IAU 2006
precession, IAU 2000B nutation) and sidereal time (IERS Conventions 2010), with the parallax of the place on
WGS 84 and, like SPA, without diurnal aberration. The worked example keeps the figures that its report prints.
"""
import ctypes
import datetime
import math
import re
import sys
import warnings

import erfa
import numpy
from pvlib import spa

SWISS = ctypes.CDLL("libswe.so.2.0")
SWISS.swe_sidtime0.restype = ctypes.c_double
SUN, ECLIPTIC_AND_NUTATION = 0, -1
BY_FILES, EQUATORIAL = 2, 2048


def swiss(tt, body, flags=BY_FILES):
    found, message = (ctypes.c_double * 6)(), ctypes.create_string_buffer(256)
    if not SWISS.swe_calc(ctypes.c_double(tt), body, flags, found, message) & BY_FILES and body == SUN:
        sys.exit(message.value.decode())
    return list(found)


def time_scales(text):
    """Seconds since 1970 in UTC, and UT1 (= UTC) and TT as two-part Julian dates."""
    utc = datetime.datetime.fromisoformat(text.replace("Z", "+00:00")).astimezone(datetime.timezone.utc)
    jd = erfa.dtf2d("UTC", utc.year, utc.month, utc.day, utc.hour, utc.minute, float(utc.second))
    return utc.timestamp(), erfa.utcut1(*jd, 0.0), erfa.taitt(*erfa.utctai(*jd))


def by_jpl(ut1, tt, latitude, longitude, height_m):
    tilt = swiss(sum(tt), ECLIPTIC_AND_NUTATION, 0)
    sidereal = 15.0 * SWISS.swe_sidtime0(ctypes.c_double(sum(ut1)), ctypes.c_double(tilt[0]),
                                         ctypes.c_double(tilt[2]))
    right_ascension, declination, distance_au = swiss(sum(tt), SUN, BY_FILES | EQUATORIAL)[:3]
    a, d, lat, local = numpy.radians([right_ascension, declination, latitude, sidereal + longitude])
    flat = 1 / 298.257223563
    e2 = flat * (2 - flat)
    normal = 6378137.0 / math.sqrt(1 - e2 * math.sin(lat)**2)
    place = numpy.array([(normal + height_m) * math.cos(lat) * math.cos(local),
                         (normal + height_m) * math.cos(lat) * math.sin(local),
                         (normal * (1 - e2) + height_m) * math.sin(lat)]) / erfa.DAU
    sun = distance_au * numpy.array([math.cos(d) * math.cos(a), math.cos(d) * math.sin(a), math.sin(d)]) - place
    east = sun @ [-math.sin(local), math.cos(local), 0]
    north = sun @ [-math.sin(lat) * math.cos(local), -math.sin(lat) * math.sin(local), math.cos(lat)]
    up = sun @ [math.cos(lat) * math.cos(local), math.cos(lat) * math.sin(local), math.sin(lat)]
    return math.degrees(math.atan2(up, math.hypot(east, north))), math.degrees(math.atan2(east, north)) % 360


def by_spa(seconds, ut1, tt, latitude, longitude, height_m):
    ahead_s = 86400 * ((tt[0] - ut1[0]) + (tt[1] - ut1[1]))
    found = spa.solar_position(numpy.array([seconds]), latitude, longitude, height_m, 1013.0, 10.0, ahead_s,
                               0.5667)
    return found[3][0], found[4][0]


def main(header):
    warnings.simplefilter("ignore")  # years without known leap seconds
    SWISS.swe_set_ephe_path(b"/usr/share/libswe/ephe")
    SWISS.swe_set_astro_models(b"0,0,0,4,0,0,0,3", 0)
    rows = re.findall(r'\{"([^"]+)",\s+([-\d.]+),\s+([-\d.]+),\s+([-\d.]+),\s+([-\d.]+),\s+([-\d.]+)',
                      open(header, encoding="utf-8").read())
    for number, (time, *place, elevation, azimuth) in enumerate(rows):
        seconds, ut1, tt = time_scales(time)
        numbers = [float(x) for x in place]
        if number > 0:
            elevation, azimuth = (f"{x:.6f}" for x in by_spa(seconds, ut1, tt, *numbers))
        jpl = ", ".join(f"{x:.6f}" for x in by_jpl(ut1, tt, *numbers))
        end = "};" if number + 1 == len(rows) else ","
        print(f'    {{"{time}", {", ".join(place)}, {elevation}, {azimuth}, {jpl}}}{end}')


if __name__ == "__main__":
    main(*sys.argv[1:])

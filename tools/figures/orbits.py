"""Figure of docs/theory/orbits.md: an orbit in TEME, the ground that passes below it, and the way from there to the scene."""

import numpy as np
from matplotlib.patches import Circle

from data import columns
from style import BLACK, BLUE, GREY, PAGE_WIDTH, PALE, RED, arrow, plt, save, sketch

EARTH_M = 6378137.0


def projection(azimuth_deg, elevation_deg, middle, unit):
    """From points about the Earth's centre to the sheet, seen from this direction, and how far they are before the centre."""
    a, e = np.radians(azimuth_deg), np.radians(elevation_deg)
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    towards = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    up = np.cross(towards, right)

    def place(point):
        point = np.asarray(point, dtype=float)
        return np.array(middle) + unit * np.array([point @ right, point @ up]), point @ towards

    return place


def draw_frames(ax):
    sketch(ax, 124, 126)
    ax.text(1, 118.5, "(a) TEME and ECEF", fontsize=9)
    rows = np.array(columns("orbit", "orbit"))
    minutes, r, v = rows[0], rows[4:7].T / EARTH_M, rows[7:10].T
    middle, radius = np.array([60.0, 58.0]), 34.0
    place = projection(36, 20, middle, radius)
    ax.add_patch(Circle(middle, radius, fc=PALE, ec=BLACK, lw=0.8, zorder=0))

    def curve(points, **how):
        """What the Earth hides is dotted."""
        flat, depth = zip(*[place(p) for p in points])
        flat, free = np.array(flat), np.array([d >= 0 or np.hypot(*(f - middle)) > radius for f, d in zip(flat, depth)])
        for shown, more in ((free, {}), (~free, {"lw": 0.7, "ls": ":"})):
            ax.plot(*np.where(shown, flat.T, np.nan), **{**how, **more})

    def on_equator(degrees, distance=1.0):
        return np.array([distance * np.cos(np.radians(degrees)), distance * np.sin(np.radians(degrees)), 0.0])

    a = np.linspace(-np.pi / 2, np.pi / 2, 61)
    curve([on_equator(d) for d in np.linspace(36 - 90, 36 + 90, 61)], color=GREY, lw=0.8)
    # The satellite on its way south.
    revolution = minutes <= 100.5
    now = int(np.argmax(revolution & (r[:, 2] < 0.72) & (v[:, 2] < 0) & ([place(p)[1] > 0.3 for p in r])))
    greenwich = np.degrees(np.arctan2(rows[11][now], rows[10][now])) % 360
    curve([on_equator(greenwich) * np.cos(t) + np.array([0, 0, np.sin(t)]) for t in a], color=BLUE, lw=0.8)
    curve(r[revolution], color=RED, lw=1.3)
    at = place(r[now])[0]
    arrow(ax, middle, at, RED, 1.1)
    ax.plot(*at, "s", color=RED, ms=5, zorder=6)
    on = place(r[now] + 0.5 * v[now] / np.linalg.norm(v[now]))[0]
    arrow(ax, at, on, RED, 1.1)
    ax.text(*(on + (2, -1)), "v", color=RED)
    ax.text(*((middle + at) / 2 + (-6, 3)), "r", color=RED)
    ax.plot(*middle, "o", color=BLACK, ms=2.5, zorder=6)
    # Axes.
    for degrees, colour in ((0.0, BLACK), (greenwich, BLUE)):
        arrow(ax, middle, place(on_equator(degrees, 1.95))[0], colour, 1.1)
    arrow(ax, middle, place((0, 0, 1.5))[0], BLACK, 1.1)
    ax.text(*(place((0, 0, 1.5))[0] + (2.5, -2)), "z: true pole")
    ax.text(*(place(on_equator(0, 1.95))[0] + (-17, -4)), "x of TEME:\nmean equinox", va="top", linespacing=1.2, fontsize=8)
    ax.text(*(place(on_equator(greenwich, 1.95))[0] + (15, -4)), "x of ECEF:\nGreenwich", va="top", ha="right", linespacing=1.2, fontsize=8, color=BLUE)
    arc = [place(on_equator(d, 1.22))[0] for d in np.linspace(0, greenwich, 40)]
    ax.plot(*zip(*arc[:-2]), color=BLUE, lw=0.9)
    arrow(ax, arc[-4], arc[-1], BLUE, 0.9)
    ax.text(*(arc[20] + (1, -6)), "θ", color=BLUE, ha="center")


def draw_tracks(ax):
    _, latitude, longitude = (np.array(c) for c in columns("orbit", "orbit")[:3])
    north = np.flatnonzero((latitude[:-1] < 0) & (latitude[1:] >= 0)) + 1
    revolutions, crossings = np.r_[0, north[:2], len(latitude)], []
    for k, (a, b) in enumerate(zip(revolutions[:-1], revolutions[1:])):
        x, y, colour, style = longitude[a:b], latitude[a:b], (RED, BLUE, BLACK)[k], ("-", "--", "-.")[k]
        breaks = np.flatnonzero(np.abs(np.diff(x)) > 180) + 1
        for u, w in zip(np.split(x, breaks), np.split(y, breaks)):
            ax.plot(u, w, color=colour, ls=style, lw=1.2)
        south = np.flatnonzero((y[:-1] >= 0) & (y[1:] < 0))[0]
        crossings.append(np.interp(0, y[[south + 1, south]], x[[south + 1, south]]))
        ax.plot(crossings[-1], 0, "o", color=colour, ms=3.5, zorder=5)
        ax.text(crossings[-1] + 4, 7, str(k + 1), color=colour, fontsize=8)
    ax.axhline(0, color=GREY, lw=0.6, zorder=0)
    ax.annotate(f"{crossings[0] - crossings[1]:.1f}°", (crossings[0] + 4, -24), (crossings[0] + 22, -24), fontsize=8, va="center")
    arrow(ax, (crossings[0] + 20, -24), (crossings[0], -24), BLACK, 0.7)
    arrow(ax, (crossings[1] - 20, -24), (crossings[1], -24), BLACK, 0.7)
    for x in crossings[:2]:
        ax.plot([x, x], [0, -29], color=GREY, lw=0.6, ls=":")
    ax.set_xlim(-180, 180)
    ax.set_ylim(-90, 90)
    ax.set_xticks(range(-180, 181, 90))
    ax.set_yticks(range(-90, 91, 45))
    ax.set_xlabel("longitude, °", labelpad=1)
    ax.set_ylabel("latitude, °", labelpad=-3)
    ax.set_title("(b) the ground below")


def draw_sight(ax):
    sketch(ax, 83, 126)
    ax.text(0, 118.5, "(c) the scene's frame", fontsize=9)
    centre, radius, sheet = np.array([38.0, -48.0]), 80.0, 6.0
    t = np.radians(np.linspace(60, 120, 60))
    rim = centre[:, None] + radius * np.array([np.cos(t), np.sin(t)])
    ax.fill(np.r_[rim[0], rim[0][-1], rim[0][0]], np.r_[rim[1], sheet, sheet], color=PALE, lw=0, zorder=0)
    ax.plot(*rim, color=BLACK, lw=0.9)
    ax.text(55, 9, "ellipsoid", fontsize=8)

    def at(degrees, distance):
        return centre + distance * np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])

    origin, satellite = at(81, radius), at(101, radius + 70)
    up = (origin - centre) / radius
    level = np.array([up[1], -up[0]])
    ax.plot(*zip(origin - 23 * level, origin + 23 * level), color=BLACK, lw=2.0, solid_capstyle="butt")
    ax.text(*(origin + 10 * level + (0, 4)), "scene", fontsize=8)
    arrow(ax, origin, origin + 27 * up, BLACK, 1.1)
    ax.text(*(origin + 27 * up + (1.5, -2)), "up")
    for tip, name, shift, colour in ((satellite, "r_{ECEF}", (-3, 5), RED), (origin, "r_{0}", (-4, 0), BLUE)):
        start = centre + (tip - centre) * ((sheet - centre[1]) / (tip - centre)[1])
        arrow(ax, start, tip, colour, 1.1)
        ax.text(*(start + 0.3 * (tip - start) + shift), name, color=colour, ha="right")
    arrow(ax, origin, satellite, BLACK, 1.0, ls="--")
    ax.text(*((origin + satellite) / 2 + (2, 2)), "P")
    seen = origin - 14 * level
    arrow(ax, satellite, seen, BLUE, 1.5)
    ax.text(*(satellite + 0.62 * (seen - satellite) + (-2.5, 0)), "d", color=BLUE, ha="right", va="center")
    ax.plot(*satellite, "s", color=RED, ms=6, zorder=6)
    ax.text(*(satellite + (4, 0)), "satellite", color=RED, fontsize=8, va="center")


def draw():
    fig = plt.figure(figsize=(PAGE_WIDTH, 2.9))
    draw_frames(fig.add_axes((0.0, 0.0, 0.397, 1.0)))
    draw_tracks(fig.add_axes((0.455, 0.165, 0.265, 0.75)))
    draw_sight(fig.add_axes((0.735, 0.0, 0.265, 1.0)))
    save(fig, "theory", "orbits", __file__)


if __name__ == "__main__":
    draw()

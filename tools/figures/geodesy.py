"""Figure of docs/theory/geodesy.md: geodetic coordinates, the frames ECEF and ENU, and the attitude of a body."""

import numpy as np
from matplotlib.patches import Circle, Polygon

from style import BLACK, BLUE, GREY, PAGE_WIDTH, PALE, RED, angle_arc, arrow, plt, save, sketch


def draw_meridian(ax):
    """A section of the ellipsoid, flattened far more than it is."""
    sketch(ax, 92, 116)
    ax.text(1, 109, "(a) a meridian's plane", fontsize=9)
    centre, a, b = np.array([13.0, 36.0]), 62.0, 50.0
    e2 = 1 - (b / a) ** 2
    t = np.linspace(0, np.pi / 2, 60)
    rim = centre[:, None] + np.array([a * np.cos(t), b * np.sin(t)])
    ax.fill(np.r_[rim[0], centre[0]], np.r_[rim[1], centre[1]], color=PALE, lw=0, zorder=0)
    ax.plot(*rim, color=BLACK, lw=1.1)
    arrow(ax, centre, centre + (76, 0), BLACK, 0.9)
    arrow(ax, centre, centre + (0, 66), BLACK, 0.9)
    ax.text(*(centre + (-2, 63)), "z", ha="right")
    ax.text(*(centre + (-2, b)), "a √(1 − e²)", rotation=90, ha="right", va="top", fontsize=8)
    # The foot, and the normal through it from the axis on.
    phi = np.radians(42)
    normal = np.array([np.cos(phi), np.sin(phi)])
    n = a / np.sqrt(1 - e2 * np.sin(phi) ** 2)
    foot = centre + np.array([n * np.cos(phi), n * (1 - e2) * np.sin(phi)])
    on_axis, on_equator = foot - n * normal, foot - n * (1 - e2) * normal
    ax.plot(*zip(centre, (centre[0], on_axis[1] - 3)), color=BLACK, lw=0.9)
    ax.plot(*zip(on_axis, foot), color=BLUE, lw=1.1)
    height = 20.0
    point = foot + height * normal
    ax.plot(*zip(foot, point), color=RED, lw=1.6)
    ax.plot(*point, "o", color=RED, ms=4.5)
    ax.plot(*foot, "o", color=BLACK, ms=3)
    ax.text(*(foot + 0.45 * height * normal + (3, -4)), "h", color=RED)
    angle_arc(ax, tuple(on_equator), 13, 0, 42, "φ", colour=BLUE, text_radius=18)
    aside = np.array([-normal[1], normal[0]])
    for start, end, away, text in ((on_axis, foot, 11.5, "N"), (on_equator, foot, 4.0, "N (1 − e²)")):
        u, v = start + away * aside, end + away * aside
        ax.annotate("", v, u, arrowprops={"arrowstyle": "<|-|>", "color": BLUE, "lw": 0.7, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 6})
        for end, over in ((start, u), (foot, v)):
            ax.plot(*zip(end, over + 1.2 * aside), color=GREY, lw=0.6, ls=":")
        ax.text(*((u + v) / 2 + 3.4 * aside), text, color=BLUE, fontsize=8, ha="center", va="center", rotation=42,
                rotation_mode="anchor")
    ax.annotate("", centre + (a, -24), centre + (0, -24), arrowprops={"arrowstyle": "<|-|>", "color": BLACK, "lw": 0.7, "shrinkA": 0, "shrinkB": 0,
                                                                    "mutation_scale": 6})
    for x in (0, a):
        ax.plot([centre[0] + x] * 2, [centre[1], centre[1] - 26], color=GREY, lw=0.6, ls=":")
    ax.text(*(centre + (a / 2, -31)), "a", ha="center")
    ax.text(*(centre + (77, -6)), "equator", fontsize=8, ha="right", va="center")


def draw_globe(ax):
    sketch(ax, 95, 116)
    ax.text(1, 109, "(b) ECEF and ENU", fontsize=9)
    middle, radius = np.array([44.0, 53.0]), 34.0
    azimuth, elevation = np.radians(46), np.radians(20)
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0])
    towards = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
    above = np.cross(towards, right)

    def place(*p):
        return middle + radius * np.array([np.dot(p, right), np.dot(p, above)])

    def front(points):
        points = [p for p in points if np.dot(p, towards) >= -1e-9]
        return zip(*[place(*p) for p in points])

    ax.add_patch(Circle(middle, radius, fc=PALE, ec=BLACK, lw=0.8, zorder=0))
    phi, lam = np.radians(38), np.radians(80)
    turn = np.linspace(azimuth - np.pi / 2, azimuth + np.pi / 2, 81)
    ax.plot(*front([(np.cos(t), np.sin(t), 0) for t in turn]), color=GREY, lw=0.8)
    tilt = np.linspace(-np.pi / 2, np.pi / 2, 81)
    for longitude, colour in ((0.0, GREY), (lam, BLUE)):
        ax.plot(*front([(np.cos(t) * np.cos(longitude), np.cos(t) * np.sin(longitude), np.sin(t)) for t in tilt]), color=colour, lw=0.8)
    for axis, name, shift in (((1.6, 0, 0), "x", (-5, -3)), ((0, 1.6, 0), "y", (2, -2)), ((0, 0, 1.5), "z", (-6, -3))):
        arrow(ax, middle, place(*axis), BLACK, 1.1)
        ax.text(*(place(*axis) + shift), name)
    on = place(np.cos(-0.75), 0, np.sin(-0.75))
    ax.annotate("meridian of\nGreenwich", on, (2, 18), fontsize=7.6, va="center", linespacing=1.2,
                arrowprops={"arrowstyle": "-", "color": GREY, "lw": 0.7, "shrinkA": 1, "shrinkB": 0})
    at = np.array([np.cos(phi) * np.cos(lam), np.cos(phi) * np.sin(lam), np.sin(phi)])
    foot = np.array([np.cos(lam), np.sin(lam), 0])
    ax.plot(*zip(middle, place(*at)), color=BLUE, lw=0.9, ls="--")
    ax.plot(*zip(middle, place(*foot)), color=BLUE, lw=0.9, ls="--")
    arc = [place(0.5 * np.cos(t), 0.5 * np.sin(t), 0) for t in np.linspace(0, lam, 30)]
    ax.plot(*zip(*arc[:-1]), color=BLUE, lw=0.9)
    arrow(ax, arc[-3], arc[-1], BLUE, 0.9)
    ax.text(*(arc[14] + (0, -5.5)), "λ", color=BLUE, ha="center")
    arc = [place(*(0.62 * (np.cos(t) * foot + np.sin(t) * np.array([0, 0, 1])))) for t in np.linspace(0, phi, 20)]
    ax.plot(*zip(*arc), color=BLUE, lw=0.9)
    ax.text(*(arc[10] + (3, -1.5)), "φ", color=BLUE)
    east = np.array([-np.sin(lam), np.cos(lam), 0])
    north = np.array([-np.sin(phi) * np.cos(lam), -np.sin(phi) * np.sin(lam), np.cos(phi)])
    size = 0.55
    corners = [place(*(at + 0.17 * (i * east + j * north))) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    ax.add_patch(Polygon(corners, fc="white", ec=RED, lw=0.8, zorder=3))
    for axis, name, shift in ((east, "east", (1.5, -1)), (north, "north", (-1, 2)), (1.3 * at, "up", (1.5, 0))):
        tip = place(*(at + size * axis))
        ax.annotate("", tip, place(*at), zorder=5, arrowprops={"arrowstyle": "-|>", "color": RED, "lw": 1.3, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 8})
        ax.text(*(tip + shift), name, color=RED, fontsize=8)


def turned(shape, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.asarray(shape) @ np.array([[c, s], [-s, c]])


def mirrored(half):
    """The outline of which half, from the nose to the tail, is given: x forward, y to one side."""
    return [*half, *[(x, -y) for x, y in half[::-1]]]


ABOVE = mirrored([(13, 0), (11.5, 1.3), (4, 1.6), (-1, 14), (-4, 14), (-2.4, 1.6), (-9, 1.1), (-11.5, 5), (-13, 5), (-12.4, 0.6)])
SIDE = [(13, -0.6), (11.4, 1.0), (7, 2.0), (-8, 2.0), (-11.4, 7.2), (-13.2, 7.2), (-12, 0.6), (-5, -1.9), (10, -1.9)]


def draw_body(ax):
    sketch(ax, 83, 116)
    ax.text(0, 109, "(c) body and attitude", fontsize=9)

    def view(centre, outline, tilt, first, second, into):
        """Axes of the body: first and second (name, degrees), and the third, which points in or out of the sheet."""
        centre = np.array(centre)
        if outline is None:
            for end, thick in (((-14, 0), 2.4), ((14, 0), 2.4), ((0, 7), 1.8)):
                ax.plot(*zip(centre, centre + turned([end], tilt)[0]), color="#b8c4d2", lw=thick, zorder=1)
            ax.add_patch(Circle(centre, 3.0, fc=PALE, ec=GREY, lw=0.7, zorder=2))
        else:
            ax.add_patch(Polygon(turned(outline, tilt) + centre, fc=PALE, ec=GREY, lw=0.7, zorder=1))
        for name, degrees, length in (first, second):
            direction = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
            arrow(ax, centre, centre + length * direction, RED, 1.2)
            ax.text(*(centre + (length + 3.2) * direction), name, color=RED, ha="center", va="center")
        ax.add_patch(Circle(centre, 1.7, fc="white", ec=RED, lw=0.9, zorder=5))
        if into:
            ax.plot(centre[0], centre[1], "x", color=RED, ms=3.2, mew=0.9, zorder=6)
        else:
            ax.plot(centre[0], centre[1], "o", color=RED, ms=1.8, zorder=6)

    def said(x, y, text):
        ax.text(x, y, text, fontsize=8, linespacing=1.25, va="center")

    top, side, behind = (22.0, 85.0), (22.0, 50.0), (22.0, 17.0)
    view(top, ABOVE, 55, ("x", 55, 21), ("y", -35, 18), True)
    arrow(ax, top, (top[0], top[1] + 20), BLACK, 0.9)
    ax.text(top[0] - 2, top[1] + 16, "N", ha="right", fontsize=8)
    angle_arc(ax, top, 14, 55, 90, "ψ", text_radius=17.3)
    said(47, top[1], "from above,\nz away")
    for at, outline, degrees, first, second, into, name, text in (
            (side, SIDE, 18, ("x", 18, 21), ("z", -72, 14), False, "θ", "from its right,\ny to the reader"),
            (behind, None, -18, ("y", -18, 21), ("z", -108, 13), True, "φ", "from behind,\nx away")):
        view(at, outline, degrees, first, second, into)
        ax.plot([at[0], at[0] + 22], [at[1], at[1]], color=BLACK, lw=0.8, ls=":")
        angle_arc(ax, at, 16.5, min(0, degrees), max(0, degrees), name, text_radius=20)
        said(47, at[1] - (3 if degrees > 0 else 0) + (4 if degrees < 0 else 0), text)


def draw():
    fig = plt.figure(figsize=(PAGE_WIDTH, 3.09))
    draw_meridian(fig.add_axes((0.0, 0.0, 0.34, 1.0)))
    draw_globe(fig.add_axes((0.34, 0.0, 0.352, 1.0)))
    draw_body(fig.add_axes((0.693, 0.0, 0.307, 1.0)))
    save(fig, "theory", "geodesy", __file__)


if __name__ == "__main__":
    draw()

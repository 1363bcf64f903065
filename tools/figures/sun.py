"""Figure of docs/theory/sun.md: azimuth and elevation, the Sun's way over a day, moonlight by phase."""

import numpy as np

from data import columns
from style import BLACK, BLUE, GREY, PAGE_WIDTH, PALE, RED, arrow, plt, save, sketch


def draw_angles(ax):
    sketch(ax, 100, 100)
    ax.text(3, 92, "(a) east, north, up", fontsize=9)
    origin = np.array([42.0, 36.0])

    def place(east, north, up):
        return origin + np.array([0.92 * east + 0.42 * north, 0.42 * north - 0.08 * east + up])

    circle = [place(36 * np.cos(a), 36 * np.sin(a), 0) for a in np.linspace(0, 2 * np.pi, 80)]
    ax.fill(*zip(*circle), color=PALE, zorder=0)
    for tip, name, shift in (((50, 0, 0), "east", (-1, -8)), ((0, 50, 0), "north", (3, -1)), ((0, 0, 46), "up", (-11, -4))):
        arrow(ax, origin, place(*tip))
        ax.text(*(place(*tip) + shift), name)
    azimuth, elevation = np.radians(130), np.radians(52)

    def sky(a, e, r):
        return place(r * np.cos(e) * np.sin(a), r * np.cos(e) * np.cos(a), r * np.sin(e))

    tip, foot = sky(azimuth, elevation, 50), sky(azimuth, 0, 50 * np.cos(elevation))
    arrow(ax, origin, tip, RED, 1.5)
    ax.plot(*tip, "o", color=RED, ms=7)
    ax.text(*(tip + (4, 2)), "Sun", color=RED)
    ax.plot(*zip(origin, foot), color=RED, ls="--", lw=0.9)
    ax.plot(*zip(tip, foot), color=GREY, ls=":", lw=0.8)
    arc = [sky(a, 0, 20) for a in np.linspace(0, azimuth, 30)]
    ax.plot(*zip(*arc), color=BLACK, lw=0.9)
    arrow(ax, arc[-3], arc[-1], BLACK, 0.9)
    ax.text(*(arc[13] + (2, 3)), "azimuth", fontsize=8)
    arc = [sky(azimuth, e, 25) for e in np.linspace(0, elevation, 15)]
    ax.plot(*zip(*arc), color=RED, lw=0.9)
    ax.text(*(arc[3] + (4, -5)), "elevation", fontsize=8, color=RED)


def draw():
    fig = plt.figure(figsize=(PAGE_WIDTH, 2.65))
    draw_angles(fig.add_axes((0.0, 0.0, 0.34, 1.0)))
    ax = fig.add_axes((0.405, 0.175, 0.30, 0.71))
    for day, style, colour in (("2026-06-21", "-", RED), ("2026-03-20", "--", BLACK), ("2026-12-21", "-.", BLUE)):
        hour, azimuth, elevation = (np.array(c) for c in columns("sun", "sun", day))
        order = np.argsort(azimuth)
        ax.plot(azimuth[order], elevation[order], ls=style, color=colour, label=day)
        for h in range(0, 24, 3):
            k = list(hour).index(float(h))
            if elevation[k] > 2:
                ax.plot(azimuth[k], elevation[k], "o", ms=2.5, color=colour)
                if day == "2026-06-21":
                    ax.text(azimuth[k] + (-7 if azimuth[k] < 170 else 7), elevation[k] + 1.5, f"{h} h", fontsize=7.2,
                            ha="right" if azimuth[k] < 170 else "left", color=colour)
    ax.set_xlim(40, 320)
    ax.set_ylim(0, 90)
    ax.set_xticks([90, 180, 270])
    ax.set_xlabel("azimuth, °")
    ax.set_ylabel("elevation, °", labelpad=1)
    ax.set_title("(b) 48.2° N 16.4° E, UTC")
    ax.legend(loc="upper right", fontsize=7, handlelength=2.2, borderaxespad=0, labelspacing=0.2)
    ax = fig.add_axes((0.80, 0.175, 0.185, 0.71))
    g, ratio = columns("sun", "moon")
    ax.semilogy(g, ratio, color=BLACK)
    ax.set_xlim(0, 150)
    ax.set_ylim(1e-9, 5e-6)
    ax.set_xticks([0, 45, 90, 135])
    ax.set_xlabel("phase angle g, °")
    ax.set_ylabel("moonlight / sunlight", labelpad=1)
    ax.set_title("(c) the Moon")
    save(fig, "theory", "sun", __file__)


if __name__ == "__main__":
    draw()

"""Figure of docs/theory/image_sampling.md: the two levels of a value, the points of a pixel, and what like pixels tell."""

import numpy as np
from matplotlib.patches import Circle, Polygon, Rectangle

from data import columns
from style import BLACK, BLUE, GREY, PAGE_WIDTH, PALE, RED, arrow, plt, save, sketch


def draw_levels(ax):
    sketch(ax, 102, 96)
    ax.text(1, 83.5, "(a) f = D + I", fontsize=9)
    ground = 12.0
    ax.fill_between([0, 102], 0, ground, color=PALE, lw=0)
    wall = [(84, ground), (84, 50), (96, 50), (96, ground)]
    ax.add_patch(Polygon(wall, fc=PALE, ec=BLACK, lw=0.8))
    ax.plot([0, 84], [ground, ground], color=BLACK, lw=0.8)
    sun = np.array([12.0, 66.0])
    ax.add_patch(Circle(sun, 5.5, fc="#f4c542", ec=BLACK, lw=0.7))
    # Footprint of a pixel: one ray whose path ends, one whose path is followed.
    ax.plot([39, 61], [75, 75], color=BLACK, lw=3, solid_capstyle="butt")
    ax.text(63, 73, "pixel", fontsize=8)
    for start, hit, followed in (((44, 75), np.array([36.0, ground]), False), ((53, 75), np.array([58.0, ground]), True)):
        arrow(ax, start, hit + (0, 0.4), BLACK, 1.1)
        towards = (sun - hit) / np.hypot(*(sun - hit))
        arrow(ax, hit, sun - 6 * towards, RED, 1.0, ls="--")
        ax.plot(*hit, "o", color=BLUE, ms=5, mfc=BLUE if followed else "white", zorder=6)
    at = np.array([58.0, ground])
    second = np.array([84.0, 33.0])
    arrow(ax, at, second, BLUE, 1.5)
    away = np.array([70.0, 62.0])
    arrow(ax, second, away, BLUE, 1.5)
    towards = (sun - second) / np.hypot(*(sun - second))
    arrow(ax, second, sun - 6 * towards, BLUE, 1.0, ls="--")
    ax.plot(*second, "o", color=BLUE, ms=3, zorder=6)
    ax.text(72, 62, "sky", color=BLUE, fontsize=8)
    ax.text(20, 33, "D", color=RED, fontsize=10)
    ax.text(76, 20, "I", color=BLUE, fontsize=10)


def grid(ax, lines, low, high, width):
    across = [v for line in lines for v in (line, line, np.nan)]
    along = [low, high, np.nan] * len(lines)
    ax.plot(across, along, color=GREY, lw=width, zorder=2)
    ax.plot(along, across, color=GREY, lw=width, zorder=2)


def draw_points(ax):
    ax.set_title("(b) points of a pixel")
    whole, x, y = (np.array(c) for c in columns("image", "point"))
    for lines, width in ((np.arange(9) / 8, 0.4), (np.arange(5) / 4, 0.8)):
        grid(ax, lines, 0, 1, width)
    rest = whole == 0
    ax.plot(x[rest], y[rest], "o", color=BLUE, ms=3.4, mfc="white", mew=0.8)
    ax.plot(x[~rest], y[~rest], "o", color=BLUE, ms=4.2)
    # One in each thin column and row.
    nothing = np.full_like(x, np.nan)
    ends = [np.full_like(x, e) for e in (1.03, 1.07, -0.03, -0.07)]
    ax.plot(np.c_[x, x, nothing].ravel(), np.c_[ends[0], ends[1], nothing].ravel(), color=BLACK, lw=0.5)
    ax.plot(np.c_[ends[2], ends[3], nothing].ravel(), np.c_[y, y, nothing].ravel(), color=BLACK, lw=0.5)
    ax.set_xlim(-0.09, 1.01)
    ax.set_ylim(1.09, -0.01)
    ax.set_aspect("equal")
    ax.axis("off")


def draw_pooling(ax, pixel, title):
    ax.set_title(title)
    i, j, _, share = (np.array(c) for c in columns("image", "pooled", str(pixel)))
    grid(ax, np.arange(9), 0, 8, 0.3)
    weight = share / (1 - share.sum())  # of k / (1 + sum of k)
    for x, y, k in zip(i, j, weight):
        if y * 8 + x == pixel:
            ax.add_patch(Rectangle((x, y), 1, 1, fc="white", ec=RED, lw=1.4, zorder=4))
            ax.text(x + 0.5, y + 0.5, "p", fontsize=7.5, ha="center", va="center", color=RED, zorder=5)
        elif k >= 0.005:
            ax.add_patch(Rectangle((x, y), 1, 1, fc=f"{1 - 0.45 * k:.2f}", lw=0))
            ax.text(x + 0.5, y + 0.5, f"{100 * k:.0f}", fontsize=5.6, ha="center", va="center")
    ax.plot([5.6, 5.6 - 0.45 * 8], [0, 8], color=RED, lw=1.1, ls="--", zorder=3)
    ax.set_xlim(-0.1, 8.1)
    ax.set_ylim(8.1, -0.1)
    ax.set_aspect("equal")
    ax.axis("off")


def draw():
    fig = plt.figure(figsize=(PAGE_WIDTH, 2.1))
    draw_levels(fig.add_axes((0.0, 0.0, 0.31, 1.0)))
    for k, draw_one in enumerate((draw_points, lambda ax: draw_pooling(ax, 18, "(c) 100 k_{pq}"), lambda ax: draw_pooling(ax, 35, "(d) at the border"))):
        draw_one(fig.add_axes((0.325 + 0.229 * k, 0.04, 0.215, 0.84)))
    save(fig, "theory", "image_sampling", __file__)


if __name__ == "__main__":
    draw()

"""Figures of docs/theory/sampling.md and random_placement.md: the Sun's disc in projected solid angle, a sequence, places at random."""

import numpy as np

from data import columns
from style import BLACK, BLUE, GREY, PAGE_WIDTH, PALE, RED, arrow, dots, plt, save, sketch


def draw_disc(ax):
    """Seen level, in the plane of normal and Sun; the ellipse beneath it seen from above."""
    sketch(ax, 110, 120)
    ax.text(3, 113, "(a) the Sun's disc, projected", fontsize=9)
    radius, centre, theta, alpha = 46.0, np.array([52.0, 60.0]), np.radians(48), np.radians(13)
    a = np.linspace(0, np.pi, 90)
    ax.plot(centre[0] + radius * np.cos(a), centre[1] + radius * np.sin(a), color=GREY, lw=0.9)
    ax.plot([centre[0] - radius - 3, centre[0] + radius + 3], [centre[1]] * 2, color=BLACK, lw=1.2)
    arrow(ax, centre, centre + (0, radius + 4))
    ax.text(centre[0] - 5, centre[1] + radius + 1, "n")

    def at(t):
        return centre + radius * np.array([np.sin(t), np.cos(t)])

    arrow(ax, centre, at(theta), RED, 1.3)
    ax.text(*(at(theta) + (2.5, 1)), "s", color=RED)
    t = np.linspace(theta - alpha, theta + alpha, 30)
    ax.plot(*zip(*[at(v) for v in t]), color=RED, lw=3.0)
    for v in (theta - alpha, theta + alpha):
        ax.plot(*zip(centre, at(v)), color=RED, lw=0.7, ls="--")
    t = np.linspace(0, theta, 20)
    ax.plot(*zip(*[centre + 15 * np.array([np.sin(v), np.cos(v)]) for v in t]), color=BLACK, lw=0.8)
    ax.text(*(centre + (6.5, 18)), "θₛ")
    t = np.linspace(theta, theta + alpha, 8)
    ax.plot(*zip(*[centre + 30 * np.array([np.sin(v), np.cos(v)]) for v in t]), color=RED, lw=0.8)
    ax.text(*(centre + 36 * np.array([np.sin(theta + alpha / 2), np.cos(theta + alpha / 2)])), "α", color=RED, ha="center", va="center")
    # The unit disk on the surface's plane, seen from above; the same scale.
    low = centre + (0, -38)
    shrink = 0.38
    ax.plot(low[0] + radius * np.cos(2 * a), low[1] + shrink * radius * np.sin(2 * a), color=GREY, lw=0.9)
    along, across, mid = np.sin(alpha) * np.cos(theta) * radius, np.sin(alpha) * radius, np.sin(theta) * np.cos(alpha) * radius
    ax.fill(low[0] + mid + along * np.cos(2 * a), low[1] + shrink * across * np.sin(2 * a), color=RED, alpha=0.35, lw=0)
    ax.plot(low[0] + mid + along * np.cos(2 * a), low[1] + shrink * across * np.sin(2 * a), color=RED, lw=1.1)
    for v in (theta - alpha, theta + alpha):
        ax.plot([at(v)[0]] * 2, [at(v)[1], low[1]], color=GREY, lw=0.7, ls=":")
    ax.plot(*low, "+", color=BLACK, ms=6)
    ax.text(low[0] - 4, low[1] - 12, "unit disk, from above", fontsize=7.5, ha="center")
    arrow(ax, low, low + (mid, 0), RED, 0.9)
    ax.text(low[0] + mid / 2 - 1, low[1] + 3, "s∥ cos α", fontsize=7.8, ha="center", color=RED)


def draw_sequence(ax):
    index, x, y = columns("sequence", "point")
    for k in range(1, 8):
        ax.axvline(k / 8, color="#cccccc", lw=0.5)
        ax.axhline(k / 8, color="#cccccc", lw=0.5)
    first = [i for i, k in enumerate(index) if k < 16]
    ax.plot([x[i] for i in range(len(x)) if i not in first], [y[i] for i in range(len(x)) if i not in first], "o", ms=2.8, color=BLUE, mew=0)
    ax.plot([x[i] for i in first], [y[i] for i in first], "s", ms=3.6, color=RED, mfc="white", mew=1, clip_on=False)
    ax.set_xlim(0, 1)
    ax.set_ylim(0, 1)
    ax.set_aspect("equal")
    ax.set_xticks([0, 0.5, 1], ["0", "½", "1"])
    ax.set_yticks([0, 0.5, 1], ["0", "½", "1"])
    ax.set_xlabel("x")
    ax.set_ylabel("y", labelpad=3)
    ax.set_title("(b) 64 elements of a sequence")


def draw_variance(ax):
    """Means over a disc of the unit square: RMS errors of independent points, a jittered grid, and this is what strata buy."""
    rng = np.random.default_rng(5)
    sizes = [1 << k for k in range(2, 11)]
    def inside(p):
        return (np.hypot(p[..., 0] - 0.43, p[..., 1] - 0.51) < 0.37).mean(axis=-1)
    truth = np.pi * 0.37**2
    independent = [np.sqrt(truth * (1 - truth) / n) for n in sizes]
    grids = [2, 3, 4, 6, 8, 11, 16, 23, 32]
    jittered = []
    for m in grids:
        i, j = np.meshgrid(np.arange(m), np.arange(m))
        cells = np.stack([i.ravel(), j.ravel()], axis=-1)
        p = (cells + rng.random((600, m * m, 2))) / m
        jittered.append(np.sqrt(np.mean((inside(p) - truth) ** 2)))
    ax.loglog(sizes, independent, color=BLACK, ls="--", label="independent: slope −½")
    ax.loglog([m * m for m in grids], jittered, color=BLUE, marker="o", ms=3, label="jittered grid: slope −¾")
    ax.set_ylim(6e-4, 0.4)
    ax.set_xticks([10, 100, 1000], ["10", "100", "1000"])
    ax.set_yticks([0.001, 0.01, 0.1], ["0.001", "0.01", "0.1"])
    ax.set_xlabel("points n")
    ax.set_ylabel("RMS error of an area", labelpad=1)
    ax.set_title("(c) why strata")
    ax.legend(fontsize=7.4, loc="lower left", borderaxespad=0.1)


def draw_sampling():
    fig = plt.figure(figsize=(PAGE_WIDTH, 2.7))
    draw_disc(fig.add_axes((0.0, 0.0, 0.345, 1.0)))
    draw_sequence(fig.add_axes((0.40, 0.17, 0.25, 0.72)))
    draw_variance(fig.add_axes((0.75, 0.17, 0.235, 0.72)))
    save(fig, "theory", "sampling", __file__)


def draw_scatter():
    fig, axes = plt.subplots(1, 2, figsize=(PAGE_WIDTH, 3.0), gridspec_kw={"width_ratios": [1, 1.25]})
    fig.subplots_adjust(left=0.06, right=0.985, top=0.91, bottom=0.15, wspace=0.22)
    x, y = columns("scatter", "place")
    axes[0].set_xlim(0, 12)
    axes[0].set_ylim(0, 12)
    axes[0].set_aspect("equal")
    fig.canvas.draw()  # places the axes
    inside = [place for place in zip(x, y) if 0.5 <= min(place) and max(place) <= 11.5]
    diameter = 72 / fig.dpi * axes[0].get_window_extent().width / 12
    dots(axes[0], inside, round(diameter, 2), BLUE)
    dots(axes[0], inside, round(diameter - 1.2, 2), PALE)
    dots(axes[0], inside, 1.4, BLUE)
    axes[0].set_xlabel("x, d")
    axes[0].set_ylabel("y, d", labelpad=1)
    axes[0].set_title("(a) disks of diameter d, D = 0.627/d²")
    n, c = columns("scatter", "formula")
    axes[1].semilogx(n[1:], c[1:], color=BLACK, label="Schaaf and Talbot")
    n, c = columns("scatter", "measured")
    axes[1].plot(n, c, "o", ms=4, color=RED, mfc="white", label="of the program")
    axes[1].axhline(0.547, color=GREY, lw=0.9, ls="--")
    axes[1].text(0.011, 0.553, "jammed, 0.547", va="bottom", fontsize=8, color="#555555")
    n = np.geomspace(0.01, 20, 100)
    axes[1].plot(n, (1 - np.exp(-4 * n)) / 4, color=BLUE, ls=":", label="Matérn's second process")
    axes[1].set_xlim(0.01, 20)
    axes[1].set_ylim(0, 0.62)
    axes[1].set_xticks([0.01, 0.1, 1, 10], ["0.01", "0.1", "1", "10"])
    axes[1].set_xlabel("proposals N π d²/4")
    axes[1].set_ylabel("coverage c = D π d²/4")
    axes[1].set_title("(b) coverage by number of proposals")
    axes[1].legend(loc="upper left", bbox_to_anchor=(0.0, 0.86))
    save(fig, "theory", "scatter", __file__)


if __name__ == "__main__":
    draw_sampling()
    draw_scatter()

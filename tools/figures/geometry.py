"""Figure of docs/theory/geometry.md: a ray through a height field, from above and along its way."""

import numpy as np

from style import BLACK, GREY, PAGE_WIDTH, PALE, RED, plt, save

HEIGHTS = np.array([  # metres, at the corners [row, column]
    [1.0, 1.4, 1.2, 0.9, 1.3, 2.0, 2.6, 2.2],
    [0.8, 1.1, 0.9, 1.0, 1.5, 2.4, 3.1, 2.8],
    [0.9, 0.7, 0.8, 1.2, 1.6, 2.7, 3.5, 3.0],
    [1.1, 0.9, 1.0, 1.1, 1.9, 2.5, 3.0, 2.7],
    [1.3, 1.0, 0.8, 0.9, 1.4, 1.9, 2.3, 2.5],
])
START, END = np.array([0.0, 0.7, 4.1]), np.array([7.0, 3.4, 0.6])


def diagonal_falls(i, j):
    """Whether the diagonal of cell (i, j) runs from its upper left to its lower right corner of the drawing: between the
    corners with both coordinates even or both odd."""
    return (i + j) % 2 == 0


def height(x, y):
    """Of the triangle that holds the place."""
    i, j = min(int(x), HEIGHTS.shape[1] - 2), min(int(y), HEIGHTS.shape[0] - 2)
    u, v = x - i, y - j
    a, b, c, d = HEIGHTS[j, i], HEIGHTS[j, i + 1], HEIGHTS[j + 1, i], HEIGHTS[j + 1, i + 1]
    if diagonal_falls(i, j):
        return a + u * (b - a) + v * (d - b) if u > v else a + v * (c - a) + u * (d - c)
    return a + u * (b - a) + v * (c - a) if u + v < 1 else d + (1 - u) * (c - d) + (1 - v) * (b - d)


def crossings():
    """Of the ray's plan with sides and diagonals, as shares of its way."""
    d, found = END - START, [0.0, 1.0]
    found += [(k - START[0]) / d[0] for k in range(1, 7)]
    found += [(k - START[1]) / d[1] for k in range(1, 4)]
    for i in range(7):
        for j in range(4):
            if diagonal_falls(i, j):  # x - i = y - j
                t = ((i - j) - (START[0] - START[1])) / (d[0] - d[1])
            else:  # x - i + y - j = 1
                t = (i + j + 1 - START[0] - START[1]) / (d[0] + d[1])
            x, y, _ = START + t * d
            if 0 < t < 1 and i <= x <= i + 1 and j <= y <= j + 1:
                found.append(t)
    return np.array(sorted(found))


def draw():
    fig, axes = plt.subplots(1, 2, figsize=(PAGE_WIDTH, 2.75), gridspec_kw={"width_ratios": [1.25, 1]})
    fig.subplots_adjust(left=0.06, right=0.985, top=0.88, bottom=0.17, wspace=0.2)
    ax = axes[0]
    d, t = END - START, crossings()
    f = np.array([START[2] + s * d[2] - height(*(START + s * d)[:2]) for s in t])
    met = next(k for k in range(1, len(t)) if f[k] < 0)
    hit = t[met - 1] + (t[met] - t[met - 1]) * f[met - 1] / (f[met - 1] - f[met])
    for i in range(7):
        for j in range(4):
            walked = any(i <= (START + s * d)[0] <= i + 1 and j <= (START + s * d)[1] <= j + 1 for s in (t[:met] + t[1 : met + 1]) / 2)
            ax.fill([i, i + 1, i + 1, i], [j, j, j + 1, j + 1], color=PALE if walked else "white", ec=GREY, lw=0.7)
            ax.plot([i, i + 1], [j, j + 1] if diagonal_falls(i, j) else [j + 1, j], color=GREY, lw=0.6, ls="--")
    for s in t[: met + 1]:
        ax.plot(*(START + s * d)[:2], "o", ms=3, color=RED, zorder=4)
    end = START + hit * d
    ax.plot([START[0], end[0]], [START[1], end[1]], color=RED, lw=1.5)
    ax.plot([end[0], END[0]], [end[1], END[1]], color=RED, lw=0.9, ls=":")
    ax.plot(*end[:2], "*", ms=10, color=BLACK, zorder=5)
    ax.set_xlim(0, 7)
    ax.set_ylim(4, 0)
    ax.set_aspect("equal")
    ax.set_yticks(range(5))
    ax.set_xlabel("x, columns")
    ax.set_ylabel("y, rows")
    ax.set_title("(a) from above: cells and halves that are walked")
    ax = axes[1]
    fine = np.linspace(0, 1, 300)
    ax.axhline(0, color=GREY, lw=0.7)
    ax.plot(t[: met + 1], f[: met + 1], "o-", ms=3, color=RED)
    ax.plot(fine[fine > t[met]], [START[2] + s * d[2] - height(*(START + s * d)[:2]) for s in fine[fine > t[met]]], color=RED, lw=0.9, ls=":")
    ax.plot(hit, 0, "*", ms=10, color=BLACK, zorder=5)
    ax.text(hit + 0.04, 0.2, "the sign changes:\nmet", fontsize=8, linespacing=1.3)
    ax.text(0.16, 2.7, "linear in each half;\nsigns at dots are handed on", fontsize=8, linespacing=1.3)
    ax.set_xlim(0, 1)
    ax.set_ylim(-1.6, 3.4)
    ax.set_xlabel("t, share of the ray's way")
    ax.set_ylabel("f(t), m", labelpad=1)
    ax.set_title("(b) the ray's height above the surface")
    save(fig, "theory", "geometry", __file__)


if __name__ == "__main__":
    draw()

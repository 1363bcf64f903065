"""Figure of docs/theory/textures.md: which curves stand where, with one image and with two."""

import numpy as np

from style import BLACK, BLUE, GREY, PAGE_WIDTH, RED, plt, save

LINE = np.array([-1.35, -0.55, 0.25, 1.65])
PLANE = np.array([(-1.3, -0.9), (-0.6, 0.7), (0.3, -0.5), (0.5, 1.0), (1.1, -0.3)])


def mean_of_one(zeta):
    """Of the mixture of neighbours, in standard deviations."""
    return np.interp(zeta, LINE, LINE)


def pair_of(zeta):
    """The nearest curve, and the one with which its segment passes closest; the share of the latter."""
    a = int(np.argmin(np.hypot(*(PLANE - zeta).T)))
    best = None
    for b in range(len(PLANE)):
        if b == a:
            continue
        way = PLANE[b] - PLANE[a]
        share = np.clip((zeta - PLANE[a]) @ way / (way @ way), 0, 1)
        off = np.hypot(*(PLANE[a] + share * way - zeta))
        if best is None or (off, np.hypot(*way)) < best[:2]:
            best = (off, np.hypot(*way), b, share)
    return a, best[2], best[3]


def draw():
    fig, axes = plt.subplots(1, 2, figsize=(PAGE_WIDTH, 2.8))
    fig.subplots_adjust(left=0.07, right=0.985, top=0.9, bottom=0.17, wspace=0.22)
    ax = axes[0]
    zeta = np.linspace(-2.4, 2.4, 400)
    ax.plot(zeta, zeta, color=GREY, ls="--", lw=0.9)
    ax.plot(zeta, mean_of_one(zeta), color=BLACK, label="two curves side by side")
    ax.step(zeta, LINE[np.argmin(abs(zeta[:, None] - LINE), axis=1)], color=BLUE, lw=0.9, ls=":", label="the nearest curve alone")
    ax.plot(LINE, LINE, "o", ms=5, color=RED)
    for k, z in enumerate(LINE):
        ax.plot([z, z], [-2.6, z], color=RED, lw=0.5)
    sample = 0.95
    ax.plot([sample] * 2, [-2.6, mean_of_one(sample)], color=BLACK, lw=0.9)
    ax.plot(sample, mean_of_one(sample), "s", ms=5, color=BLACK)
    ax.text(0.25, -2.5, " z_a", color=RED, va="bottom")
    ax.text(1.65, -2.5, " z_b", color=RED, va="bottom")
    ax.text(sample, -2.5, " ζ", va="bottom")
    ax.text(2.32, 2.3, "linear stretch", ha="right", va="top", fontsize=7.5, color="#555555", rotation=0)
    ax.set_xlim(-2.4, 2.4)
    ax.set_ylim(-2.6, 2.6)
    ax.set_xlabel("ζ of the cell, standard deviations")
    ax.set_ylabel("mean of the curves there", labelpad=1)
    ax.set_title("(a) one image, four curves")
    ax.legend(loc="upper left", fontsize=7.6, borderaxespad=0.1)
    ax = axes[1]
    for target, colour in ((np.array([0.75, 0.15]), BLACK), (np.array([-1.05, 0.05]), BLACK), (np.array([-0.35, -1.05]), BLACK)):
        a, b, share = pair_of(target)
        foot = PLANE[a] + share * (PLANE[b] - PLANE[a])
        ax.plot(*zip(PLANE[a], PLANE[b]), color=BLUE, lw=1.2)
        ax.plot(*zip(target, foot), color=GREY, lw=0.9, ls="--")
        ax.plot(*foot, ".", color=BLUE, ms=6)
        ax.plot(*target, "s", ms=5, color=colour)
        ax.text(*(target + (-0.08, 0.05)), "ζ", ha="right")
        ax.text(*(PLANE[a] + (0.08, -0.26)), "a", color=RED)
        ax.text(*(PLANE[b] + (0.08, -0.26)), "b", color=RED)
        ax.text(*(foot + (0.1, -0.03)), f"{share:.2f}", color=BLUE, fontsize=7.8, ha="left", va="center")
    ax.plot(*PLANE.T, "o", ms=5, color=RED)
    ax.set_xlim(-2, 2)
    ax.set_ylim(-1.5, 1.5)
    ax.set_aspect("equal")
    ax.set_xlabel("score in the first range")
    ax.set_ylabel("score in the second range", labelpad=1)
    ax.set_title("(b) two images: shares of b at three cells")
    save(fig, "theory", "textures", __file__)


if __name__ == "__main__":
    draw()

"""Figure of docs/theory/radiometry.md: two nodes of a channel on the red edge of a leaf, and what they are worth."""

import numpy as np

from data import columns, lines
from style import BLACK, GREY, PAGE_WIDTH, PALE, RED, plt, save


def draw():
    um, rho, response, sun = (np.array(c) for c in columns("nodes", "spectrum"))
    nodes = np.array([[float(x) for x in line[2:]] for line in lines("nodes") if line[0] == "node"])[:2]
    two = np.array([float(x) for x in next(line for line in lines("nodes") if line[:2] == ["moments", "2"])[2:]])
    exact = np.array([float(x) for x in next(line for line in lines("nodes") if line[:2] == ["moments", "0"])[2:]])
    fig, axes = plt.subplots(1, 2, figsize=(PAGE_WIDTH, 2.7), gridspec_kw={"width_ratios": [1.35, 1]})
    fig.subplots_adjust(left=0.065, right=0.985, top=0.9, bottom=0.17, wspace=0.28)
    ax = axes[0]
    ax.fill_between(um, 0, 0.5 * response / response.max(), color=PALE, lw=0)
    ax.text(0.706, 0.03, "r(λ)", color="#555555", ha="center")
    ax.plot(um, rho, color=BLACK)
    ax.text(0.7475, 0.44, "ρ(λ)", ha="right")
    mean = exact[1] / exact[0]
    ax.plot([0.694, 0.736], [mean, mean], color=GREY, ls="--")
    ax.text(0.693, mean, "one mean", ha="right", va="center", color="#555555")
    for (wavelength, weight, value), name in zip(nodes, ("t₋", "t₊") if nodes[0][2] < nodes[1][2] else ("t₊", "t₋")):
        ax.plot(wavelength, value, "o", color=RED, ms=6)
        share = weight / nodes[:, 1].sum()
        ax.text(wavelength + 0.002, value - 0.03, f"{value:.3f} at {name}, W {share:.2f}", color=RED, va="center")
    ax.set_xlim(0.665, 0.77)
    ax.set_ylim(0, 0.52)
    ax.set_xlabel("λ, µm")
    ax.set_ylabel("reflectance")
    ax.set_title("(a) a channel of 30 nm on a red edge")
    ax = axes[1]
    n = np.arange(1, 5)
    one = np.array([mean**k for k in n]) * exact[0] / exact[1:5] - 1
    pair = two[1:5] / exact[1:5] - 1
    ax.axhline(0, color=GREY, lw=0.7)
    ax.plot(n, 100 * one, "s--", color=GREY, ms=4.5, label="one mean")
    ax.plot(n, 100 * pair, "o-", color=RED, ms=5, label="two nodes")
    ax.set_xticks(n)
    ax.set_ylim(-62, 8)
    ax.set_xlabel("reflections by this leaf")
    ax.set_ylabel("error of the channel, %", labelpad=1)
    ax.set_title("(b) Σ w S ρⁿ against the integral")
    ax.legend(loc="lower left")
    save(fig, "theory", "radiometry", __file__)


if __name__ == "__main__":
    draw()

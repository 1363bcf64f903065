"""Figure of docs/theory/detectors.md: photon transfer, and noise of lines."""

import numpy as np

from data import columns
from style import BLACK, BLUE, GREY, ORANGE, PAGE_WIDTH, RED, plt, save


def draw_detectors():
    fig, axes = plt.subplots(1, 2, figsize=(PAGE_WIDTH, 2.7), gridspec_kw={"width_ratios": [1.15, 1]})
    fig.subplots_adjust(left=0.075, right=0.985, top=0.91, bottom=0.16, wspace=0.24)
    ax = axes[0]
    gain, read = 4.0, 12.0
    for prnu, colour, name in (("0", BLUE, "no pattern"), ("0.01", RED, "prnu = 1 %")):
        mean, variance = (np.array(c) for c in columns("photon_transfer", "transfer", prnu))
        shown = (mean > 2) & (variance > 0.05)
        ax.loglog(mean[shown], variance[shown], "o", ms=2.4, color=colour, label=name)
    line = np.geomspace(2, 15000, 100)
    ax.loglog(line, line / gain, color=BLACK, lw=0.8, ls="--")
    ax.loglog(line, (line * 0.01) ** 2, color=ORANGE, lw=0.9, ls="-.")
    ax.axhline(read**2 / gain**2 + 1 / 12, color=GREY, lw=0.8)
    ax.axvline(15000, color=GREY, lw=0.8, ls=":")
    ax.text(13200, 25, "full well", rotation=90, ha="right", fontsize=7.5, color="#555555")
    ax.text(740, 8.4, "read noise, rounding", fontsize=7.5, color="#555555", va="top")
    ax.text(2900, 330, "mean / gain", fontsize=7.5, rotation=28, rotation_mode="anchor")
    ax.text(240, 1.9, "(prnu × mean)²", fontsize=7.5, color="#9a6a00", rotation=50, rotation_mode="anchor")
    ax.set_xlim(2, 30000)
    ax.set_ylim(1.5, 60000)
    ax.set_xlabel("mean, counts above the offset", labelpad=1)
    ax.set_ylabel("variance, counts²", labelpad=1)
    ax.set_title("(a) photon transfer: 12 e⁻ read noise, 4 e⁻ a count")
    ax.legend(loc="upper left", borderaxespad=0, handletextpad=0.2)
    ax = axes[1]
    line, *drift = (np.array(c) for c in columns("photon_transfer", "drift"))
    for k, (values, colour) in enumerate(zip(drift, (BLUE, RED, BLACK))):
        ax.plot(line, values + 40 * (1 - k), color=colour, lw=0.8)
        ax.axhline(40 * (1 - k), color=GREY, lw=0.4)
    ax.set_xlim(0, 400)
    ax.set_yticks([40, 0, -40], ["column 1", "2", "3"])
    ax.set_xlabel("line", labelpad=1)
    ax.set_title("(b) 1/f noise, corner at 0.1 cycles a line")
    ax.plot([392, 392], [66, 78], color=BLACK, lw=1.4, solid_capstyle="butt")
    ax.text(386, 72, "12 e⁻", ha="right", va="center", fontsize=7.5)
    save(fig, "theory", "detectors", __file__)


if __name__ == "__main__":
    draw_detectors()

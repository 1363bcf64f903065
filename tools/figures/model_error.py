"""Figure of docs/theory/atmosphere_model_error.md: what is stated of the transmittance of two atmospheres."""

import numpy as np

from data import columns
from style import BLUE, PAGE_WIDTH, PALE, RED, plt, save


def draw():
    fig, axes = plt.subplots(2, 1, figsize=(PAGE_WIDTH, 2.9), sharex=True, gridspec_kw={"height_ratios": [0.5, 1.0]})
    fig.subplots_adjust(left=0.085, right=0.985, top=0.93, bottom=0.135, hspace=0.36)
    for letter, name, colour, style in (("t", "tropical", RED, "-"), ("s", "subarctic winter", BLUE, "--")):
        (water,), = columns("model_error", "water", letter)
        um, through, error = (np.array(c) for c in columns("model_error", "model_error", letter))
        axes[0].semilogx(um, through, color=colour, ls=style, lw=0.9)
        shown = through > 0.02
        axes[1].loglog(um, np.where(shown, 100 * error, np.nan), color=colour, ls=style, lw=1.1, label=f"{name}, {water:.1f} g cm⁻² of water")
        if letter == "t":
            axes[0].fill_between(um, 0, through, color=PALE, lw=0)
    ticks = [0.4, 0.5, 0.7, 1, 1.5, 2, 3, 4, 5, 7, 10, 15]
    axes[1].set_xlim(0.36, 15)
    axes[1].set_xticks(ticks, [f"{t:g}" for t in ticks])
    axes[1].minorticks_off()
    axes[1].set_ylim(0.2, 150)
    axes[1].set_yticks([1, 10, 100], ["1", "10", "100"])
    axes[1].grid(axis="y", color=PALE, lw=0.6)
    axes[1].set_ylabel("e^{Δ} − 1, %", labelpad=3)
    axes[1].set_xlabel("wavelength, µm", labelpad=1)
    fig.legend(*axes[1].get_legend_handles_labels(), loc="upper right", bbox_to_anchor=(0.99, 0.672), ncol=2, handlelength=2.4, borderaxespad=0.2)
    axes[1].set_title("(b) what it may be off by")
    axes[0].set_ylim(0, 1.02)
    axes[0].set_yticks([0, 0.5, 1])
    axes[0].set_title("(a) transmittance of the gases, straight up")
    save(fig, "theory", "atmosphere_model_error", __file__)


if __name__ == "__main__":
    draw()

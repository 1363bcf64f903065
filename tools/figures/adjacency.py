"""Figure of docs/theory/atmosphere_adjacency.md: from how far away the ground's light in the air comes."""

import numpy as np

from data import columns
from style import BLACK, BLUE, GREY, ORANGE, PAGE_WIDTH, RED, arrow, plt, save, sketch


def draw_adjacency():
    fig = plt.figure(figsize=(PAGE_WIDTH, 2.6))
    ax = fig.add_axes((0.0, 0.0, 0.42, 1.0))
    sketch(ax, 122, 104)
    ax.text(2, 98, "(a) a dark lake seen through a veil", fontsize=9)
    ax.fill_between([0, 122], 0, 12, color="#d9cfae", lw=0)
    ax.fill_between([46, 78], 0, 12, color="#3f6e8c", lw=0)
    ax.text(62, 5.5, "lake", color="white", ha="center", va="center", fontsize=8)
    ax.text(20, 5.5, "field: L_g", ha="center", va="center", fontsize=8)
    arrow(ax, (62, 12), (62, 92), "#3f6e8c", 1.3)
    for foot, height in ((14, 58), (30, 42), (100, 50)):
        arrow(ax, (foot, 12), (62, height), ORANGE, 1.1)
        arrow(ax, (62, height), (62, height + 16), ORANGE, 1.8)
        ax.plot(62, height, "o", color=BLACK, ms=2.6)
    ax.text(66, 84, "to the sensor", fontsize=8)
    ax.text(69, 64, "scattered into the line", fontsize=8, color="#9a6a00")
    arrow(ax, (62, 16), (100, 16), GREY, 0.9, "<|-|>")
    ax.text(81, 19, "r", ha="center")
    ax = fig.add_axes((0.50, 0.17, 0.455, 0.72))
    for words, name, colour, style in ((("hazy", "0.45"), "haze of 23 km, 0.45 µm", BLUE, "-"), (("hazy", "0.865"), "the same, 0.865 µm", RED, "-."),
                                       (("clear", "0.45"), "molecules alone, 0.45 µm", BLACK, "--"),
                                       (("low", "0.45"), "haze, sensor at 2 km", GREY, "-")):
        km, share = (np.array(c) for c in columns("adjacency", "within", *words))
        ax.semilogx(km, share, color=colour, ls=style, label=name)
    ax.set_xlim(0.01, 100)
    ax.set_ylim(0, 1)
    ax.set_xticks([0.01, 0.1, 1, 10, 100], ["10 m", "100 m", "1 km", "10 km", "100 km"])
    ax.minorticks_off()
    ax.set_xlabel("r", labelpad=1)
    ax.set_title("(b) F(r), share of the ground's light from within r")
    ax.legend(loc="upper left", borderaxespad=0.1)
    save(fig, "theory", "atmosphere_adjacency", __file__)


if __name__ == "__main__":
    draw_adjacency()

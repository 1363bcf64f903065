"""Figure of docs/theory/surfaces.md: the angles of a scattering event, and pi f in the principal plane."""

import numpy as np

from data import columns
from style import BLACK, BLUE, GREY, PAGE_WIDTH, PALE, RED, arrow, plt, save, sketch


def draw_angles(ax):
    sketch(ax, 100, 92)
    ax.text(0, 86, "(a) directions, away from the surface", fontsize=9)
    # An oblique view of the surface: x to the right, y into the page.
    origin = np.array([50.0, 22.0])

    def place(x, y, z):
        return origin + np.array([x + 0.42 * y, 0.3 * y + z])

    ax.fill(*zip(place(-46, -34, 0), place(46, -34, 0), place(46, 34, 0), place(-46, 34, 0)), color=PALE, zorder=0)
    arrow(ax, origin, place(0, 0, 54))
    ax.text(*(place(0, 0, 54) + (-6, 0)), "n")

    def direction(zenith, azimuth, length=50):
        z, a = np.radians(zenith), np.radians(azimuth)
        return length * np.array([np.sin(z) * np.cos(a), np.sin(z) * np.sin(a), np.cos(z)])

    out, light = direction(48, 28), direction(52, 180)
    for v, colour, name, shift in ((out, BLUE, "ω, to the viewer", (-16, 3)), (light, RED, "ω′, to the light", (-11, 3.5))):
        tip, foot = place(*v), place(v[0], v[1], 0)
        arrow(ax, origin, tip, colour, 1.5)
        ax.text(*(tip + shift), name, color=colour)
        ax.plot(*zip(origin, foot), color=colour, lw=0.9, ls="--")
        ax.plot(*zip(tip, foot), color=GREY, lw=0.7, ls=":")
    # Zenith angles in the vertical planes of both, the azimuth on the surface.
    for v, name, colour in ((out, "θ", BLUE), (light, "θ′", RED)):
        zenith = np.arccos(v[2] / np.hypot(np.hypot(v[0], v[1]), v[2]))
        azimuth = np.arctan2(v[1], v[0])
        t = np.linspace(0, zenith, 20)
        arc = [place(*(22 * np.array([np.sin(a) * np.cos(azimuth), np.sin(a) * np.sin(azimuth), np.cos(a)]))) for a in t]
        ax.plot(*zip(*arc), color=colour, lw=0.9)
        ax.text(*(origin + 0.7 * (arc[10] - origin)), name, color=colour, ha="center", va="center")
    t = np.radians(np.linspace(28, 180, 40))
    arc = [place(17 * np.cos(a), 17 * np.sin(a), 0) for a in t]
    ax.plot(*zip(*arc), color=BLACK, lw=0.9)
    ax.text(*(arc[22] + (-1, 2.5)), "φ", ha="center")
    arc = [place(*(30 * u / np.linalg.norm(u))) for u in (out / 50 * s + light / 50 * (1 - s) for s in np.linspace(0, 1, 40))]
    ax.plot(*zip(*arc), color=BLACK, lw=0.9, ls="-.")
    ax.text(*(arc[13] + (1, 4)), "γ", ha="center")


def draw_lobes(ax):
    for name, text, colour, style in (("oren_nayar", "oren_nayar: ρ = 0.3, σ = 30°", BLACK, "-"),
                                      ("ross_li", "ross_li: f = 0.3, 0.15, 0.02, γ₀ = 1.5°", BLUE, "-"),
                                      ("ross_li_no_hot_spot", "the same, γ₀ = 0", BLUE, ":"),
                                      ("rpv", "rpv: ρ₀ = 0.076, k = 0.648, Θ = −0.29", RED, "--")):
        angle, value = columns("bsdf", name)
        ax.plot(angle, value, color=colour, ls=style, label=text)
    ax.axvline(30, color=GREY, lw=0.8, zorder=0)
    ax.text(29, 0.015, "light, θ′ = 30°", rotation=90, ha="right", va="bottom", fontsize=7.5, color="#555555")
    ax.set_xlim(-80, 80)
    ax.set_ylim(0, 0.7)
    ax.set_xticks(range(-80, 81, 40))
    ax.set_xlabel("zenith angle of the view in the principal plane, °")
    ax.set_ylabel("π f")
    ax.set_title("(b) light from 30° on the right")
    ax.legend(loc="upper left", fontsize=7.4, handlelength=2.2, borderaxespad=0.1)


def draw():
    fig = plt.figure(figsize=(PAGE_WIDTH, 3.1))
    draw_angles(fig.add_axes((0.0, 0.02, 0.48, 0.97)))
    draw_lobes(fig.add_axes((0.555, 0.145, 0.43, 0.77)))
    save(fig, "theory", "surfaces", __file__)


if __name__ == "__main__":
    draw()

"""Figure of docs/theory/polarization.md: the signs of Q, U and V, the meridional frame, Fresnel reflection."""

import numpy as np
from matplotlib.patches import Circle

from data import columns
from style import BLACK, BLUE, GREY, PAGE_WIDTH, PALE, RED, arrow, plt, save, sketch


def draw_signs(ax):
    """As seen by one whom the light meets: k towards the reader, so x to y turns counter-clockwise."""
    sketch(ax, 120, 100)
    ax.text(3, 93, "(a) seen by one whom the light meets", fontsize=9)
    for k, (name, colour) in enumerate((("Q > 0", BLUE), ("U > 0", RED), ("V > 0", BLACK))):
        c = np.array([20.0 + 40 * k, 52.0])
        arrow(ax, c + (-14, 0), c + (16, 0), GREY, 0.8)
        arrow(ax, c + (0, -14), c + (0, 16), GREY, 0.8)
        ax.text(*(c + (15, -7)), "x", color="#555555")
        ax.text(*(c + (-6, 14)), "y", color="#555555")
        if k < 2:
            a = np.radians(45 * k)
            d = 12 * np.array([np.cos(a), np.sin(a)])
            arrow(ax, c - d, c + d, colour, 2.0, "<|-|>")
        else:
            a = np.linspace(np.radians(-60), np.radians(240), 60)
            ax.plot(c[0] + 10 * np.cos(a), c[1] + 10 * np.sin(a), color=colour, lw=2.0)
            arrow(ax, (c[0] + 10 * np.cos(a[-3]), c[1] + 10 * np.sin(a[-3])), (c[0] + 10 * np.cos(a[-1]), c[1] + 10 * np.sin(a[-1])), colour, 2.0)
        ax.text(c[0], 76, name, ha="center", color=colour)
        ax.add_patch(Circle(c, 1.6, fc="white", ec=BLACK, lw=0.8, zorder=5))
        ax.plot(*c, ".", color=BLACK, ms=2, zorder=6)
    ax.text(60, 23, "⊙  k = x × y, towards the reader;\nV > 0: the field at a place turns from x to y", ha="center", va="center", fontsize=8, linespacing=1.35)


def draw_frame(ax):
    sketch(ax, 90, 100)
    ax.text(2, 94, "(b) meridional frame", fontsize=9)
    origin = np.array([20.0, 26.0])

    def place(x, y, z):
        return origin + np.array([x + 0.45 * y, 0.35 * y + z])

    arrow(ax, origin, place(0, 0, 58))
    ax.text(*(place(0, 0, 58) + (-9, -4)), "up")
    theta, phi = np.radians(50), np.radians(20)

    def unit(t, p):
        return np.array([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)])

    k = unit(theta, phi)
    e_theta = np.array([np.cos(theta) * np.cos(phi), np.cos(theta) * np.sin(phi), -np.sin(theta)])
    e_phi = np.array([-np.sin(phi), np.cos(phi), 0])
    plane = [place(*(46 * unit(t, phi))) for t in np.linspace(0, np.pi / 2, 30)]
    ax.fill(*zip(origin, *plane), color=PALE, zorder=0)
    ax.text(*place(*(31 * unit(np.radians(80), phi))), "vertical plane", fontsize=7.5, ha="center", va="center", color="#555555", linespacing=1.15)
    tip = 40 * k
    arrow(ax, origin, place(*tip), BLACK, 1.1)
    arrow(ax, place(*tip), place(*(tip + 17 * k)), BLACK, 1.8)
    ax.text(*(place(*(tip + 17 * k)) + (1, 1)), "k")
    arrow(ax, place(*tip), place(*(tip + 19 * e_theta)), BLUE, 1.8)
    ax.text(*(place(*(tip + 19 * e_theta)) + (2, -3)), "x = e_θ", color=BLUE)
    arrow(ax, place(*tip), place(*(tip + 22 * e_phi)), RED, 1.8)
    ax.text(*(place(*(tip + 22 * e_phi)) + (-8, 9)), "y = e_φ, level", color=RED, ha="center")
    arc = [place(*(18 * unit(t, phi))) for t in np.linspace(0, theta, 15)]
    ax.plot(*zip(*arc), color=BLACK, lw=0.8)
    ax.text(*(arc[8] + (0, 3.5)), "θ")


def draw_fresnel(ax):
    angle, p, s = (np.array(c) for c in columns("fresnel", "water"))
    ax.plot(angle, s, color=BLACK, label="|r_s|²")
    ax.plot(angle, p, color=BLUE, ls="--", label="|r_p|²")
    ax.plot(angle, (s - p) / (s + p), color=RED, ls="-.", label="polarization")
    brewster = np.degrees(np.arctan(1.333))
    ax.axvline(brewster, ymax=0.67, color=GREY, lw=0.7, zorder=0)
    ax.text(brewster - 1.5, 0.5, f"Brewster, {brewster:.1f}°", rotation=90, ha="right", va="center", fontsize=7.5, color="#555555")
    ax.set_xlim(0, 90)
    ax.set_ylim(0, 1.5)
    ax.set_xticks([0, 30, 60, 90])
    ax.set_xlabel("angle of incidence, °")
    ax.set_title("(c) water, m = 1.333")
    ax.set_yticks([0, 0.5, 1])
    ax.legend(loc="upper left", fontsize=7.5, handlelength=2.4, borderaxespad=0, labelspacing=0.25)


def draw():
    fig = plt.figure(figsize=(PAGE_WIDTH, 2.5))
    draw_signs(fig.add_axes((0.0, 0.0, 0.405, 1.0)))
    draw_frame(fig.add_axes((0.41, 0.0, 0.3, 1.0)))
    draw_fresnel(fig.add_axes((0.765, 0.175, 0.22, 0.71)))
    save(fig, "theory", "polarization", __file__)


if __name__ == "__main__":
    draw()

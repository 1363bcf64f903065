"""Figures of docs/theory/temperature.md: what a surface gains and loses, and its solid in cells; a day of two solids, and what
the past is worth."""

import numpy as np
from matplotlib.patches import Circle, Polygon

from data import columns
from style import BLACK, BLUE, GREY, PAGE_WIDTH, PALE, PALER, RED, angle_arc, arrow, plt, save, sketch

SUNLIGHT, HEAT = RED, BLUE


def draw_balance(ax):
    sketch(ax, 190, 126)
    ax.text(2, 119, "(a) a surface that is tilted by β", fontsize=9)
    ground = 12.0
    ax.fill_between([0, 190], 0, ground, color=PALE, lw=0)
    ax.text(4, 3, "ground: as warm as the air, T_{a}; reflectance r_{g}", fontsize=8)
    beta = np.radians(24)
    along, normal = np.array([np.cos(beta), np.sin(beta)]), np.array([-np.sin(beta), np.cos(beta)])
    foot = np.array([66.0, 33.0])

    def at(s, height=0.0):
        return foot + s * along + height * normal

    length, thick = 104.0, 15.0
    ax.add_patch(Polygon([at(0), at(length), at(length, -thick), at(0, -thick)], fc=PALE, ec=BLACK, lw=0.8))
    ax.plot(*zip(at(0), at(length)), color=BLACK, lw=2.2, solid_capstyle="butt")
    # Tilt.
    ax.plot(*zip(at(0), at(0) + (24, 0)), color=GREY, lw=0.8, ls=":")
    angle_arc(ax, tuple(at(0)), 20, 0, np.degrees(beta), "")
    ax.text(*(at(0) + 24.5 * np.array([np.cos(beta / 2), np.sin(beta / 2)]) + (0, 0.3)), "β", ha="center", va="center")
    # From the ground in front of it.
    arrow(ax, (10, ground), at(10) + (-0.9, 0.6), SUNLIGHT, 1.3)
    ax.text(2, 34, "α r_{g} E_{global} (1 − F)", color=SUNLIGHT, fontsize=8)
    arrow(ax, (30, ground), at(4) + (-0.9, 0.2), HEAT, 1.3)
    ax.text(43, 15.5, "ε σ T_{a}⁴ (1 − F)", color=HEAT, fontsize=8)
    # The Sun, and what hides part of it.
    x = at(28)
    arrow(ax, x, x + 34 * normal, GREY, 0.9)
    ax.text(*(x + 36 * normal + (0.4, 1)), "n", color="#555555", ha="center")
    s = np.array([-np.cos(np.radians(47)), np.sin(np.radians(47))])
    arrow(ax, x + 74 * s, x, SUNLIGHT, 1.6)
    ax.add_patch(Circle(x + 80 * s, 6, fc="#f4c542", ec=BLACK, lw=0.7))
    angle_arc(ax, tuple(x), 22, np.degrees(beta) + 90, 180 - 47, "")
    middle = np.radians((np.degrees(beta) + 90 + 133) / 2)
    ax.text(*(x + 26 * np.array([np.cos(middle), np.sin(middle)])), "θ", ha="center", va="center")
    ax.text(*(x + 60 * s + (-3, -7)), "α E_{sun} V cos θ", color=SUNLIGHT, fontsize=8, ha="right")
    # The sky, in sunlight and thermal.
    top = 101.0
    for s_at, lean, colour, text in ((42, -8, SUNLIGHT, "α E_{sky} F"), (56, 2, HEAT, "ε L_{sky} F")):
        tip = at(s_at)
        start = np.array([tip[0] + lean, top])
        arrow(ax, start, tip, colour, 1.3)
        ax.text(start[0], top + 3, text, color=colour, fontsize=8, ha="center")
    ax.text(106, 112, "from the sky", fontsize=8, ha="center")
    # What it gives off.
    arrow(ax, at(69), at(69) + (2.5, 32), HEAT, 1.6)
    ax.text(*(at(69) + (2.5, 35)), "ε σ T⁴", color=HEAT, fontsize=8, ha="center")
    # The air.
    def wave(start, end, colour):
        start, end = np.array(start), np.array(end)
        t = np.linspace(0, 0.86, 60)
        across = np.array([-(end - start)[1], (end - start)[0]]) / np.hypot(*(end - start))
        line = start + t[:, None] * (end - start) + (1.3 * np.sin(t * 6 * np.pi))[:, None] * across
        ax.plot(*line.T, color=colour, lw=1.2)
        arrow(ax, start + 0.85 * (end - start), end, colour, 1.2)

    wave(at(86) + (8, 26), at(86), BLACK)
    ax.text(*(at(86) + (9, 29)), "h (T_{a} − T)", fontsize=8, ha="center")
    wave(at(97), at(97) + (12, 17), BLACK)
    ax.text(*(at(97) + (13.5, 17)), "λE", fontsize=8, va="center")
    # Inwards.
    tilted = {"fontsize": 8, "rotation": np.degrees(beta), "rotation_mode": "anchor"}
    arrow(ax, at(64), at(64, -11), BLACK, 1.4)
    ax.text(*at(67, -10), "G_{0} (T − T_{0})", **tilted)
    arrow(ax, at(38, -12), at(38), BLACK, 1.4)
    ax.text(*at(41, -10), "P", **tilted)


def draw_cells(ax):
    """Cells whose sizes grow by more than the program's, so that they can be told apart."""
    sketch(ax, 92, 126)
    ax.text(0, 119, "(b) the solid in cells", fontsize=9)
    left, right, surface = 12.0, 62.0, 98.0
    depths = 7.5 * (1.42 ** np.arange(6) - 1) / 0.42
    edges = surface - depths
    for k in range(5):
        ax.fill_between([left, right], edges[k + 1], edges[k], color=PALE if k % 2 == 0 else PALER, lw=0)
    for edge in edges[1:-1]:
        ax.plot([left, right], [edge, edge], color=GREY, lw=0.6)
    ax.plot([left, right], [surface, surface], color=BLACK, lw=2.2, solid_capstyle="butt")
    ax.plot([left, right], [edges[-1], edges[-1]], color=BLACK, lw=1.2)

    def warm(y):
        z = (surface - y) / 30.0
        return left + 10 + 33 * np.exp(-z) * np.cos(z - 0.25)

    y = np.linspace(edges[-1], surface, 60)
    ax.plot(warm(y), y, color=RED, lw=1.1)
    middles = (edges[1:] + edges[:-1]) / 2
    for at in (surface, *middles):
        ax.plot(warm(at), at, "o", color=RED, ms=4, zorder=5)
    ax.text(warm(surface), surface + 3, "T", color=RED, ha="center")
    for k, at in enumerate(middles[:3]):
        ax.text(warm(at) - 3, at - 0.4, f"T_{{{k}}}", color=RED, ha="right", va="center", fontsize=8)
    # Conduction from the surface to the first middle and on.
    x = right - 6
    arrow(ax, (right + 4, surface), (right + 4, middles[0]), BLACK, 1.1)
    ax.text(right + 7, (surface + middles[0]) / 2, "G_{0}", va="center", fontsize=8)
    arrow(ax, (x - 18, surface + 16), (x - 18, surface + 1), BLACK, 1.4)
    ax.text(x - 21, surface + 10, "q(t, T)", fontsize=8, va="center", ha="right")
    for a, b, text in ((edges[0], edges[1], "x_{1}"), (edges[1], edges[2], "g x_{1}"), (edges[2], edges[3], "g² x_{1}")):
        ax.annotate("", (left - 3, b), (left - 3, a), arrowprops={"arrowstyle": "|-|, widthA=0.15, widthB=0.15", "lw": 0.6, "shrinkA": 0, "shrinkB": 0})
        ax.text(left - 5, (a + b) / 2, text, ha="right", va="center", fontsize=7.2)
    arrow(ax, (right + 20, surface), (right + 20, edges[-1]), GREY, 0.8)
    ax.text(right + 22, edges[-1] + 2, "z", color="#555555")
    ax.text(left, edges[-1] - 4, "behind: insulated, held, a room\nor deep ground", fontsize=7.6, va="top", linespacing=1.25)


def draw_surface():
    fig = plt.figure(figsize=(PAGE_WIDTH, 3.17))
    draw_balance(fig.add_axes((0.0, 0.0, 0.665, 1.0)))
    draw_cells(fig.add_axes((0.68, 0.0, 0.32, 1.0)))
    save(fig, "theory", "temperature_balance", __file__)


def draw_day():
    fig = plt.figure(figsize=(PAGE_WIDTH, 2.75))
    ax = fig.add_axes((0.075, 0.16, 0.50, 0.74))
    for name, colour in (("steel", RED), ("concrete", BLUE)):
        for visible, style in (("1", "-"), ("0", "--")):
            hour, kelvins = (np.array(c) for c in columns("temperatures", "temperature", name, visible))
            ax.plot(hour, kelvins - 273.15, color=colour, ls=style)
    hour, kelvins = (np.array(c) for c in columns("temperatures", "air"))
    ax.plot(hour, kelvins - 273.15, color=GREY, lw=1.1, ls=":")
    ax.text(14.6, 51, "steel, in the Sun", color=RED, fontsize=8)
    ax.text(19.3, 31.5, "concrete,\nin the Sun", color=BLUE, fontsize=8, linespacing=1.2)
    ax.text(20.8, 20, "air", color="#555555", fontsize=8)
    ax.text(10.2, 25, "steel, in the shade", color=RED, fontsize=8)
    ax.text(10.4, 12, "concrete, in the shade", color=BLUE, fontsize=8)
    ax.set_xlim(0, 24)
    ax.set_ylim(0, 60)
    ax.set_xticks(range(0, 25, 3))
    ax.set_xlabel("hour, UTC")
    ax.set_ylabel("temperature of the surface, °C", labelpad=2)
    ax.set_title("(a) a clear day of June at 52° N, 0° E")
    ax = fig.add_axes((0.69, 0.16, 0.30, 0.74))
    for name, colour in (("steel", RED), ("concrete", BLUE)):
        hours, kernel = (np.array(c) for c in columns("temperatures", "kernel", name))
        kept = kernel > 1e-7
        ax.loglog(hours[kept], kernel[kept], color=colour)
    ax.set_xlim(0.1, 72)
    ax.set_ylim(1e-5, 1)
    ax.set_xticks([0.1, 1, 10], ["0.1", "1", "10"])
    ax.set_xlabel("hours before")
    ax.set_ylabel("K / Δt,  K per W h m^{−2}", labelpad=1)
    ax.text(0.16, 0.12, "steel", color=RED, fontsize=8)
    ax.text(2.2, 5e-3, "concrete", color=BLUE, fontsize=8)
    ax.set_title("(b) what the past is worth at 15 h")
    save(fig, "theory", "temperature_day", __file__)


if __name__ == "__main__":
    draw_surface()
    draw_day()

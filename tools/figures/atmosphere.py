"""Figures of docs/theory/atmosphere.md, atmosphere_scattering.md and atmosphere_sensor.md."""

import numpy as np

from data import columns
from style import BLACK, BLUE, GREY, ORANGE, PAGE_WIDTH, PALE, PALER, RED, SKY, angle_arc, arrow, plt, save, sketch


def draw_gases():
    fig, axes = plt.subplots(2, 1, figsize=(PAGE_WIDTH, 3.9), gridspec_kw={"height_ratios": [1.0, 0.85]})
    fig.subplots_adjust(left=0.075, right=0.985, top=0.95, bottom=0.11, hspace=0.55)
    um, water, carbon, ozone, oxygen, every = (np.array(c) for c in columns("gases", "gas"))
    ax = axes[0]
    ax.fill_between(um, 0, every, color=PALE, lw=0, label="all gases")
    for values, name, colour, style in ((water, "H₂O with continuum", BLUE, "-"), (carbon, "CO₂", RED, "-."), (ozone, "O₃", BLACK, "--"),
                                        (oxygen, "O₂, pairs", ORANGE, "-")):
        shown = np.where(values < 0.995, values, np.nan)
        ax.semilogx(um, shown, color=colour, ls=style, lw=0.9, label=name)
    ax.set_xlim(0.3, 15)
    ax.set_ylim(0, 1.02)
    ticks = [0.3, 0.5, 0.7, 1, 1.5, 2, 3, 4, 5, 7, 10, 15]
    ax.set_xticks(ticks, [f"{t:g}" for t in ticks])
    ax.minorticks_off()
    ax.set_xlabel("wavelength, µm", labelpad=1)
    ax.set_ylabel("transmittance")
    ax.set_title("(a) mid-latitude summer, straight up from sea level, gases alone")
    ax.legend(ncol=5, loc="lower center", bbox_to_anchor=(0.5, -0.02), fontsize=7.2, handlelength=1.4, columnspacing=1.0, frameon=True, framealpha=0.9,
              edgecolor="none")
    ax = axes[1]
    for count, colour, style in ((3, GREY, "-"), (5, RED, "--"), (8, BLUE, "-")):
        x, exact, terms = (np.array(c) for c in columns("gases", "terms", str(count)))
        ax.semilogx(x, 100 * (terms - exact), color=colour, ls=style, label=f"{count} terms")
    ax.axhline(0, color=GREY, lw=0.6)
    ax.set_xlim(1e-5, 1e3)
    ax.set_ylim(-2.2, 3.4)
    ax.set_xlabel("x = 10^C′ W", labelpad=1)
    ax.set_ylabel("error, %", labelpad=1)
    ax.set_title("(b) Σ w e^(−k x) less exp(−x^a), a = 0.47, the exponent that is fitted worst")
    ax.legend(ncol=3, loc="upper right", borderaxespad=0)
    ax.set_yticks([-2, -1, 0, 1, 2])
    other = ax.twinx()
    x, exact, _ = columns("gases", "terms", "8")
    other.semilogx(x, exact, color=BLACK, lw=0.8, ls=":")
    other.set_ylim(0, 1.12)
    other.set_yticks([])
    other.text(1.3e-5, 0.05, "dotted: exp(−x^a), from 1 to 0", fontsize=7.5, color="#333333")
    save(fig, "theory", "atmosphere", __file__)


def draw_scattering():
    fig = plt.figure(figsize=(PAGE_WIDTH, 2.55))
    ax = fig.add_axes((0.0, 0.0, 0.42, 1.0))
    sketch(ax, 120, 98)
    ax.text(2, 92, "(a) sunbeam and line of sight in shells", fontsize=9)
    centre = np.array([60.0, -92.0])
    for k, radius in enumerate((110, 122, 134, 146, 158)):
        a = np.radians(np.linspace(66, 114, 60))
        ax.plot(centre[0] + radius * np.cos(a), centre[1] + radius * np.sin(a), color=BLACK if k == 0 else GREY, lw=1.3 if k == 0 else 0.6)
    a = np.radians(np.linspace(66, 114, 40))
    ax.fill_between(centre[0] + 110 * np.cos(a), -5, centre[1] + 110 * np.sin(a), color=PALE, lw=0)
    foot = centre + (0, 110)
    direction = np.array([-np.sin(np.radians(62)), np.cos(np.radians(62))])
    arrow(ax, foot + 62 * direction, foot, RED, 1.4)
    ax.text(*(foot + 62 * direction + (-1, 5)), "sunlight", color=RED, ha="left")
    ax.plot([foot[0]] * 2, [foot[1], foot[1] + 60], color=GREY, lw=0.8, ls=":")
    ax.text(foot[0] - 2, foot[1] + 56, "zenith", fontsize=7.5, color="#555555", ha="right")
    angle_arc(ax, tuple(foot), 26, 90, 152, "arccos μ₀", text_radius=32, colour=RED)
    view = np.array([np.sin(np.radians(40)), np.cos(np.radians(40))])
    arrow(ax, foot, foot + 66 * view, BLUE, 1.4)
    ax.text(*(foot + 66 * view + (4, -1)), "to the\nsensor", color=BLUE, linespacing=1.15, fontsize=8)
    angle_arc(ax, tuple(foot), 22, 50, 90, "arccos μ", text_radius=33, colour=BLUE)
    for radius in (122, 134, 146, 158):  # where they cross the line of sight
        along = 110 * np.cos(np.radians(40))
        length = np.sqrt(along**2 + radius**2 - 110**2) - along
        middle = np.arctan2(*(foot + length * view - centre)[::-1])
        a = np.linspace(middle - 5 / radius, middle + 5 / radius, 8)
        ax.plot(centre[0] + radius * np.cos(a), centre[1] + radius * np.sin(a), color=BLUE, lw=1.1)
    degree, air, air_p, haze, haze_p = (np.array(c) for c in columns("phase", "phase"))
    ax = fig.add_axes((0.495, 0.18, 0.205, 0.68))
    ax.semilogy(degree, air, color=BLUE, label="molecules")
    ax.semilogy(degree, haze, color=BLACK, ls="--", label="g = 0.65")
    ax.set_ylabel("a₁", labelpad=1)
    ax.set_yticks([0.1, 1, 10], ["0.1", "1", "10"])
    ax.set_title("(b) phase function")
    ax.legend(loc="upper right", fontsize=7.5, handlelength=1.8, borderaxespad=0)
    second = fig.add_axes((0.78, 0.18, 0.205, 0.68))
    second.plot(degree, air_p, color=BLUE)
    second.plot(degree, haze_p, color=BLACK, ls="--")
    second.set_ylabel("−b₁/a₁", labelpad=1)
    second.set_title("(c) polarization")
    second.set_ylim(0, 1)
    for axis in (ax, second):
        axis.set_xlim(0, 180)
        axis.set_xticks([0, 60, 120, 180])
        axis.set_xlabel("scattering angle Θ, °")
    save(fig, "theory", "atmosphere_scattering", __file__)


def draw_terms():
    """Which way light takes, with the symbols of equation (2)."""
    fig = plt.figure(figsize=(PAGE_WIDTH, 2.75))
    ax = fig.add_axes((0, 0, 1, 1))
    sketch(ax, 288, 110)
    ax.fill_between([0, 288], 18, 84, color=PALER, lw=0)
    ax.fill_between([0, 288], 8, 18, color="#d9d2c3", lw=0)
    ax.fill_between([118, 176], 8, 18, color="#b8ad97", lw=0)
    ax.text(147, 12.6, "scene", ha="center", va="center", fontsize=8)
    ax.text(30, 12.6, "surroundings: ρ_e, B_e", ha="center", va="center", fontsize=8)
    ax.text(3, 79, "air", color="#555555", fontsize=8)
    arrow(ax, (12, 106), (38, 18), RED, 1.6)
    ax.text(21, 90, "E_s", color=RED)
    arrow(ax, (72, 106), (86, 54), RED, 1.2)
    for k in (-13, 0, 13):
        arrow(ax, (86, 54), (86 + k, 18), SKY, 1.2)
    ax.text(97, 29, "E_d", color="#2f7fb8")
    # Ground and air.
    arrow(ax, (50, 18), (56, 44), "#7a5c1e", 1.2)
    arrow(ax, (56, 44), (62, 18), "#7a5c1e", 1.2)
    ax.text(56, 47, "S", color="#7a5c1e", ha="center")
    sensor = (238.0, 102.0)
    ax.add_patch(plt.Polygon([(231, 100), (245, 100), (242, 108), (234, 108)], fc=BLACK))
    ax.text(248, 101, "sensor")
    arrow(ax, (150, 18), (233, 99), BLACK, 1.7)
    ax.text(169, 30, "T_view L_surface")
    arrow(ax, (190, 106), (201, 64), RED, 1.2)
    arrow(ax, (201, 64), (234, 98), BLUE, 1.2)
    ax.text(207, 60, "L_black,path", color=BLUE)
    arrow(ax, (258, 18), (250, 50), "#7a5c1e", 1.2)
    arrow(ax, (250, 50), (240, 98), "#7a5c1e", 1.2)
    ax.text(257, 38, "L_e  t_d", color="#7a5c1e")
    arrow(ax, (124, 64), (144, 19), BLUE, 1.2)
    ax.text(128, 68, "L_sky(ω) = L_black + L_e G", color=BLUE, ha="center")
    save(fig, "theory", "atmosphere_sensor", __file__)


def draw_round_earth():
    fig = plt.figure(figsize=(PAGE_WIDTH, 2.75))
    ax = fig.add_axes((0.0, 0.0, 0.4, 1.0))
    sketch(ax, 114, 98)
    ax.text(2, 92, "(a) the Sun of each place", fontsize=9)
    centre, earth = np.array([45.0, -70.0]), 100.0
    a = np.radians(np.linspace(28, 132, 80))
    for radius in (earth, 112, 124, 136):
        ax.plot(centre[0] + radius * np.cos(a), centre[1] + radius * np.sin(a), color=BLACK if radius == earth else GREY, lw=1.3 if radius == earth else 0.6)
    ax.fill_between(centre[0] + earth * np.cos(a), -8, centre[1] + earth * np.sin(a), color=PALE, lw=0)
    foot, view = centre + (0, earth), np.array([np.sin(np.radians(66)), np.cos(np.radians(66))])
    arrow(ax, foot, foot + 66 * view, BLUE, 1.4)
    sun = np.array([-np.sin(np.radians(78)), np.cos(np.radians(78))])
    for length in (2, 28, 54):
        place = foot + length * view
        up = (place - centre) / np.linalg.norm(place - centre)
        arrow(ax, place + 30 * sun, place, RED, 1.1)
        ax.plot(*zip(place, place + 15 * up), color=GREY, lw=0.9, ls=":")
    ax.text(14, 61, "sunlight", color=RED, ha="left", fontsize=8)
    ax.text(*(foot + 66 * view + (2, -10)), "line of\nsight", color=BLUE, ha="center", va="top", fontsize=8, linespacing=1.1)
    ax.text(foot[0] - 1.5, foot[1] + 10, "vertical", fontsize=7.5, color="#555555", ha="right")
    axes = [fig.add_axes((0.475, 0.18, 0.215, 0.68)), fig.add_axes((0.765, 0.18, 0.215, 0.68))]
    for sun_deg, colour, style in ((30, BLUE, "-"), (60, SKY, "--"), (80, BLACK, "-."), (88, RED, "-")):
        zenith, path, sky = (np.array(c) for c in columns("round_earth", "round", str(sun_deg)))
        for axis, ratio in zip(axes, (path, sky)):
            axis.plot(zenith, 100 * (ratio - 1), color=colour, ls=style, label=f"{sun_deg}°")
    for axis, title in zip(axes, ("(b) towards a sensor, %", "(c) sky at the ground, %")):
        axis.axhline(0, color=GREY, lw=0.6)
        axis.set_xlim(0, 80)
        axis.set_xticks([0, 20, 40, 60, 80])
        axis.set_xlabel("zenith angle, °")
        axis.set_title(title)
    axes[0].legend(title="Sun from the zenith", fontsize=7.5, title_fontsize=7.5, loc="best", handlelength=1.8, borderaxespad=0.2)
    save(fig, "theory", "atmosphere_round_earth", __file__)


if __name__ == "__main__":
    draw_gases()
    draw_scattering()
    draw_terms()
    draw_round_earth()

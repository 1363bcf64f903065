"""Figures of docs/theory/sensor.md: frames of a camera; footprints, wings and modulation."""

import numpy as np

from data import columns
from style import BLACK, BLUE, GREY, PAGE_WIDTH, PALE, PALER, RED, arrow, plt, save, sketch


def draw_frames():
    fig, axes = plt.subplots(1, 2, figsize=(PAGE_WIDTH, 2.75))
    fig.subplots_adjust(left=0.0, right=1.0, top=1.0, bottom=0.0, wspace=0.0)
    ax = axes[0]
    sketch(ax, 130, 100)
    ax.text(2, 95, "(a) orthographic: from above", fontsize=9)
    alpha = np.radians(20)
    g, w, h, centre = 11.0, 5, 4, np.array([66.0, 42.0])
    right, down = g * np.array([np.cos(alpha), -np.sin(alpha)]), g * np.array([-np.sin(alpha), -np.cos(alpha)])

    def ground(x, y):
        return centre + (x - w / 2) * right + (y - h / 2) * down

    for x in range(w + 1):
        ax.plot(*zip(ground(x, 0), ground(x, h)), color=GREY, lw=0.7)
    for y in range(h + 1):
        ax.plot(*zip(ground(0, y), ground(w, y)), color=GREY, lw=0.7)
    ax.fill(*zip(ground(3, 1), ground(4, 1), ground(4, 2), ground(3, 2)), color=PALE, zorder=0)
    ax.text(*ground(3.5, 1.5), "(3, 1)", ha="center", va="center", fontsize=7.5)
    arrow(ax, ground(0, 0), ground(0, 0) + 1.6 * right, RED, 1.6)
    arrow(ax, ground(0, 0), ground(0, 0) + 1.6 * down, RED, 1.6)
    ax.text(*(ground(0, 0) + 1.6 * right + (1, 2)), "x", color=RED)
    ax.text(*(ground(0, 0) + 1.6 * down + (-5, -2)), "y", color=RED)
    ax.plot(*centre, "+", color=BLACK, ms=8)
    ax.text(*(centre + (-2, -6.5)), "(x_c, y_c)", ha="right", fontsize=8, bbox={"fc": "white", "ec": "none", "pad": 0.6})
    corner = ground(w, 0)
    arrow(ax, corner, corner - 2.4 * down, BLUE, 1.2)
    arrow(ax, corner, corner + (0, 2.4 * g), BLACK, 1.2)
    ax.text(*(corner + (-1, 2.4 * g + 2)), "north", ha="center")
    ax.text(*(corner - 2.4 * down + (1, -6)), "up in\nthe image", color=BLUE, fontsize=8, linespacing=1.2)
    a = np.radians(np.linspace(70, 90, 12))
    ax.plot(corner[0] + 22 * np.cos(a), corner[1] + 22 * np.sin(a), color=BLACK, lw=0.9)
    ax.text(corner[0] + 3.2, corner[1] + 15.5, "α", ha="center")
    arrow(ax, ground(4, 4) + (0, -4), ground(5, 4) + (0, -4), style="<|-|>")
    ax.text(*(ground(4.5, 4) + (-3, -10)), "g", ha="center")
    arrow(ax, (8, 12), (24, 12))
    arrow(ax, (8, 12), (8, 28))
    ax.text(26, 10.5, "east")
    ax.text(5, 31, "north")

    ax = axes[1]
    sketch(ax, 130, 100)
    ax.text(2, 95, "(b) frame camera, focal plane drawn in front", fontsize=9)
    eye = np.array([16.0, 60.0])
    forward = np.array([1.0, -0.32]) / np.hypot(1, 0.32)
    rightward, downward = np.array([0.50, 0.46]), np.array([-0.10, -1.0])

    def plane(x, y, distance=40.0):
        return eye + distance * forward + (x * rightward + y * downward) * distance / 40.0

    corners = [plane(-20, -20), plane(20, -20), plane(20, 20), plane(-20, 20)]
    ax.fill(*zip(*corners), color=PALER, ec=BLACK, lw=0.9, zorder=0)
    for k in (-10, 0, 10):
        ax.plot(*zip(plane(k, -20), plane(k, 20)), color=GREY, lw=0.5)
        ax.plot(*zip(plane(-20, k), plane(20, k)), color=GREY, lw=0.5)
    ax.plot(*eye, "o", color=BLACK, ms=4)
    ax.text(eye[0] - 13, eye[1] + 4, "perspective\ncentre", fontsize=8, linespacing=1.2)
    arrow(ax, eye, eye + 105 * forward, BLACK, 1.1)
    ax.text(*(eye + 103 * forward + (-13, -7)), "forward")
    arrow(ax, plane(-20, -20), plane(-20, -20) + 18 * rightward, RED, 1.6)
    arrow(ax, plane(-20, -20), plane(-20, -20) + 18 * downward, RED, 1.6)
    ax.text(*(plane(-20, -20) + 18 * rightward + (-14, 3)), "right, x", color=RED)
    ax.text(*(plane(-20, -20) + 18 * downward + (-3, -6)), "down, y", color=RED, ha="right")
    arrow(ax, eye + (-1, -4), plane(0, 0) + (-1, -4), "#555555", 0.9, "<|-|>")
    ax.text(*(eye + 12 * forward + (-2, -11)), "f", ha="center")
    point = plane(10, -10)
    ray = point - eye
    arrow(ax, eye, eye + 2.35 * ray, BLUE, 1.4)
    ax.plot(*point, "o", color=BLUE, ms=3.5)
    ax.text(*(eye + 2.35 * ray + (-14, 4)), "d(x, y)", color=BLUE)
    ax.text(*(plane(0, 0) + (1, -11)), "(W/2, H/2)", fontsize=8, bbox={"fc": "white", "ec": "none", "pad": 0.6})
    ax.plot(*plane(0, 0), "+", color=BLACK, ms=7)
    save(fig, "theory", "sensor_frames", __file__)


def modulation(kind, nu):
    """Of the footprint of a whole pixel: optics times detector, as the page has them."""
    detector = np.sinc(nu)
    if kind == "gaussian":
        return detector * np.exp(-2 * (np.pi * 0.5 * nu) ** 2)
    if kind == "airy":
        s = np.clip(nu, 0, 1)
        return detector * 2 / np.pi * (np.arccos(s) - s * np.sqrt(1 - s * s))
    return detector


def draw_footprints():
    kinds = (("none", "no PSF", BLACK, "-"), ("gaussian", "Gaussian, σ = 0.5 px", BLUE, "--"), ("airy", "Airy, q = 1 px", RED, "-."))
    fig, axes = plt.subplots(1, 3, figsize=(PAGE_WIDTH, 2.6))
    fig.subplots_adjust(left=0.08, right=0.985, top=0.9, bottom=0.19, wspace=0.42)
    for kind, text, colour, style in kinds:
        x, h = columns("footprint", "h", kind)
        axes[0].plot(x, h, color=colour, ls=style, label=text)
        nu = np.linspace(0, 1.5, 200)
        axes[2].plot(nu, modulation(kind, nu), color=colour, ls=style)
    axes[0].set_xlim(-4.2, 4.2)
    axes[0].set_ylim(0, 1.75)
    axes[0].set_xlabel("Δx, px (Δy = 0)")
    axes[0].set_ylabel("h, px⁻²")
    axes[0].set_title("(a) footprint")
    axes[0].legend(loc="upper left", fontsize=7.4, handlelength=2.1, borderaxespad=0)

    r, core, wings = (np.array(c) for c in columns("footprint", "airy"))
    ax = axes[1]
    ax.loglog(r[core > 0], core[core > 0], color=RED, label="core, 95 %")
    ax.loglog(r[wings > 0], wings[wings > 0], color=BLACK, ls="--", label="wings")
    ax.loglog(r[r > 2], 1 / (np.pi**3 * r[r > 2] ** 3), color=GREY, lw=0.9, ls=":", label="q/(π³ r³)")
    ax.set_xlim(0.05, 200)
    ax.set_ylim(1e-9, 3)
    ax.set_xticks([0.1, 1, 10, 100], ["0.1", "1", "10", "100"])
    for edge in (8, 32, 128):  # out to which cells of half a pixel, 4 px and 16 px lie
        ax.axvline(edge, ymax=0.45, color=GREY, lw=0.6)
    ax.set_xlabel("r, px")
    ax.set_ylabel("density, px⁻²", labelpad=1)
    ax.set_title("(b) Airy, q = 1 px")
    ax.legend(loc="upper right", fontsize=7.4, handlelength=1.8, borderaxespad=0)
    axes[2].axhline(0, color=GREY, lw=0.6)
    axes[2].set_xlim(0, 1.5)
    axes[2].set_ylim(-0.25, 1.02)
    axes[2].set_xlabel("ν, cycles per px")
    axes[2].set_ylabel("modulation", labelpad=1)
    axes[2].set_title("(c) modulation")
    save(fig, "theory", "sensor_footprint", __file__)


if __name__ == "__main__":
    draw_frames()
    draw_footprints()

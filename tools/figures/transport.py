"""Figures of docs/theory/transport.md: light that is sought at a surface; mirrors and glints."""

import numpy as np
from matplotlib.patches import Circle

from style import BLACK, BLUE, GREY, PAGE_WIDTH, PALE, RED, angle_arc, arrow, plt, save, sketch


def draw_sought():
    """One surface of a path: what is added there, and where the path goes on."""
    fig = plt.figure(figsize=(PAGE_WIDTH, 3.0))
    ax = fig.add_axes((0, 0, 1, 1))
    sketch(ax, 288, 120)
    ground, x = 14.0, np.array([132.0, 14.0])
    ax.fill_between([0, 288], 0, ground, color=PALE, lw=0)
    ax.text(*(x + (0, -9)), "x: emission β ε B(T)", ha="center", fontsize=8.5)
    sensor = np.array([148.0, 112.0])
    ax.plot(*zip(sensor, x), color=BLACK, lw=1.6)
    arrow(ax, sensor, (sensor + 0.55 * (x - sensor)), BLACK, 1.6)
    ax.text(*(sensor + (4, -3)), "from the camera, β = 1")
    ax.add_patch(Circle(x, 1.6, fc=BLACK, zorder=5))
    # The Sun's disc.
    sun, towards = np.array([40.0, 104.0]), np.array([42.0, 99.0])
    ax.add_patch(Circle(sun, 9, fc="#f4c542", ec=BLACK, lw=0.7))
    arrow(ax, x, towards, RED, 1.5)
    ax.text(60, 96, "a point of the disc:\nβ ρ f w E if free", color=RED, fontsize=8, linespacing=1.3)
    # An emitter.
    lamp = np.array([[196.0, 70.0], [214.0, 78.0]])
    ax.plot(*lamp.T, color=RED, lw=5, solid_capstyle="butt")
    arrow(ax, x, lamp.mean(axis=0) - (1.5, 1.2), RED, 1.5)
    ax.text(178, 88, "emitter, density p_L:\nβ ρ f |n·ω| ε B / p_L", color=RED, fontsize=8, linespacing=1.3, ha="left", va="bottom")
    # By way of a flat mirror: the receiver behind it.
    mirror_x, tip = 240.0, lamp.mean(axis=0)
    ax.plot([mirror_x, mirror_x], [16, 62], color=BLUE, lw=3)
    for y in np.arange(18, 62, 5):
        ax.plot([mirror_x, mirror_x + 3], [y, y + 3], color=BLUE, lw=0.6)
    image = np.array([2 * mirror_x - x[0], x[1]])
    share = (mirror_x - tip[0]) / (image[0] - tip[0])
    bounce = tip + share * (image - tip)
    arrow(ax, x, bounce, BLUE, 1.3)
    arrow(ax, bounce, tip + (3, -3), BLUE, 1.3)
    clip = bounce + 0.22 * (image - bounce)
    ax.plot(*zip(bounce, clip), color=BLUE, lw=0.9, ls="--")
    ax.text(*(clip + (-1, -8)), "to x′", color=BLUE, fontsize=8)
    ax.text(245, 62, "mirror: x′ = x\n− 2 (n·x − h) n", color=BLUE, fontsize=7.6, ha="left", linespacing=1.3)
    # Continuation.
    on = x + 62 * np.array([-np.cos(np.radians(20)), np.sin(np.radians(20))])
    arrow(ax, x, on, BLACK, 1.3, ls="--")
    ax.text(*(on + (-3, 2)), "goes on in ω′, density p_B:\nβ ← β ρ f |n·ω′| / p_B", ha="right", fontsize=8, linespacing=1.3, va="center")
    # The lobe from which it is drawn, a cosine's.
    a = np.linspace(0, np.pi, 60)
    r = 26 * np.sin(a)
    ax.plot(x[0] + r * np.cos(a), x[1] + r * np.sin(a), color=GREY, lw=0.9)
    arrow(ax, x, x + (0, 34), GREY, 0.8)
    ax.text(*(x + (-5, 31)), "n", color="#555555")
    save(fig, "theory", "transport_sought", __file__)


def draw_round_mirror(ax):
    sketch(ax, 120, 120)
    ax.text(2, 113, "(a) the one way by a ball", fontsize=9)
    centre, radius = np.array([32.0, 34.0]), 24.0
    ax.add_patch(Circle(centre, radius, fc=PALE, ec=BLACK, lw=1.0))
    ax.plot(*centre, "+", color=BLACK, ms=6)
    to_x, gamma = np.radians(12), np.radians(78)
    d = 80.0
    x = centre + d * np.array([np.cos(to_x), np.sin(to_x)])
    # Newton's method of the page: incidence gamma - phi, exitance atan2(d sin phi, d cos phi - R).
    phi = 0.3
    for _ in range(30):
        g = (gamma - phi) - np.arctan2(d * np.sin(phi), d * np.cos(phi) - radius)
        h = 1e-6
        slope = ((gamma - phi - h) - np.arctan2(d * np.sin(phi + h), d * np.cos(phi + h) - radius) - g) / h
        phi -= g / slope
    n = np.array([np.cos(to_x + phi), np.sin(to_x + phi)])
    at = centre + radius * n
    s = np.array([np.cos(to_x + gamma), np.sin(to_x + gamma)])
    arrow(ax, at + 56 * s, at, RED, 1.4)
    arrow(ax, at, x, RED, 1.4)
    ax.text(*(at + 50 * s + (3, 0)), "from the Sun", color=RED, fontsize=8)
    ax.plot(*x, "o", color=BLACK, ms=4)
    ax.text(*(x + (-1, 4)), "x")
    ax.plot(*zip(centre, x), color=GREY, lw=0.8, ls=":")
    ax.plot(*zip(centre, centre + 34 * s), color=GREY, lw=0.8, ls=":")
    ax.text(*(centre + 34 * s + (-6, 0)), "s", color="#555555")
    ax.plot(*zip(centre, at + 24 * n), color=BLACK, lw=0.9)
    ax.text(*(at + 25 * n + (0, 1)), "n")
    t, p, g = np.degrees(to_x), np.degrees(to_x + phi), np.degrees(to_x + gamma)
    angle_arc(ax, tuple(centre), 11, t, p, "φ", text_radius=15)
    angle_arc(ax, tuple(centre), 19, t, g, "")
    ax.text(*(centre + 15.5 * np.array([np.cos(np.radians(72)), np.sin(np.radians(72))])), "γ", ha="center", va="center", fontsize=8)
    angle_arc(ax, tuple(at), 15, p, g, "", colour=RED)
    out = np.degrees(np.arctan2(*(x - at)[::-1]))
    angle_arc(ax, tuple(at), 15, out, p, "", colour=RED)
    for middle in ((p + g) / 2, (p + out) / 2):
        ax.text(*(at + 19 * np.array([np.cos(np.radians(middle)), np.sin(np.radians(middle))])), "θ", color=RED, ha="center", va="center", fontsize=8)
    ax.text(*((at + x) / 2 + (0, 3)), "L", color=RED)
    ax.plot(*zip(centre, centre + (0, -radius)), color=BLACK, lw=0.8)
    ax.text(*(centre + (2, -radius / 2 - 2)), "R", fontsize=8)
    ax.text(*(centre + 0.62 * (x - centre) + (1, -6)), "d", fontsize=8, color="#555555")


def draw_images(ax):
    sketch(ax, 120, 120)
    ax.text(2, 113, "(b) the Sun's image in a flat mirror", fontsize=9)
    ax.fill_between([0, 120], 0, 12, color=PALE, lw=0)
    x = np.array([58.0, 12.0])
    ax.plot(*x, "o", color=BLACK, ms=4)
    ax.text(55, 3.5, "x", va="center")
    s = np.array([-np.cos(np.radians(50)), np.sin(np.radians(50))])
    arrow(ax, x + 77 * s, x, RED, 1.3)
    ax.text(*(x + 60 * s + (-3, -6)), "s", color=RED, ha="right")
    ax.add_patch(Circle(x + 80 * s, 3.0, fc="#f4c542", ec=BLACK, lw=0.7))
    ax.text(54, 62, "ray to a point of the image:\nmirrors only, then the Sun", fontsize=7.6, ha="center", linespacing=1.25)
    wall = 100.0
    ax.plot([wall, wall], [24, 76], color=BLUE, lw=3)
    arrow(ax, (wall, 31), (wall - 13, 31), BLUE)
    ax.text(wall - 11, 23, "n₁", color=BLUE, ha="center")
    image = np.array([-s[0], s[1]])
    hit = x + image * (wall - x[0]) / image[0]
    arrow(ax, hit + 42 * s, hit, RED, 1.0)
    arrow(ax, hit, x, RED, 1.0)
    ax.plot(*zip(hit, hit + 19 * image), color=RED, lw=0.8, ls="--")
    ax.add_patch(Circle(hit + 22 * image, 3.0, fc="none", ec=RED, lw=0.9, ls="--"))
    ax.text(*(hit + 22 * image + (-9, 5)), "R₁ s", color=RED, ha="center")


def draw_glint(ax):
    sketch(ax, 120, 120)
    ax.text(2, 113, "(c) a glint, and how it is searched", fontsize=9)
    centre, radius = np.array([58.0, 54.0]), 34.0
    ax.add_patch(Circle(centre, radius, fc=PALE, ec=BLACK, lw=1.0))
    # Triangles of two parameters: kept ones are divided further.
    spot = centre + (9, 10)

    def divide(a, b, c, depth):
        middle = (a + b + c) / 3
        size = np.hypot(*(a - b))
        near = np.hypot(*(middle - spot)) < 0.9 * size
        ax.plot(*zip(a, b, c, a), color=GREY if not near else BLUE, lw=0.5 if not near else 0.8)
        if near and depth < 4:
            ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
            for corner in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)):
                divide(*corner, depth + 1)

    angle = np.radians(np.arange(6) * 60 + 90)
    ring = [centre + 33 * np.array([np.cos(v), np.sin(v)]) for v in angle]
    for k in range(6):
        divide(centre, ring[k], ring[(k + 1) % 6], 0)
    ax.add_patch(Circle(spot, 1.8, fc=RED, ec="none", zorder=6))
    ax.annotate("the Sun's disc:\nρ E R²/4 in all", spot + (1.5, 1.5), (94, 94), color=RED, fontsize=8, ha="center", linespacing=1.2,
                arrowprops={"arrowstyle": "-", "color": RED, "lw": 0.8})
    ax.text(60, 2.5, "blue: corners between which light\nof the disc's directions may come", fontsize=7.6, ha="center", va="bottom", linespacing=1.2)


def draw_mirrors():
    fig, axes = plt.subplots(1, 3, figsize=(PAGE_WIDTH, 2.45))
    fig.subplots_adjust(left=0.0, right=1.0, top=1.0, bottom=0.0, wspace=0.01)
    for ax, draw in zip(axes, (draw_round_mirror, draw_images, draw_glint)):
        draw(ax)
    save(fig, "theory", "transport_mirrors", __file__)


if __name__ == "__main__":
    draw_sought()
    draw_mirrors()

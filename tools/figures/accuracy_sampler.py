"""Figures of docs/theory/accuracy_sampler.md: the rays of a small picture; brackets, chords and junctions."""

import numpy as np
from matplotlib.patches import Circle, Polygon

from data import lines
from style import BLACK, BLUE, GREY, PAGE_WIDTH, PALE, RED, angle_arc, arrow, dots, plt, save, sketch

LATTICE = 3  # vertices to a pixel's side


def scenery(ax):
    """The picture of sampling_data.cpp."""
    ax.add_patch(Polygon([(0, 2.48), (3, 1.97), (3, 2.11), (0, 2.62)], fc="#e3d9c3", zorder=0))
    ax.add_patch(Circle((1.45, 1.4), 0.78, fc="#d3e2f0", zorder=0))
    ax.add_patch(Polygon([(1.62, 0), (3, 0), (3, 1.28 + 0.12 * 1.38), (1.62, 1.28)], fc="#b9b9b9", zorder=0))
    ax.set_xlim(0, 3)
    ax.set_ylim(3, 0)
    ax.set_aspect("equal")
    for k in range(4):
        ax.axhline(k, color="#555555", lw=0.8, zorder=1, clip_on=False)
        ax.axvline(k, color="#555555", lw=0.8, zorder=1, clip_on=False)
    ax.set_xticks(range(4))
    ax.set_yticks(range(4))
    ax.set_xlabel("x, px")
    for spine in ax.spines.values():
        spine.set_visible(False)


def on_lattice(value, steps=LATTICE):
    return abs(value * steps - round(value * steps)) < 1e-6


def points():
    asked = [(line[0], int(line[1]), float(line[2]), float(line[3])) for line in lines("sampler") if line[0] in ("label", "value")]
    inside = [a for a in asked if -1e-9 <= a[2] <= 3 + 1e-9 and -1e-9 <= a[3] <= 3 + 1e-9]
    vertices = [(x, y) for kind, batch, x, y in inside if batch == 0]
    labels = [(x, y) for kind, batch, x, y in inside if batch > 0 and kind == "label"]
    # Crossings lie on sides of the lattice or of cells that were split from it; what else is asked for lies anywhere.
    brackets = [p for p in labels if on_lattice(p[0], LATTICE * 64) or on_lattice(p[1], LATTICE * 64)]
    others = [p for p in labels if p not in set(brackets)]
    values = [(x, y) for kind, batch, x, y in inside if batch > 0 and kind == "value"]
    return vertices, brackets, others, values


def draw_points():
    vertices, brackets, others, values = points()
    fig, axes = plt.subplots(1, 2, figsize=(PAGE_WIDTH, 4.05))
    fig.subplots_adjust(left=0.055, right=0.985, top=0.93, bottom=0.2, wspace=0.1)
    for ax in axes:
        scenery(ax)
    axes[0].set_ylabel("y, px", labelpad=2)
    axes[0].plot(*zip(*vertices), "o", ms=3.6, mew=0.7, color=BLACK, mfc="white", clip_on=False, zorder=4)
    dots(axes[0], brackets, 2.0, RED)
    dots(axes[0], others, 2.0, BLUE)
    dots(axes[1], values, 1.8, BLUE)
    axes[0].set_title(f"(a) labels: {len(vertices) + len(brackets) + len(others):,} rays")
    axes[1].set_title(f"(b) values: {len(values):,} paths")
    keys = [axes[0].plot([], [], "o", ms=3.6, mew=0.7, color=BLACK, mfc="white")[0], axes[0].plot([], [], "o", ms=2.6, color=RED, mew=0)[0],
            axes[0].plot([], [], "o", ms=2.6, color=BLUE, mew=0)[0]]
    fig.legend(keys, ["vertices of the lattice (k = 3)", "crossings on sides of cells", "looks, confirmations, probes"], ncol=3, loc="lower left",
               bbox_to_anchor=(0.04, 0.0), handletextpad=0.4, columnspacing=1.6)
    save(fig, "theory", "accuracy_sampler_points", __file__)


def draw_crossing(ax):
    sketch(ax, 100, 100)
    y, left, right, tau, phase = 52.0, 12.0, 76.0, 21.0, 0.35
    ax.text(4, 97, "(a) crossing in its bracket", fontsize=9)
    ax.plot([left, right], [y, y], color=BLACK, lw=1.6)
    ax.plot([left, right], [y, y], "o", color=BLACK, mfc="white", ms=5)
    ax.text(left, y + 7, "A", ha="center", weight="bold")
    ax.text(right + 3.5, y + 7.5, "B", ha="center", weight="bold")
    grid = [left + (j - 1 + phase) * tau for j in range(0, 6)]
    ax.plot([left - 8, left], [y, y], color=GREY, lw=1, ls=":")
    ax.plot([right, right + 12], [y, y], color=GREY, lw=1, ls=":")
    for x in grid[:5]:
        ax.plot([x, x], [y - 3, y + 3], color=RED if left < x < right else GREY, lw=1.2)
    # The border crosses near the right end: its bracket reaches beyond it.
    low, high = grid[3], grid[4]
    ax.add_patch(Polygon([(low, y - 6), (high, y - 6), (high, y + 6), (low, y + 6)], fc=PALE, ec="none", zorder=0))
    cross = low + 0.3 * tau
    ax.plot([cross - 2, cross + 3], [y - 26, y + 31], color=BLUE, lw=1.8)
    ax.text(cross, y + 29, "border", color=BLUE, ha="right")
    ax.plot([(low + high) / 2] * 2, [y - 12, y + 8], color=BLACK, lw=0.9, ls="--")
    ax.text((low + high) / 2 + 2, y - 14, "middle", ha="left", fontsize=8)
    arrow(ax, (grid[2], y - 13), (grid[3], y - 13), style="<|-|>")
    ax.text((grid[2] + grid[3]) / 2, y - 20, "τ", ha="center")
    arrow(ax, (left, y - 13), (grid[1], y - 13), style="<|-|>")
    ax.text((left + grid[1]) / 2, y - 20, "φτ", ha="center")
    arrow(ax, (right, y + 17), (high, y + 17), style="<|-|>")
    ax.text((right + high) / 2 + 0.3, y + 20, "e", ha="center")
    ax.text(50, 10, "red: where labels may be asked;\nbeyond the ends they are known", ha="center", fontsize=8, linespacing=1.3)


def draw_curve(ax):
    sketch(ax, 100, 100)
    ax.text(4, 97, "(b) curve in its cell", fontsize=9)
    ax.add_patch(Polygon([(15, 20), (85, 20), (85, 90), (15, 90)], fc="none", ec=BLACK, lw=1.2))
    for x, y in ((15, 20), (85, 20), (85, 90), (15, 90)):
        ax.plot(x, y, "o", color=BLACK, mfc="white", ms=5)
    centre, radius = np.array([38.0, 3.0]), 64.0
    a = np.radians(np.linspace(36, 122, 80))
    ax.plot(centre[0] + radius * np.cos(a), centre[1] + radius * np.sin(a), color=BLUE, lw=1.8)
    first = np.array([15.0, centre[1] + np.sqrt(radius**2 - (15 - centre[0]) ** 2)])
    last = np.array([85.0, centre[1] + np.sqrt(radius**2 - (85 - centre[0]) ** 2)])
    ax.plot(*zip(first, last), color=BLACK, lw=1.1)
    for p in (first, last):
        ax.plot(*p, "s", color=RED, ms=5)
    chord = last - first
    middle, normal = (first + last) / 2, np.array([-chord[1], chord[0]]) / np.hypot(*chord)
    # Where the arc passes over the middle of the chord.
    along = np.dot(middle - centre, normal)
    s = np.sqrt(radius**2 - np.dot(middle - centre, middle - centre) + along**2) - along
    arrow(ax, middle, middle + s * normal, RED, style="<|-|>")
    ax.text(*(middle + 0.45 * s * normal + (3, -1.5)), "s", color=RED)
    for sign in (-1, 1):
        ax.plot(*(middle + (s + sign * 5) * normal), "o", color=BLUE, ms=4.5, mfc="white", mew=1.2)
    ax.text(*(middle + (s + 5) * normal + (3, 0.5)), "s + δ", fontsize=8)
    ax.text(*(middle + (s - 5) * normal + (-4, -2)), "s − δ", fontsize=8, ha="right")
    ax.text(*(first + 0.24 * chord + (-1, -8)), "c", ha="center")
    ax.text(24, 28, "A", weight="bold")
    ax.text(75, 80, "B", weight="bold")
    tangent = np.array([-(last - centre)[1], (last - centre)[0]]) / radius
    ax.plot(*zip(last + 14 * tangent, last - 14 * tangent), color=GREY, lw=0.9, ls="--")
    angle_arc(ax, tuple(last), 9, 90, np.degrees(np.arctan2(*tangent[::-1])), "")
    ax.text(78.6, 64.5, "α", fontsize=9)
    ax.text(50, 6, "squares: crossings, by which s is\npredicted with those beyond", ha="center", fontsize=8, linespacing=1.3)


def draw_junction(ax):
    sketch(ax, 100, 100)
    ax.text(4, 97, "(c) junction", fontsize=9)
    ax.add_patch(Polygon([(15, 20), (85, 20), (85, 90), (15, 90)], fc="none", ec=BLACK, lw=1.2))
    for x, y in ((15, 20), (85, 20), (85, 90), (15, 90)):
        ax.plot(x, y, "o", color=BLACK, mfc="white", ms=5)
    crossings = [np.array(p) for p in ((15.0, 62.0), (57.0, 20.0), (85.0, 70.0))]
    point = np.array([50.0, 56.0])
    for p, name, shift in zip(crossings, ("P₁", "P₂", "P₃"), ((-10, -1), (3, 4), (3, -1))):
        ax.plot(*zip(p, point), color=BLUE, lw=1.8)
        ax.plot(*p, "s", color=RED, ms=5)
        ax.text(*(p + shift), name)
    for k in range(3):
        a, b = (crossings[k] - point), (crossings[(k + 1) % 3] - point)
        way = a / np.hypot(*a) + b / np.hypot(*b)
        if np.hypot(*way) < 0.9 or way @ (np.array([50, 100.0]) - point) > 0 and k == 2:
            way = np.array([-0.1, 1.0])
        way = way / np.hypot(*way)
        ax.plot(*(point + 8 * way), "o", color=BLUE, ms=4.5, mfc="white", mew=1.2)
    arrow(ax, point, (71, 50), RED)
    ax.text(72.5, 45.5, "e", color=RED)
    ax.text(24, 32, "A", weight="bold")
    ax.text(75, 32, "B", weight="bold")
    ax.text(47, 79, "C", weight="bold")
    ax.text(50, 6, "circles: three rays at δ from the borders\nconfirm where they meet", ha="center", fontsize=8, linespacing=1.3)


def draw_models():
    fig, axes = plt.subplots(1, 3, figsize=(PAGE_WIDTH, 2.65))
    fig.subplots_adjust(left=0.01, right=0.99, top=0.92, bottom=0.0, wspace=0.04)
    for ax, draw in zip(axes, (draw_crossing, draw_curve, draw_junction)):
        draw(ax)
    save(fig, "theory", "accuracy_sampler_models", __file__)


if __name__ == "__main__":
    draw_points()
    draw_models()

"""How the figures of docs/ look, and how they are written: SVG whose text is text, the same bytes at every run."""

import os
import pathlib
import re

os.environ.setdefault("SOURCE_DATE_EPOCH", "0")
import matplotlib  # noqa: E402

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE_WIDTH = 7.2  # inches

# Apart in greyscale, too, and for those who see colours differently (after Okabe and Ito): from dark to light.
BLACK, BLUE, RED, ORANGE, SKY, GREY = "#000000", "#0b4f8a", "#c4451c", "#e69f00", "#6bb5e8", "#8c8c8c"
PALE, PALER = "#dfe6ee", "#f2f5f8"

plt.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "ifov", "font.family": "DejaVu Sans", "mathtext.fontset": "dejavusans",
    "font.size": 8.5, "axes.titlesize": 9, "axes.labelsize": 8.5, "xtick.labelsize": 8, "ytick.labelsize": 8,
    "legend.fontsize": 8, "legend.frameon": False, "axes.linewidth": 0.7, "lines.linewidth": 1.3,
    "axes.spines.top": False, "axes.spines.right": False, "axes.titlelocation": "left", "axes.edgecolor": "#333333",
    "xtick.direction": "out", "ytick.direction": "out", "axes.grid": False, "figure.dpi": 100,
    "path.simplify": True, "path.simplify_threshold": 0.3,
})


def sketch(ax, width, height):
    """An area for a drawing: equal units, x from 0 to width, y from 0 to height, no axes."""
    ax.set_xlim(0, width)
    ax.set_ylim(0, height)
    ax.set_aspect("equal")
    ax.axis("off")


def arrow(ax, start, end, colour=BLACK, width=1.1, style="-|>", **more):
    """From start to end; the tip is at the end."""
    ax.annotate("", end, start, arrowprops={"arrowstyle": style, "color": colour, "lw": width, "shrinkA": 0, "shrinkB": 0,
                                            "mutation_scale": 8, **more})


def angle_arc(ax, centre, radius, first_deg, last_deg, text="", colour=BLACK, text_radius=None, style="-"):
    """The arc of an angle, counter-clockwise, with its symbol in the middle."""
    import numpy as np
    a = np.radians(np.linspace(first_deg, last_deg, 24))
    ax.plot(centre[0] + radius * np.cos(a), centre[1] + radius * np.sin(a), color=colour, lw=0.8, ls=style)
    middle, r = np.radians((first_deg + last_deg) / 2), text_radius or radius * 1.35
    ax.text(centre[0] + r * np.cos(middle), centre[1] + r * np.sin(middle), text, ha="center", va="center", color=colour)


def dots(ax, points, diameter, colour):
    """Many points of one colour, 13 bytes each; diameter in points (1/72 inch)."""
    fig = ax.figure
    kept = fig.__dict__.setdefault("ifov_dots", [])
    gid = f"dots_{len(kept)}"
    ax.plot([p[0] for p in points[:2]], [p[1] for p in points[:2]], gid=gid, lw=0)  # whose place in the file they take
    kept.append((gid, ax, points, diameter, colour))


def dots_path(ax, points, diameter, colour):
    height = ax.figure.get_figheight() * 72
    places = [(72 * x / ax.figure.dpi, height - 72 * y / ax.figure.dpi) for x, y in ax.transData.transform(points)]
    d = "".join(f"M{x:.1f} {y:.1f}h0" for x, y in places)
    return f'<path d="{d}" style="fill: none; stroke: {colour}; stroke-width: {diameter}; stroke-linecap: round"/>'


def with_indices(element):
    """The text of an element with E_{sun} as E and a lowered "sun", x^{2} as x and a raised 2."""
    open_tag, text, close_tag = element.group(1, 2, 3)
    parts = re.split(r"([_^]\{[^}]*\})", text)
    for k in range(1, len(parts), 2):
        down, back = ("0.3em", "-0.21em") if parts[k][0] == "_" else ("-0.5em", "0.35em")
        parts[k] = f'<tspan dy="{down}" style="font-size: 70%">{parts[k][2:-1]}</tspan>'
        if parts[k + 1]:
            parts[k + 1] = f'<tspan dy="{back}">{parts[k + 1]}</tspan>'
    return open_tag.replace("<text", '<text xml:space="preserve"') + "".join(parts) + close_tag


def save(fig, folder, name, script):
    """Writes docs/<folder>/figures/<name>.svg, or $FIGURES/<folder>/figures/<name>.svg, which says what drew it."""
    path = pathlib.Path(os.environ.get("FIGURES", ROOT / "docs")) / folder / "figures" / f"{name}.svg"
    path.parent.mkdir(parents=True, exist_ok=True)
    fig.savefig(path, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    text = path.read_text()
    for gid, ax, points, diameter, colour in fig.__dict__.get("ifov_dots", []):
        path_of_dots = dots_path(ax, points, diameter, colour)
        text = re.sub(rf'<g id="{gid}">.*?</g>', lambda _, made=path_of_dots, name=gid: f'<g id="{name}">{made}</g>', text, count=1, flags=re.DOTALL)
    plt.close(fig)
    text = re.sub(r"<metadata>.*?</metadata>\n?", "", text, flags=re.DOTALL)
    text = re.sub(r"<\?xml.*?\?>\n<!DOCTYPE.*?>\n", "", text, flags=re.DOTALL)
    text = re.sub(r"(<svg [^>]*>)", rf"\1\n <!-- drawn by tools/figures/{pathlib.Path(script).name} -->", text, count=1)
    text = re.sub(r"(<text [^>]*>)([^<]*[_^]\{[^<]*)(</text>)", with_indices, text)
    # Hundredths of a point are enough; numbers that are text stay.
    text = re.sub(r"<[^>]*>", lambda tag: re.sub(r"(\d\.\d{2})\d+", r"\1", tag.group()), text)
    path.write_text("\n".join(line.rstrip() for line in text.splitlines()) + "\n")
    print(f"{path}: {path.stat().st_size / 1000:.0f} kB")

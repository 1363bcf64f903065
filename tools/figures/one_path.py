"""What becomes of one path, from a point of the focal plane to a product (docs/developer/one_path.md)."""

from matplotlib.patches import FancyBboxPatch

from style import BLUE, GREY, PALE, PALER, PAGE_WIDTH, arrow, plt, save, sketch

# Step, what it is, class that does it -> what it leaves, file.
STEPS = [
    ("sampling", "points of the focal plane", "(x, y), path number", "TileWork  →  PathRequest", "sampling/field.h"),
    ("render", "batch", "up to 512 paths, in order", "SceneField", "render/field/scene_field.cpp"),
    ("sensor", "rays", "o + t d", "Camera  →  Ray", "sensor/camera.h"),
    ("geometry", "nearest hits", "position, normals, material number", "World  →  SurfacePoint", "geometry/world.h"),
    ("scene", "what the surface is there", "materials and their shares, T, n′", "Scene  →  ResolvedSurface", "scene/scene.cpp"),
    ("transport", "what it does with light", "ρ(λ) s(ω, ω′), or f(λ, ω, ω′)", "SurfaceLobe, BsdfEvent", "transport/surface_lobe.h"),
    ("transport", "light that is sought", "Sun, emitters, both by way of mirrors", "PathTracer, Emitters, SunMirrors", "transport/path_tracer.cpp"),
    ("transport", "where the path goes on", "ω′ drawn, density p; roulette", "Bsdf", "materials/bsdf/bsdf.h"),
    ("transport", "record", "what was met, without a spectrum", "PathRecord  of  PathVertex", "transport/path_record.h"),
    ("transport", "the spectrum", "L = Σ β (ε B + ρ f w E + …) + β L_sky", "PathLight, SpectralScene", "transport/path_light.cpp"),
    ("transport", "the air before it", "L ← τ L + L_path", "ViewAtmosphere, ViewTable", "transport/view_atmosphere.cpp"),
    ("radiometry", "channels", "L_c = Σ w_i L_i over nodes i", "SpectralNodes", "radiometry/spectral_nodes.h"),
    ("sampling", "moments by stratum", "mean, variance of 2 × 2 blocks", "Radiance, BlockSums", "sampling/accuracy/radiance/radiance.h"),
    ("sampling", "half-width against the limit", "H = √(z² V_g + t² V_p)", "TileWork, AccuracyTolerance", "sampling/accuracy/tile_work.h"),
    ("render", "the tile", "widened by air, nodes, cut, unseen light", "TileResult", "render/image_renderer.cpp"),
    ("io", "products", "cubes by quantity", "TileSink  →  ProductWriter", "io/products/product_writer.h"),
]
STEP, HEIGHT, LEFT, RIGHT = 10.0, 7.0, 40.0, 100.0


def middle(k):
    return (len(STEPS) - k - 0.5) * STEP


def draw():
    total = len(STEPS) * STEP
    fig = plt.figure(figsize=(PAGE_WIDTH, PAGE_WIDTH * (total + 4) / 172))
    ax = fig.add_axes((0, 0, 1, 1))
    sketch(ax, 172, total + 4)
    for k, (room, what, symbols, classes, file) in enumerate(STEPS):
        y = middle(k)
        ax.add_patch(FancyBboxPatch((LEFT, y - HEIGHT / 2), RIGHT - LEFT, HEIGHT, boxstyle="round,pad=0,rounding_size=1.2",
                                    fc=PALE if room == "transport" else PALER, ec="#333333", lw=0.7))
        ax.text((LEFT + RIGHT) / 2, y + (1.4 if symbols else 0), what, ha="center", va="center", fontsize=8.5, weight="bold")
        if symbols:
            ax.text((LEFT + RIGHT) / 2, y - 1.9, symbols, ha="center", va="center", fontsize=7.6)
        ax.text(RIGHT + 4, y + 1.4, classes, va="center", fontsize=8.2)
        ax.text(RIGHT + 4, y - 1.9, file, va="center", fontsize=7.4, color="#555555", family="DejaVu Sans Mono")
        if k + 1 < len(STEPS) and k != 7:
            arrow(ax, ((LEFT + RIGHT) / 2, y - HEIGHT / 2), ((LEFT + RIGHT) / 2, y - STEP + HEIGHT / 2))

    # The path goes on: from its continuation back to the next hit; or it leaves.
    x = LEFT - 7
    ax.plot([LEFT, x, x], [middle(7), middle(7), middle(3)], color=BLUE, lw=1.3)
    arrow(ax, (x, middle(3)), (LEFT, middle(3)), BLUE, 1.3)
    ax.text(x - 1.5, middle(5), "next surface,\nβ ← β ρ f |n·ω′| / p", rotation=90, ha="right", va="center", fontsize=8, color=BLUE, linespacing=1.3)
    arrow(ax, ((LEFT + RIGHT) / 2, middle(7) - HEIGHT / 2), ((LEFT + RIGHT) / 2, middle(8) + HEIGHT / 2))
    ax.text((LEFT + RIGHT) / 2 + 1.5, middle(7.5), "ended, or left for the sky", fontsize=7.4, va="center", color="#555555")

    # The sampler's rounds.
    x = 4.0
    ax.plot([LEFT, x, x], [middle(13), middle(13), middle(0)], color=BLUE, lw=1.3, ls="--")
    arrow(ax, (x, middle(0)), (LEFT, middle(0)), BLUE, 1.3, ls="--")
    ax.text(x + 1.5, middle(10.6), "not within the limit:\nmore points where they\nlower H most", va="center", fontsize=8, color=BLUE, linespacing=1.3)
    ax.text(RIGHT + 4, total + 1.2, "who  →  what is handed on;  file under src/", fontsize=8, va="center", color="#555555")
    ax.plot([7, 168], [middle(8.5)] * 2, color=GREY, lw=0.8, ls=":")
    ax.text(7, middle(8.5) + 1.2, "above: rays and chance,\n512 paths together", va="bottom", fontsize=7.4, color="#555555")
    ax.text(7, middle(8.5) - 1.4, "below: spectra,\none path after the other", va="top", fontsize=7.4, color="#555555")
    save(fig, "developer", "one_path", __file__)


if __name__ == "__main__":
    draw()

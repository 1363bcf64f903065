"""Rays of a run that is taken from twice an error to it, over those of a run that is at it from the start."""

import random
import subprocess

from drivers.figures import ROOT, at_least, at_most, not_measured, run_json

DOCUMENT = """{"ifov": 1, "scene": {"materials": {"ground": {"emissivity": 1, "temperature": "20 degC"},
    "target": {"emissivity": 1, "temperature": "40 degC"}}, "objects": [{"plane": {}, "material": "ground"}, %s]},
  "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [60, 60]}},
    "channels": [{"name": "thermal", "monochromatic": {"at": "8.5 um"}}]},
  "sampling": {"accuracy": {"error": "0.1 K"}}}"""


def targets(shape):
    """One in the middle of each 3 x 3 pixels, as in the thermal study, which renders them one by one."""
    draw = random.Random(5)
    objects = []
    for x in range(-27, 30, 3):
        for y in range(-27, 30, 3):
            at = (x + 0.5 + draw.uniform(-0.1, 0.1), y + 0.5 + draw.uniform(-0.1, 0.1))
            objects.append(shape(at, draw.uniform(0.0, 3.0)))
    return DOCUMENT % ",\n".join(objects)


def dome(at, _):
    return '{"hemisphere": {"center": ["%.4f m", "%.4f m", "0 m"], "radius": "0.3989 m"}, "material": "target"}' % at


def square(at, angle):
    return (
        '{"box": {"low": ["-0.3536 m", "-0.3536 m", "0 m"], "high": ["0.3536 m", "0.3536 m", "0.005 m"]}, '
        '"material": "target", "transform": {"rotate": {"angle": "%.4f rad"}, "translate": ["%.4f m", "%.4f m", "0 m"]}}'
        % (angle, *at)
    )


def run(context):
    program, folder = context.program("bench_refine"), context.folder / "refine"
    if not program.exists():
        return {}
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "domes.json").write_text(targets(dome))
    (folder / "squares.json").write_text(targets(square))
    make = [context.program("ifov"), "make", "suburb", "--size", "60m", "--seed", "7", "--quiet", "--force"]
    subprocess.run([*make, folder / "suburb"], check=True)
    documents = {
        "domes": folder / "domes.json",
        "squares": folder / "squares.json",
        "suburb": folder / "suburb" / "render_thermal.json",
        "demo": ROOT / "examples" / "demo.json",
    }
    figures = {}
    for name, document in documents.items():
        found = run_json([program, document])
        figures[f"refine.{name}_over_direct"] = at_most(found["ratio"], 1.15, "times the rays", 3)
        figures[f"refine.{name}_agree"] = at_least(1.0 - found["disagree"], 0.95, "of the values", 4)
        figures[f"refine.{name}_converged"] = (
            at_least(found["converged"] / found["converged_direct"], 0.999, "of the direct run's", 4)
            if found["converged_direct"] > 0.0
            else not_measured("the air's own error is wider than the limit: no pixel of either run is within it"))
    return figures

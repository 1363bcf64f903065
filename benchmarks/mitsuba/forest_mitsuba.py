"""Renders the forest of the speed benchmarks with Mitsuba 3, and prints what it costs to reach an RMS error.

Run by the Python that has Mitsuba: forest_mitsuba.py FOLDER --bands 3|210 --variant llvm_ad_rgb ...
The last line is one JSON object. Compilation of kernels and loading are excluded from the times."""

import argparse
import json
import pathlib
import sys
import time

import numpy as np


def read_obj(path):
    """Vertices, and the triangles of each material in the file's order."""
    vertices, groups = [], []
    with open(path) as file:
        for line in file:
            if line.startswith("v "):
                vertices.append(line[2:])
            elif line.startswith("f "):
                groups[-1][1].append(line[2:])
            elif line.startswith("usemtl "):
                groups.append((line.split()[1], []))
    points = np.array(" ".join(vertices).split(), dtype=np.float64).reshape(-1, 3)
    return points, [(name, np.array(" ".join(faces).split(), dtype=np.int64).reshape(-1, 3) - 1) for name, faces in groups]


def write_ply(path, points, faces):
    """A binary PLY of the vertices that these faces use."""
    used, corners = np.unique(faces, return_inverse=True)
    rows = np.zeros(len(faces), dtype=[("n", "u1"), ("corner", "<i4", 3)])
    rows["n"], rows["corner"] = 3, corners.reshape(-1, 3)
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(used)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    with open(path, "wb") as file:
        file.write(header.encode() + points[used].astype("<f4").tobytes() + rows.tobytes())


def wavelengths_nm(bands):
    return 400.0 + 2.0 * np.arange(bands)


def spectrum(values, spectral):
    if not spectral:
        return {"type": "rgb", "value": [float(value) for value in values[:3]]}
    return {
        "type": "irregular",
        "wavelengths": ",".join(f"{w:.1f}" for w in wavelengths_nm(len(values))),
        "values": ",".join(f"{value:.6f}" for value in values),
    }


def film(pixels, bands, spectral):
    if not spectral:
        return {"type": "hdrfilm", "width": pixels, "height": pixels, "pixel_format": "rgb",
                "component_format": "float32", "rfilter": {"type": "box"}}
    result = {"type": "specfilm", "width": pixels, "height": pixels, "component_format": "float32", "rfilter": {"type": "box"}}
    for band, centre in enumerate(wavelengths_nm(bands)):
        result[f"band{band:03d}"] = {"type": "irregular", "wavelengths": f"{centre - 1:.1f},{centre + 1:.1f}", "values": "1,1"}
    return result


def placed(points, faces, places):
    """One mesh of all copies: Mitsuba's vectorised variants slow down with every instance, hundreds are too many."""
    copies = []
    for x, y, z, yaw, scale in places:
        c, s = scale * np.cos(np.radians(yaw)), scale * np.sin(np.radians(yaw))
        copies.append(points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, scale]]) + [x, y, z])
    offsets = len(points) * np.arange(len(places))
    return np.concatenate(copies), (faces[None, :, :] + offsets[:, None, None]).reshape(-1, 3)


def load_forest(mi, folder, reflectance, light, pixels, side_m, spectral):
    """The scene, with a material per row of `reflectance` (32 of ground, leaves, bark) and the trees that the view or
    its light can meet."""
    bands = reflectance.shape[1]
    scene = {"type": "scene", "integrator": {"type": "path", "max_depth": -1, "rr_depth": 4}}
    places = np.loadtxt(folder / "trees.csv", delimiter=",", skiprows=1)
    near = np.max(np.abs(places[:, :2]), axis=1) < side_m / 2 + 60.0
    number = 0
    for file in ("terrain.obj", "tree.obj"):
        points, groups = read_obj(folder / file)
        for name, faces in groups:
            ply = folder / f"{name}.ply"
            write_ply(ply, *(placed(points, faces, places[near]) if file == "tree.obj" else (points, faces)))
            scene[name] = {
                "type": "ply", "filename": str(ply), "face_normals": True,
                "bsdf": {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": spectrum(reflectance[number], spectral)}},
            }
            number += 1
    transform = mi.ScalarTransform4f
    scene["sun"] = {"type": "directional", "direction": [-c for c in light["sun_direction"]],
                    "irradiance": spectrum(np.full(bands, light["sun_irradiance"]), spectral)}
    scene["sky"] = {"type": "constant", "radiance": spectrum(np.full(bands, light["sky_radiance"]), spectral)}
    scene["sensor"] = {
        "type": "orthographic", "film": film(pixels, bands, spectral),
        "to_world": transform().look_at(origin=[0, 0, 400], target=[0, 0, 0], up=[0, 1, 0]).scale([side_m / 2, side_m / 2, 1]),
        "sampler": {"type": "multijitter"},
    }
    return mi.load_dict(scene)


def timed_render(mi, dr, scene, samples, seed):
    start = time.perf_counter()
    image = mi.render(scene, spp=samples, seed=seed)
    dr.eval(image)
    dr.sync_thread()
    return np.array(image, dtype=np.float64), time.perf_counter() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scene", type=pathlib.Path, required=True, help="JSON: reflectance, light, pixels, side_m")
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("--samples", type=int, nargs="+", default=[16, 256], help="a pixel; one run of each")
    parser.add_argument("--reference", type=int, default=4096, help="samples of the reference")
    parser.add_argument("--threads", type=int, default=0)
    arguments = parser.parse_args()

    import drjit as dr
    import mitsuba as mi

    mi.set_variant(arguments.variant)
    if arguments.threads:
        dr.set_thread_count(arguments.threads)
    description = json.loads(arguments.scene.read_text())
    spectral = "spectral" in arguments.variant
    reflectance = np.array(description["reflectance"])
    scene = load_forest(mi, arguments.folder, reflectance, description["light"], description["pixels"],
                        description["side_m"], spectral)

    passes = max(1, arguments.reference // 256)
    reference = np.mean([timed_render(mi, dr, scene, 256, 1000 + k)[0] for k in range(passes)], axis=0)
    runs = []
    for samples in arguments.samples:
        timed_render(mi, dr, scene, samples, 1)  # compiles the kernel
        trials = [timed_render(mi, dr, scene, samples, 10 + k) for k in range(3)]
        # The reference's own error is part of the difference: remove it, both being independent.
        share = 1.0 + samples / (256 * passes)
        errors = [np.sqrt(np.mean((image - reference) ** 2, axis=(0, 1)) / share) for image, _ in trials]
        runs.append({"samples": samples, "seconds": float(np.median([seconds for _, seconds in trials])),
                     "rms": np.mean(errors, axis=0).tolist()})
    print(json.dumps({"variant": arguments.variant, "mitsuba": mi.__version__, "runs": runs,
                      "mean": np.mean(reference, axis=(0, 1)).tolist()}))


if __name__ == "__main__":
    sys.exit(main())

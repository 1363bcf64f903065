"""What documents are made from: those of the examples, README and docs, and small good files of every kind."""

import ast
import json
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[3]
BLOCK = re.compile(r"^```json\n(.*?)^```", re.MULTILINE | re.DOTALL)
COMMENT = re.compile(r'("(?:[^"\\]|\\.)*")|//[^\n]*|/\*.*?\*/', re.DOTALL)

# Readers of fuzz_readers whose good files a definition of the schema wants, where its name is none of theirs.
WANTED = {
    "csv_spectrum": ("spectrum_csv",), "csv_spectrum_of_irradiance": ("spectrum_csv",),
    "csv_spectrum_of_radiance": ("spectrum_csv",), "ecostress_spectrum": ("ecostress",),
    "usgs_spectrum": ("usgs", "usgs_column"), "asd_spectrum": ("asd",), "envi_library_spectrum": ("sli",),
    "dirsig_spectrum": ("ems",), "tabulated_channel": ("channels",), "mesh": ("obj", "ply", "gltf", "glb"),
    "city": ("city_json",), "terrain": ("elevation",), "instances": ("instance_csv", "instance_file"),
    "weather": ("weather",), "document": ("document",),
    "imported_atmosphere": ("modtran", "uvspec", "path"),
    **dict.fromkeys(("temperature_map", "texture_image", "relief_of_heights", "relief_of_normals", "density_map",
                     "material_map", "mixture_map", "kernel_psf"), ("raster", "geotiff", "envi", "elevation")),
}


def documents():
    """Good documents of the project, each as a value."""
    paths = [*(ROOT / "examples").rglob("*.json*"), *(ROOT / "benchmarks" / "honesty" / "scenes").glob("*.json")]
    texts = [path.read_text() for path in sorted(paths)]
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))):
        texts += BLOCK.findall(page.read_text())
    found = []
    for text in texts:
        try:
            document = json.loads(COMMENT.sub(lambda match: match[1] or " ", text))
        except ValueError:  # a piece of one, with dots in it
            continue
        if isinstance(document, dict) and "ifov" in document and "include" not in document:
            found.append(document)
    return [*found, whole_document()]


def whole_document():
    """The document of tests/cli/test_schema.py that uses every section."""
    for statement in ast.parse((ROOT / "tests" / "cli" / "test_schema.py").read_text()).body:
        if isinstance(statement, ast.Assign) and statement.targets[0].id == "WHOLE":
            return ast.literal_eval(statement.value)
    raise LookupError("tests/cli/test_schema.py has no document WHOLE")


class Files:
    """Good files in the folder `files`, and which of them fit a key of the document."""

    def __init__(self, writer, folder):
        subprocess.run([writer, "--good-files", folder / "files"], check=True, stdout=subprocess.DEVNULL)
        (folder / "files" / "empty").write_bytes(b"")
        paths = sorted(path for path in (folder / "files").rglob("*") if path.is_file())
        self.names = [str(path.relative_to(folder)) for path in paths]

    def __call__(self, parent, key):
        """Names to choose from, those that fit many times among all."""
        wanted = WANTED.get(parent, (parent or "",))
        fit = [name for name in self.names if name.split("/")[1].startswith(wanted)]
        return fit * (1 + 10 * len(self.names) // len(fit)) + self.names if fit else self.names

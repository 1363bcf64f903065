"""A viewer that runs, and products made by hand for it to show."""

import http.client
import json
import math
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/cli"))

from program import DOME, LONG, PROGRAM, Folder, run, slowdown  # noqa: E402, F401


class Viewer:
    """`ifov view ...`, ended as the block ends."""

    def __init__(self, *arguments, cwd=None):
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        self.process = subprocess.Popen([PROGRAM, "view", *map(str, arguments)], cwd=cwd, env=environment,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.url = self.process.stdout.readline().strip()
        found = re.fullmatch(r"http://([\d.]+):(\d+)/#([\w-]+)", self.url)
        if not found:
            self.process.kill()
            raise AssertionError(f"no address: {self.url!r} {self.process.stderr.read()}")
        self.said = self.process.stdout.readline()
        self.host, self.port, self.token = found.group(1), int(found.group(2)), found.group(3)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()

    def end(self, by=signal.SIGINT):
        """Its exit code and what it has said since its address."""
        if self.process.poll() is None:
            self.process.send_signal(by)
        out, err = self.process.communicate(timeout=30)
        return self.process.returncode, self.said + out, err

    def request(self, path, method="GET", headers=None, token=True, body=None, host=None):
        """Status, headers and body of one request."""
        connection = http.client.HTTPConnection(self.host, self.port, timeout=30)
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        connection.putheader("Host", host or f"{self.host}:{self.port}")
        if token:
            connection.putheader("X-Ifov-Token", self.token if token is True else token)
        for name, value in (headers or {}).items():
            connection.putheader(name, value)
        if body is not None:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders(body)
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        return answer.status, dict(answer.getheaders()), content

    def ask(self, name, method="GET", **query):
        """What the page gets: JSON, or (about, floats)."""
        status, headers, body = self.request(f"/api/{name}?{urllib.parse.urlencode(query)}", method=method)
        if status != 200:
            raise Refused(status, json.loads(body)["error"])
        if "X-Ifov-About" in headers:
            return json.loads(headers["X-Ifov-About"]), struct.unpack(f"<{len(body) // 4}f", body)
        return json.loads(body)


# A run of 49 tiles, some a second.
TILES = LONG.replace("4000, 4000", "448, 448").replace('"elements": [30, 30]', '"elements": [10, 10]')


class Finished:
    """When each tile of a run at work was finished, as its records in packs tell it (docs/formats/run_state.md)."""

    def __init__(self, folder):
        self.folder, self.elapsed, self.begun, self.seen = pathlib.Path(folder) / "run.part/tiles", {}, math.inf, set()

    def look(self):
        for pack in sorted(self.folder.glob("*.tiles")):
            try:
                written, content = pack.stat().st_mtime, pack.read_bytes()
            except FileNotFoundError:
                continue
            if (pack.name, written) in self.seen:
                continue
            self.seen.add((pack.name, written))
            at = 0
            while at + 208 <= len(content):
                (tile,), (payload,), (elapsed,) = (struct.unpack_from(code, content, at + k) for code, k in (("<I", 16), ("<Q", 48), ("<d", 112)))
                self.elapsed[tile] = elapsed
                self.begun = min(self.begun, written - elapsed)  # a record is written once its tile is finished
                at += 208 + payload

    def since(self, tile):
        return time.time() - self.begun - self.elapsed[tile]


class Refused(Exception):
    def __init__(self, status, why):
        super().__init__(f"{status}: {why}")
        self.status, self.why = status, why


def write_cube(path, bands, names=None, wavelengths=None, unit=None, classes=None, code="f", extra=""):
    """An ENVI cube (BIL) of bands[b][y][x]."""
    height, width = len(bands[0]), len(bands[0][0])
    data_type = {"f": 4, "H": 12, "B": 1, "I": 13, "d": 5}[code]
    header = (f"ENVI\nsamples = {width}\nlines = {height}\nbands = {len(bands)}\nheader offset = 0\n"
              f"file type = ENVI {'Classification' if classes else 'Standard'}\ndata type = {data_type}\ninterleave = bil\nbyte order = 0\n")
    if names:
        header += "band names = {" + ", ".join(names) + "}\n"
    if wavelengths:
        header += "wavelength units = Micrometers\nwavelength = {" + ", ".join(map(str, wavelengths)) + "}\n"
    if unit:
        header += f"data units = {unit}\n"
    if classes:
        colours = [v for k in range(len(classes)) for v in (40 * k % 256, 90, 160)]
        header += (f"classes = {len(classes)}\nclass names = {{{', '.join(classes)}}}\n"
                   f"class lookup = {{{', '.join(map(str, colours))}}}\n")
    pathlib.Path(str(path) + ".hdr").write_text(header + extra)
    with open(path, "wb") as file:
        for y in range(height):
            for band in bands:
                file.write(struct.pack(f"<{width}{code}", *band[y]))


def write_products(folder, width=24, height=16, name="image", label="grass", factor=1):
    """A run's products whose values say where they are: channel c of pixel (x, y) is 100 c + y + x / 100, times a factor."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    um = [0.48, 0.56, 0.66, 0.86, 1.65, 10.8]
    channels = [f"B{c + 1}" for c in range(len(um))]
    grid = lambda value: [[value(x, y) for x in range(width)] for y in range(height)]
    values = [grid(lambda x, y, c=c: factor * (100 * c + y + x / 100)) for c in range(len(um))]
    write_cube(folder / f"{name}_radiance.img", values, channels, um, "W m-2 sr-1 um-1")
    write_cube(folder / f"{name}_half_width.img", [grid(lambda x, y, c=c: 0.02 * (c + 1)) for c in range(len(um))], channels, um)
    write_cube(folder / f"{name}_abundance.img", [grid(lambda x, y: x / (width - 1)), grid(lambda x, y: 1 - x / (width - 1))], [label, "roof"])
    write_cube(folder / f"{name}_material_class.img", [grid(lambda x, y: 1 + (x < width // 2))], classes=["nothing", label, "roof"], code="H")
    write_cube(folder / f"{name}_samples.img", [grid(lambda x, y: 64), grid(lambda x, y: 40), grid(lambda x, y: 24)],
               ["samples", "label rays", "radiance evaluations"], code="I")
    write_cube(folder / f"{name}_quality.img", [grid(lambda x, y, v=v: v) for v in (1.0, 0.5, 0.01, 0.2)],
               ["converged", "largest half-width over limit", "missable fraction", "borders"])
    write_cube(folder / f"{name}_reasons.img", [grid(lambda x, y: 0)], code="H")
    record = {
        "program": {"name": "ifov", "version": "0.1.0"}, "seed": 1, "sampler": "accuracy",
        "document": {"path": "scene.json", "text": '{\n  "ifov": 1\n}\n'},
        "image": {"width_px": width, "height_px": height, "radiance_unit": "W m-2 sr-1 um-1", "footprint_px": 1.0},
        "channels": [{"name": n, "centre_um": u, "fwhm_um": 0.05} for n, u in zip(channels, um)],
        "accuracy": {"asked": "2 %", "reached": "2 % in all pixels", "confidence": 0.95}, "notes": [],
    }
    (folder / f"{name}_run.json").write_text(json.dumps(record))
    return folder


class Scratch:
    def __enter__(self):
        self._folder = tempfile.TemporaryDirectory()
        return pathlib.Path(self._folder.name)

    def __exit__(self, *_):
        self._folder.cleanup()

"""Elements that look where a table says, and that are wider or narrower than their pitch: places against closed forms, means over squares that overlap
against areas of polygons, intervals, modulation by size, and what is said of tables that are wrong."""

import math
import pathlib
import unittest

from images import RenderedCase, np

WIDTH, LINES, HEIGHT_M, GSD_M, PERIOD_S = 24, 20, 500.0, 1.0, 0.01


def scene(objects, camera, sampling, platform=None, seed=1, **sensor):
    return {"ifov": 1, "seed": seed,
            "scene": {"materials": {"dark": {"reflectance": 0, "temperature": "1500 K"}, "light": {"reflectance": 0, "temperature": "3000 K"}},
                      "objects": [{"plane": {}, "material": "dark"}, *objects]},
            "light": {"surroundings": {"reflectance": 0, "temperature": "1 K"}},
            **({"platform": platform} if platform else {}),
            "sensor": {"camera": camera, "channels": [{"name": "a", "monochromatic": {"at": "1 um"}}], **sensor},
            "sampling": sampling, "output": {"formats": ["envi"], "products": ["half_width", "location"]}}


def polygon(corners):
    return {"polygon": {"vertices": [[f"{x} m", f"{y} m", "1 mm"] for x, y in corners]}, "material": "light"}


def north():
    return {"straight": {"frame": "scene", "position": ["0 m", "0 m", f"{HEIGHT_M} m"], "velocity": ["0 m/s", f"{GSD_M / PERIOD_S} m/s", "0 m/s"]}}


def line(**more):
    return {"pushbroom": {"pixels": [WIDTH, LINES], "focal_length": "50 mm", "pitch": "0.1 mm", "line_period": f"{PERIOD_S} s", **more}}


def looks(k):
    """Element k, from 0: across and along, metres on the ground; bent by two lines, 10 % wider at the right end."""
    u = (k + 0.5 - WIDTH / 2) / (WIDTH / 2)
    return WIDTH / 2 * GSD_M * (u + 0.05 * u * u), 2.0 * u * u


def mrad(metres):
    return 1e3 * math.atan(metres / HEIGHT_M)


def area_below(x0, y0, side, nx, ny, d):
    """Share of a square in which nx x + ny y < d, by clipping."""
    corners = [(x0, y0), (x0 + side, y0), (x0 + side, y0 + side), (x0, y0 + side)]
    kept = []
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1]):
        a, b = nx * ax + ny * ay - d, nx * bx + ny * by - d
        if a < 0:
            kept.append((ax, ay))
        if a * b < 0:
            kept.append((ax + (bx - ax) * a / (a - b), ay + (by - ay) * a / (a - b)))
    return 0.5 * abs(sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(kept, kept[1:] + kept[:1]))) / side**2 if len(kept) > 2 else 0.0


@unittest.skipIf(np is None, "NumPy not found")
class ElementTables(RenderedCase):
    def table(self, text):
        path = pathlib.Path(self.folder.name) / f"table{len(list(pathlib.Path(self.folder.name).iterdir()))}.csv"
        path.write_text(text)
        return {"file": path.name}

    def bent_line(self, more=""):
        rows = [f"{k + 1},{mrad(looks(k)[0]):.12g},{mrad(looks(k)[1]):.12g}" for k in range(WIDTH)]
        return self.table("column,across_mrad,along_mrad\n" + "\n".join(rows) + more)

    def test_what_a_bent_line_sees_lies_where_its_table_says(self):
        # Flying north the image's right is west; element k looks along_m ahead of where the line is.
        targets = [(k, j) for k in (3, 9, 15, 21) for j in (5, 13)]
        places = {(k, j): (-looks(k)[0], (j + 0.5) * GSD_M + looks(k)[1]) for k in range(WIDTH) for j in range(LINES)}
        half = 0.2
        squares = [polygon([(x + a * half, y + b * half) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]) for x, y in (places[t] for t in targets)]
        described = scene(squares, line(elements=self.bent_line()), {"accuracy": {"error": "1 %"}}, north(), psf={"gaussian": {"sigma": "0.7 px"}})
        light = self.rendered(described, LINES, WIDTH)["radiance"]
        light = light - np.median(light)
        for k, j in targets:
            rows, columns = np.mgrid[j - 4 : j + 5, max(k - 4, 0) : min(k + 5, WIDTH)]
            near = light[rows, columns]
            found = np.sum(near * columns) / near.sum(), np.sum(near * rows) / near.sum()
            # Tails that the image's side cuts off: only whole neighbourhoods tell the column.
            self.assertLess(abs(found[1] - j), 0.02, (k, j))
            if columns.shape[1] == 9:
                self.assertLess(abs(found[0] - k), 0.02, (k, j))
        (file,) = pathlib.Path(self.folder.name).glob("run*/image_location.img")
        location = np.fromfile(file, "<f8" if file.stat().st_size == 24 * WIDTH * LINES else "<f4").reshape(LINES, 3, WIDTH)
        wanted = np.array([[places[k, j] for k in range(WIDTH)] for j in range(LINES)])
        self.assertLess(np.abs(location[:, :2].transpose(0, 2, 1) - wanted).max(), 0.01 * GSD_M)
        self.assertGreater(np.abs(wanted[:, :, 1] - (np.arange(LINES)[:, None] + 0.5)).max(), 1.5, "planted: a straight line is told apart")

    def test_intervals_hold_along_bent_lines(self):
        things = [polygon([(-9.3, 3.2), (4.1, 2.4), (7.7, 14.9), (-6.6, 17.3)]), polygon([(8.2, 1.1), (12.9, 2.2), (9.4, 18.7)])]
        camera = line(elements=self.bent_line())
        coarse, fine = (self.rendered(scene(things, camera, {"grid": {"elements": [n, n]}}, north()), LINES, WIDTH)["radiance"] for n in (40, 80))
        edges = (fine > fine.min() * 1.001) & (fine < fine.max() * 0.999)
        self.assertGreater(edges.sum(), 60)
        found = self.rendered(scene(things, camera, {"accuracy": {"error": "2 %"}}, north()), LINES, WIDTH)
        within = found["half_width"] + np.abs(coarse - fine)
        self.assertGreater(np.mean((np.abs(found["radiance"] - fine) <= within)[edges]), 0.93)
        plain = self.rendered(scene(things, line(), {"accuracy": {"error": "2 %"}}, north()), LINES, WIDTH)
        self.assertLess(np.mean((np.abs(plain["radiance"] - fine) <= within)[edges]), 0.5)

    def frame(self, **more):
        return {"frame": {"pixels": [WIDTH, LINES], "focal_length": "50 mm", "pitch": "0.1 mm", "position": ["0 m", "0 m", f"{HEIGHT_M} m"], "attitude": {}, **more}}

    def plain_frame_table(self, wider=lambda i, j: 0.8):
        """A pinhole's own directions, with sides that differ, for every fourth element and the last ones."""
        text = "column,row,across_mrad,along_mrad,ifov_mrad\n"
        for j in sorted({*range(0, LINES, 4), LINES - 1}):
            for i in sorted({*range(0, WIDTH, 4), WIDTH - 1}):
                x, y = (i + 0.5 - WIDTH / 2) * GSD_M, (j + 0.5 - LINES / 2) * GSD_M
                # tan(a + w / 2) - tan(a - w / 2) is about w / cos^2 a.
                width = wider(i, j) * GSD_M / HEIGHT_M * math.cos(math.atan(x / HEIGHT_M)) * math.cos(math.atan(y / HEIGHT_M))
                text += f"{i + 1},{j + 1},{mrad(x):.12g},{mrad(y):.12g},{1e3 * width:.12g}\n"
        return self.table(text)

    def test_a_frames_table_of_a_pinhole_is_that_pinhole(self):
        thing = [polygon([(-9.3, -6.2), (4.1, -7.4), (7.7, 5.9), (-6.6, 7.3)])]
        accuracy = {"accuracy": {"error": "1 %"}}
        plain = self.rendered(scene(thing, self.frame(), accuracy, fill_factor=0.64), LINES, WIDTH)
        told = self.rendered(scene(thing, self.frame(elements=self.plain_frame_table()), accuracy), LINES, WIDTH)
        self.assertLess(np.abs(told["radiance"] - plain["radiance"]).max(), 2e-3 * plain["radiance"].max())
        # Sides that differ by 3 % take up to 6 % of a pixel's light elsewhere: half-widths say so, and hold it.
        uneven = self.rendered(scene(thing, self.frame(elements=self.plain_frame_table(lambda i, j: 0.8 * (1.03 if i < 12 else 0.97))), accuracy), LINES, WIDTH)
        self.assertGreater(uneven["half_width"].min(), 0.05 * np.ptp(plain["radiance"]) * 0.4)
        self.assertLess(np.abs(uneven["radiance"] - plain["radiance"]).max(), uneven["half_width"].max())

    def test_elements_that_overlap(self):
        side, (nx, ny), d = 1.6, (math.cos(math.radians(33)), math.sin(math.radians(33))), 0.37
        half_plane = [polygon([(d * nx - 80 * nx + a * 80 * ny, d * ny - 80 * ny - a * 80 * nx) for a in (-1, 1)]
                              + [(d * nx + a * 80 * ny, d * ny - a * 80 * nx) for a in (1, -1)])]
        orthographic = {"orthographic": {"gsd": f"{GSD_M} m", "pixels": [WIDTH, LINES]}}
        for name, camera, platform, square in (("orthographic", orthographic, None, True), ("frame", self.frame(), None, True),
                                               ("lines", line(start=f"{-LINES / 2 * PERIOD_S} s", element_length="0.16 mm"), north(), False)):
            with self.subTest(name):
                found = self.rendered(scene(half_plane, camera, {"accuracy": {"error": "1 %"}}, platform, fill_factor=side**2), LINES, WIDTH)
                dark, light = found["radiance"].min(), found["radiance"].max()

                def mean(i, j, wide):
                    x, y = (i + 0.5 - WIDTH / 2) * GSD_M, (LINES / 2 - j - 0.5) * GSD_M
                    if square:
                        return area_below(x - wide / 2, y - wide / 2, wide, nx, ny, d)
                    # Flying north, west is on the right; a length that moves on by a line meanwhile.
                    x, y = -x, -y
                    parts = [area_below(0, 0, 1, nx * wide, ny * wide, d - nx * (x - wide / 2) - ny * (y - wide / 2 + (s + 0.5) / 50 - 0.5)) for s in range(50)]
                    return sum(parts) / 50

                truth, narrow = (dark + (light - dark) * np.array([[mean(i, j, wide) for i in range(WIDTH)] for j in range(LINES)]) for wide in (side, 1.0))
                edges = (truth > dark * 1.001) & (truth < light * 0.999)
                self.assertGreater(edges.sum(), 50)
                off = np.abs(found["radiance"] - truth) / (found["half_width"] + 1e-4 * light)
                self.assertGreater(np.mean(off[edges] <= 1), 0.93)
                self.assertLess(np.mean(np.abs(narrow - truth)[edges] <= found["half_width"][edges]), 0.7, "planted: elements of a pitch")
                # The edge's profile, by distance in pixels, and its modulation: sinc by the element's size, not by the pitch.
                if not square:
                    continue
                i, j = np.meshgrid(np.arange(WIDTH), np.arange(LINES))
                t = (nx * (i + 0.5 - WIDTH / 2) + ny * (LINES / 2 - j - 0.5) - d / GSD_M).ravel()
                order = np.argsort(t)
                t, rise = t[order], (found["radiance"].ravel()[order] - dark) / (light - dark)
                for cycles in (0.1, 0.25, 0.4, 0.5):
                    wave = np.exp(-2j * np.pi * cycles * 0.5 * (t[1:] + t[:-1]))
                    measured = abs(np.sum(-np.diff(rise) * wave))
                    wanted = np.sinc(cycles * side * nx) * np.sinc(cycles * side * ny)
                    self.assertLess(abs(measured - wanted), 0.02, cycles)
                    if cycles > 0.2:
                        self.assertGreater(abs(measured - np.sinc(cycles * nx) * np.sinc(cycles * ny)), 0.05, "planted: elements of a pitch")

    def test_what_is_said(self):
        accuracy = {"accuracy": {"error": "5 %"}}
        check = self.run_ifov("check", scene([], line(elements=self.bent_line()), accuracy, north()))
        self.assertEqual(check.returncode, 0, check.stderr)
        self.assertIn(", elements by a table, a line every 10 ms", check.stdout)
        rows = "".join(f"{k},{k},0\n" for k in range(1, WIDTH + 1))
        for text, says in (
            ("column,across_rad\n1,2\n", "csv:1:8: found the heading 'across_rad'; expected 'column', 'row', 'across_deg', 'along_deg', 'across_mrad', 'along_mrad', 'ifov_deg' or 'ifov_mrad'"),
            ("across_mrad,along_mrad\n1,2\n", "the table has no column 'column'"),
            ("column,row,across_mrad,along_mrad\n1,1,1,0\n", "found a column 'row'; expected none, the elements are one line"),
            ("column,across_mrad\n1,1\n", "the table has none of 'along_deg' and 'along_mrad'; expected one of them"),
            ("column,across_mrad,along_mrad\n1,1,0\n12,3,0\n", "found columns 1 to 12; expected the outermost ones, columns 1 and 24, and any between"),
            ("column,across_mrad,along_mrad\n1,1,0\n25,3,0\n", "csv:3: found the column 25; expected 1 to 24, as many as the image has"),
            ("column,across_mrad,along_mrad\n1,1,0\n1.5,1,0\n", "csv:3: found the column 1.5; expected a whole number"),
            ("column,across_mrad,along_mrad\n" + rows + "7,9,0\n", "csv:26: element 7 is there twice: first in line 8"),
            ("column,across_mrad,along_mrad\n1,x,0\n", "csv:2:3: "),
            ("column,across_mrad,along_mrad\n" + rows.replace("9,9,0", "9,2,0"), "and the next look across each other; expected angles across that increase from column to column"),
            ("column,across_mrad,along_mrad,ifov_mrad\n" + rows.replace(",0\n", ",0,1\n").replace("5,5,0,1\n", "5,5,0,1.2\n"), "and the same of all within 5 %"),
        ):
            with self.subTest(says):
                done = self.run_ifov("check", scene([], line(elements=self.table(text)), accuracy, north()))
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(says, done.stderr)
                self.assertIn("doc.json:1:", done.stderr)
        frame = self.frame(elements=self.table("column,row,across_mrad,along_mrad\n1,1,-20,-20\n24,1,20,-20\n1,20,-20,20\n"))
        self.assertIn("the element of column 24, row 20, is missing; expected all of 2 columns and 2 rows, which others have",
                      self.run_ifov("check", scene([], frame, accuracy)).stderr)
        both = scene([], self.frame(elements=self.plain_frame_table()), accuracy, fill_factor=0.5)
        self.assertIn("the sensor's 'fill_factor' is 0.5, and the table of its elements tells how wide each looks: leave one of both out", self.run_ifov("check", both).stderr)
        self.assertIn("'elements'", self.run_ifov("check", scene([], self.frame(elements=self.plain_frame_table(), distortion={"k1": 0.1}), accuracy)).stderr)
        self.assertIn("expected a number between 0 (excluded) and 16", self.run_ifov("check", scene([], self.frame(), accuracy, fill_factor=17)).stderr)


if __name__ == "__main__":
    unittest.main()

"""docs/developer/add_a_quantity.md is true: its quantity, put beside the others, is asked for, written and kept."""

import array
import json
import re
import unittest

from outside_tree import ROOT, Page, PageTest

PAGE = Page("add_a_quantity.md")
TABLE = "io/quantities/quantity_table.cpp"


def room_file(header, includes, namespace, code):
    return f"{header}" + "".join(f"#include {name}\n" for name in includes) + f"namespace {namespace} {{\n{code}}}\n"


class AddAQuantity(PageTest):
    row = "quantity"

    def extend(self, tree):
        def add(path, includes, namespace):
            tree.write(path, room_file("#pragma once\n" if path.endswith(".h") else "", includes, namespace, PAGE.code("src/" + path)))

        add("truth/echo_time.h", ['"truth/collector.h"'], "ifov::truth")
        add("io/quantities/echo_time_quantity.h", ['"io/quantities/quantity.h"'], "ifov::io::quantities")
        add("truth/echo_time.cpp", ['"truth/echo_time.h"', "<limits>"], "ifov::truth")
        add("io/quantities/echo_time_quantity.cpp",
            ['"io/quantities/echo_time_quantity.h"', '"io/quantities/layer_values.h"', '"truth/echo_time.h"'], "ifov::io::quantities")
        row = re.search(r"&quantities::kEchoTime\b", PAGE.code("src/" + TABLE)).group(0)
        table, rows = re.subn(r"(constexpr std::array kQuantities\{[^}]*)\}", rf"\1, {row}}}", (ROOT / "src" / TABLE).read_text())
        self.assertEqual(rows, 1)
        tree.write(TABLE, '#include "io/quantities/echo_time_quantity.h"\n' + table)

    def test_two_pairs_of_files_and_one_row(self):
        folder, run = self.folder, self.run_it
        document = {"ifov": 1, "scene": {"materials": {"soil": {"reflectance": 0.3, "temperature": "300 K"}},
                                         "objects": [{"disk": {"center": ["0 m", "0 m", "0 m"], "radius": "31 m", "normal": [0, 0, 1]},
                                                      "material": "soil"}]},
                    "light": {"sky": {"temperature": "280 K"}},
                    "sensor": {"camera": {"frame": {"position": ["0 m", "0 m", "100 m"], "look_at": ["0 m", "0 m", "0 m"],
                                                    "up": [0, 1, 0], "focal_length": "100 mm", "pitch": "10 mm", "pixels": [9, 9]}},
                               "channels": [{"name": "thermal", "top_hat": {"from": "10 um", "to": "12 um"}}]},
                    "sampling": {"tile": 3}, "output": {"products": ["echo_time", "samples"]}}
        (folder / "scene.json").write_text(json.dumps(document))

        self.assertIn('`"echo_time"`', run("schema", "--markdown").stdout)
        result = run("render", "scene.json", "-o", "out", "-q")
        self.assertIn(result.returncode, (0, 6), result.stderr)
        values = array.array("f", (folder / "out/image_echo_time.img").read_bytes())
        self.assertEqual(len(values), 81)
        for k, value in enumerate(values):
            x, y = (k % 9 - 4) * 10.0, (k // 9 - 4) * 10.0
            if x * x + y * y < 31.0**2:
                self.assertAlmostEqual(value, 2 * (100.0**2 + x * x + y * y) ** 0.5 / 0.299792458, 3)
            else:
                self.assertNotEqual(value, value, "not a number where nothing is seen")
        header = (folder / "out/image_echo_time.img.hdr").read_text()
        self.assertIn("time of a pulse of light to what the middle of each pixel sees, and back", header)
        self.assertIn("band names = {echo time}", header)

        # Shares are kept as tiles, which know nothing of what they carry.
        for share in ("1/2", "2/2"):
            self.assertIn(run("render", "scene.json", "-o", "part" + share[0], "--tiles", share, "-q").returncode, (0, 6))
        merged = run("merge", "part1", "part2", "-o", "whole")
        self.assertIn(merged.returncode, (0, 6), merged.stderr)
        self.assertEqual((folder / "whole/image_echo_time.img").read_bytes(), (folder / "out/image_echo_time.img").read_bytes())


if __name__ == "__main__":
    unittest.main()

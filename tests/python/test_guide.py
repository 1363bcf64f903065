"""The examples of docs/guide/python.md run as written, one after another."""

import pathlib
import re
import unittest

import scenes

GUIDE = scenes.ROOT / "docs" / "guide" / "python.md"


class Guide(scenes.InFolder):
    def run_parts(self, name, parts):
        names = {}
        for number, part in enumerate(parts, 1):
            try:
                exec(compile(part, f"{name}, part {number}", "exec"), names)  # noqa: S102
            except Exception as error:
                raise AssertionError(f"{name}, part {number}:\n{part}") from error
        return names

    def test_examples(self):
        parts = re.findall(r"```python\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.DOTALL)
        self.assertGreater(len(parts), 7)
        names = self.run_parts("python.md", parts)
        self.assertEqual(names["picture"].dims, ("y", "x", "rgb"))
        self.assertTrue(pathlib.Path("out/image_run.json").exists())


if __name__ == "__main__":
    unittest.main()

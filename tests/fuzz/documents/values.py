"""Values of the document's simplest kinds: as one would write them, at the ends of what is allowed, and far beyond."""

import re


class Raw(str):
    """A number as it is written, such as 1e400, for which Python has no value."""


# Numbers as texts: far from the usual, and yet taken in most places; at the ends of what doubles, floats and integers
# hold; beyond all that, or what is no number but looks like one.
FAR = (
    "0", "-0", "1e-15", "1e-12", "1e-9", "1e-6", "1e-3", "1e3", "1e5", "1e6", "1e7", "1e9", "1e12", "9.99e14", "1e15",
    "-1e-15", "-1e-9", "-1e-3", "-1", "-1e3", "-1e6", "-1e9", "-1e15", "16777217", "0.99999999999999994",
    "1.0000000000000002",
)
ENDS = (
    "1e-30", "1e30", "1e-46", "3.5e38", "1e-308", "5e-324", "1e-400", "1e308", "-1e308", "2147483648", "-2147483649",
    "4294967296", "9007199254740993", "9223372036854775808", "18446744073709551616",
)
BEYOND = ("1.8e308", "1e400", "-1e400", "1e99999999999")
NO_NUMBER = ("nan", "NaN", "inf", "-inf", "Infinity", "0x10", "1,5", "1e", "+", "--1", "", "1e5e5", "١", "½")

# What one writes of a quantity, by its first unit.
USUAL = {
    "deg": (0, 80), "m": (0.05, 20), "K": (250, 330), "um": (0.4, 14), "m-2": (0.001, 0.1), "au": (0.9, 1.1),
    "W m-2 um-1": (1, 1500), "W m-2 sr-1 um-1": (0.1, 100), "g/cm2": (0.1, 4), "DU": (250, 400), "ppm": (0.1, 500),
    "hPa": (300, 1010), "%": (1, 99), "g/kg": (0.1, 10), "m/s": (0, 20), "px": (0.01, 1), "reflectance": (0.001, 0.1),
    "noise": (0.5, 2),
}

TEXTS = ("a", "b", "red", "thermal", "É ü ß 漢字 🙂", "<script>alert(1)</script>&amp;", "%s%n%x", "a/b\\c", "'\"`$(x)", "..", " ", "x" * 300,
         "y" * 100_000)
CRS = ("EPSG:25832", "EPSG:4326", "EPSG:3857", "EPSG:0", "+proj=utm +zone=32", "LOCAL_CS[\"x\"]")
LIBRARY = ("water, pure", "lichen", "asphalt, black", "sand, wet", "leaf, aspen", "ice")
TIMES = ("2026-06-21T17:00:00Z", "2026-06-21", "2026-12-21T23:59:60Z", "2026-02-30T10:00:00Z", "0000-01-01T00:00:00Z",
         "9999-12-31T23:59:59.999999999999Z", "0001-01-01", "2026-06-21T24:00:00Z", "2026-06-21T12:00:00+99:99")
NAMES = ("a", "b", "c", "d", "É 漢字")

QUANTITY = re.compile(r"\(((?:[^()\\]|\\.)*)\)\[ \\t\]\*\$$")
RANGE = re.compile(r"between (-?[\d.e+-]+)(?: \(excluded\))? and (-?[\d.e+-]+)")


def units_of(pattern):
    """Units that a pattern of quantities takes, none where it is another pattern."""
    found = QUANTITY.search(pattern)
    return [re.sub(r"\\(.)", r"\1", unit) for unit in found[1].split("|")] if found else []


def far_number(random):
    return random.choice(FAR if random.random() < 0.8 else ENDS if random.random() < 0.9 else BEYOND)


def quantity(random, pattern, units, description, wildness):
    """A number with a unit, as a text."""
    ends = RANGE.search(description)
    if random.random() < wildness:
        text = far_number(random) if random.random() < 0.97 else random.choice(NO_NUMBER)
        return f"{text.lstrip('-') if random.random() < 0.5 else text} {random.choice(units)}"
    if ends and random.random() < 0.4:
        return f"{random.choice(ends.groups())} {units[0]}"
    low, high = USUAL.get(units[0], (0.1, 10))
    if ends:
        low, high = max(low, float(ends[1])), min(high, float(ends[2]))
    unit = units[0] if random.random() < 0.8 else random.choice(units)
    sign = "-" if "[+-]?" in pattern[:12] and units[0] != "K" and random.random() < 0.3 else ""
    return f"{sign}{random.uniform(low, high):.4g} {unit}"


def number(random, node, wildness):
    """A number or an integer within or beyond its limits."""
    low = node.get("minimum", node.get("exclusiveMinimum", 0))
    high = node.get("maximum", node.get("exclusiveMaximum"))
    whole = node["type"] == "integer"
    if random.random() < wildness:
        return Raw(far_number(random))
    if random.random() < 0.2:
        ends = [low] if high is None else [low, high]
        if whole:
            ends += [low + 1]
        return random.choice(ends)
    top = min(high if high is not None else low + 10, low + (10 if whole else 1e3))
    return random.randint(int(low), int(top)) if whole else float(f"{random.uniform(low, top):.4g}")


def text(random, pattern, key, wildness):
    """A text that fits a pattern which is no quantity; None where the pattern is not known."""
    if "[0-9]{4}-[0-9]{2}-[0-9]{2}" in pattern:
        times = TIMES if random.random() < 0.3 else TIMES[:1]
        return random.choice(times) if "T" in pattern else random.choice(times)[:10]
    if pattern == "^[0-9]([.][0-9])?$":
        return random.choice(("0", "1", "2", "2.2", "9.9"))
    if pattern == "^(0|-?[1-9][0-9]{0,17})$":
        return random.choice(("0", "1", "2", "255", "-1", "999999999999999999"))
    if key == "library" and random.random() > wildness:
        return random.choice(LIBRARY)
    if pattern == "^[A-Za-z0-9_][A-Za-z0-9_-]{0,99}$":
        return random.choice(("image", "0", "_a-b", "n" * 100))
    if key == "crs":
        return random.choice(CRS)
    if pattern in ("^.+$", "^[^\\u0000-\\u001F]+$", "^(?!/)(?!(.*/)?\\.\\.(/|$))[^\\u0000]+$"):
        return random.choice(TEXTS if random.random() < 2 * wildness else TEXTS[:4])
    return None

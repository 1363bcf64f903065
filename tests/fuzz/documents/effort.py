"""How much work a document may ask for while it is tried, and what the command line says so that it asks for little."""

import dataclasses


def _at(document, *keys):
    """The object at these keys, empty where there is none."""
    for key in keys:
        document = document.get(key) if isinstance(document, dict) else None
    return document if isinstance(document, dict) else {}


def _of(changes):
    return [word for change in changes for word in ("--set", change)]


def of_few_pixels(document):
    changes = [f"sensor.camera.{kind}.pixels=[8, 6]" for kind in _at(document, "sensor", "camera")]
    sampling = _at(document, "sampling")
    if "grid" in sampling:
        changes.append("sampling.grid.elements=[2, 2]")
    elif "adaptive" in sampling:
        changes += ["sampling.adaptive.sub_elements=[2, 2]", "sampling.adaptive.max_samples=20"]
    elif "single" not in sampling:
        changes.append("sampling.accuracy.max_samples=200")
    return _of(changes)


def _has_air(document):
    """True where scattering in air is computed: by channel some tenths of a second, in thick fog some seconds."""
    return bool(_at(document, "atmosphere").keys() & {"profile", "levels"})


def of_few_channels(document):
    """Of long series under computed air, five channels."""
    channels = _at(document, "sensor").get("channels") if _has_air(document) else None
    changes = []
    for i, channel in enumerate(channels if isinstance(channels, list) else ()):
        count = _at(channel, "series", "gaussian").get("count")
        if isinstance(count, int) and 5 < count <= 20000:  # others are refused, and should be
            changes.append(f"sensor.channels[{i}].series.gaussian.count=5")
    return _of(changes)


def with_air(document, limits):
    """Limits that leave time for air."""
    if not _has_air(document):
        return limits
    return dataclasses.replace(limits, processor_s=limits.processor_s * 6, kill_s=limits.kill_s * 4)

"""The fixed grid of the tables, and how a sample comes onto it."""
import numpy as np

# first wavelength, step, last wavelength (um)
PIECES = ((0.35, 0.005, 1.0), (1.0, 0.01, 2.5), (2.5, 0.01, 3.0), (3.0, 0.025, 5.0), (5.0, 0.05, 14.0))
FADE_UM = 0.6


def wavelengths_um():
    points = []
    for first, step, last in PIECES:
        points.extend(first + step * k for k in range(round((last - first) / step)))
    return np.array(points + [PIECES[-1][2]])


def on_grid(grid_um, x, y):
    """Figures whose straight-line interpolation is nearest to the sample's (least squares over wavelength), so that band
    means stay. Where the sample ends inside a cell, its end value goes on."""
    cells = 16
    fine = np.concatenate([np.linspace(a, b, cells, endpoint=False) for a, b in zip(grid_um, grid_um[1:])] +
                          [grid_um[-1:]])
    wanted = np.interp(fine, x, y)
    weight = np.gradient(fine)
    cell = np.minimum(np.searchsorted(grid_um, fine, side="right") - 1, grid_um.size - 2)
    share = (fine - grid_um[cell]) / (grid_um[cell + 1] - grid_um[cell])
    n = grid_um.size
    main, off, right = np.zeros(n), np.zeros(n - 1), np.zeros(n)
    np.add.at(main, cell, weight * (1 - share) ** 2)
    np.add.at(main, cell + 1, weight * share ** 2)
    np.add.at(off, cell, weight * share * (1 - share))
    np.add.at(right, cell, weight * (1 - share) * wanted)
    np.add.at(right, cell + 1, weight * share * wanted)
    upper, value = np.zeros(n), np.zeros(n)  # Thomas' algorithm
    upper[0], value[0] = off[0] / main[0], right[0] / main[0]
    for i in range(1, n):
        pivot = main[i] - off[i - 1] * upper[i - 1]
        upper[i] = off[i] / pivot if i < n - 1 else 0.0
        value[i] = (right[i] - off[i - 1] * value[i - 1]) / pivot
    for i in range(n - 2, -1, -1):
        value[i] -= upper[i] * value[i + 1]
    return np.clip(value, 0.0, 1.0)


def completed(grid_um, sample, donor):
    """The sample's points over the whole grid, and what was not measured as (first, last, how).

    Gaps are bridged by straight lines. Beyond the ends the values come from `donor`, a sample of the same kind, times a
    factor that makes them meet: constant towards short wavelengths, and fading to 1 over FADE_UM towards long ones; where
    donor has a gap, or begins only beyond, by a straight line. Without donor, the end value goes on."""
    x, y = [sample.wavelength_um], [sample.reflectance]
    ranges = [(low, high, "straight line") for low, high in sample.gaps()]

    def ratio(at_um):
        return float(np.clip(sample.at(at_um) / max(float(donor.at(at_um)), 1e-3), 0.05, 20.0))

    first, last = grid_um[0], grid_um[-1]
    if sample.first_um > first + 1e-9:
        reach = max(first, donor.first_um) if donor is not None else sample.first_um
        if reach < sample.first_um - 1e-9:
            inner = np.union1d(donor.wavelength_um[(donor.wavelength_um > reach) & (donor.wavelength_um < sample.first_um)],
                               [reach])
            x.append(inner)
            y.append(np.clip(donor.at(inner) * ratio(sample.first_um), 0, 1))
            ranges.append((reach, sample.first_um, f"from {donor.title}, scaled to meet"))
        else:
            reach = sample.first_um
        if reach > first + 1e-9:
            ranges.append((first, reach, "end value goes on"))
    if sample.last_um < last - 0.005:
        if donor is not None and donor.last_um > sample.last_um:
            inner = donor.wavelength_um[donor.wavelength_um > sample.last_um]
            meets = donor.first_um < sample.last_um
            factor = np.interp(inner, [sample.last_um, sample.last_um + FADE_UM],
                               [ratio(sample.last_um) if meets else 1.0, 1.0])
            x.append(inner)
            y.append(np.clip(donor.at(inner) * factor, 0, 1))
            bridges = [(max(low, sample.last_um), high) for low, high in donor.gaps() if high > sample.last_um]
            bridges = bridges if meets else [(sample.last_um, donor.first_um)]
            start = sample.last_um
            for low, high in bridges:
                if low > start + FADE_UM / 10:
                    ranges.append((start, low, f"from {donor.title}, scaled to meet"))
                    ranges.append((low, high, "straight line"))
                else:
                    ranges.append((start, high, "straight line"))
                start = high
            ranges.append((start, last, f"from {donor.title}"))
        else:
            ranges.append((sample.last_um, last, "end value goes on"))
    x, y = np.concatenate(x), np.concatenate(y)
    order = np.argsort(x)
    return x[order], y[order], sorted(ranges, key=lambda item: item[0])


def difference(grid_um, figures, sample):
    """Largest and RMS difference between the interpolated figures and the sample's own points on the grid's range."""
    inside = (sample.wavelength_um >= grid_um[0]) & (sample.wavelength_um <= grid_um[-1])
    error = np.interp(sample.wavelength_um[inside], grid_um, figures) - sample.reflectance[inside]
    return float(np.abs(error).max()), float(np.sqrt(np.mean(error ** 2)))

"""PROSPECT: reflectance and transmittance of a leaf.

S. Jacquemoud and F. Baret, Remote Sensing of Environment 34 (1990) 75-91; version D: J.-B. Feret et al., Remote Sensing
of Environment 193 (2017) 204-215, whose table of coefficients (1 nm) is read from a file.
"""
import math

import numpy as np

PARAMETERS = ("N", "Cab", "Car", "Cant", "Cbrown", "Cw", "Cm")


class Coefficients:
    """Columns of dataSpec_PDB: wavelength in nm, refractive index, specific absorption of chlorophyll, carotenoids,
    anthocyanins, brown pigments, water and dry matter."""

    def __init__(self, path):
        with open(path, encoding="latin-1") as lines:
            rows = [line.split() for line in lines]
        table = np.array([[float(x) for x in row] for row in rows if len(row) == 8 and not row[0].startswith("#")])
        self.wavelength_um = table[:, 0] * 1e-3
        self.index = table[:, 1]
        self.absorption = table[:, 2:]


def exponential_integral(x):
    """E1 for x > 0: a series up to 1, a continued fraction above (Abramowitz and Stegun 5.1.11, 5.1.22)."""
    x = np.asarray(x, float)
    small = np.minimum(x, 1.0)
    term, series = np.ones_like(small), np.zeros_like(small)
    for k in range(1, 30):
        term = -term * small / k
        series -= term / k
    series += -0.5772156649015329 - np.log(small)
    large = np.maximum(x, 1.0)
    fraction = np.zeros_like(large)
    for k in range(60, 0, -1):
        fraction = k / (1.0 + k / (large + fraction))
    return np.where(x <= 1.0, series, np.exp(-large) / (large + fraction))


def surface_transmittance(n, angle_deg):
    """Mean transmittance of a dielectric surface over directions within a cone (F. Stern, Appl. Opt. 3 (1964) 111)."""
    s2 = math.sin(math.radians(angle_deg)) ** 2
    n2 = n * n
    p, q = n2 + 1.0, n2 - 1.0
    a = (n + 1.0) ** 2 / 2.0
    k = -(q * q) / 4.0
    b2 = s2 - p / 2.0
    b1 = np.sqrt(np.maximum(b2 * b2 + k, 0.0)) if angle_deg < 90 else np.zeros_like(n)
    b = b1 - b2
    ts = (k ** 2 / (6 * b ** 3) + k / b - b / 2) - (k ** 2 / (6 * a ** 3) + k / a - a / 2)
    tp1 = -2 * n2 * (b - a) / p ** 2
    tp2 = -2 * n2 * p * np.log(b / a) / q ** 2
    tp3 = n2 * (1 / b - 1 / a) / 2
    tp4 = 16 * n2 ** 2 * (n2 ** 2 + 1) * np.log((2 * p * b - q ** 2) / (2 * p * a - q ** 2)) / (p ** 3 * q ** 2)
    tp5 = 16 * n2 ** 3 * (1 / (2 * p * b - q ** 2) - 1 / (2 * p * a - q ** 2)) / p ** 3
    return (ts + tp1 + tp2 + tp3 + tp4 + tp5) / (2 * s2)


def leaf(index, absorption, layers):
    """Reflectance and transmittance of `layers` plates with an absorption coefficient per layer."""
    k = np.maximum(absorption, 1e-9)
    tau = (1 - k) * np.exp(-k) + k ** 2 * exponential_integral(k)
    t12, t_alpha = surface_transmittance(index, 90.0), surface_transmittance(index, 40.0)
    t21 = t12 / index ** 2
    r21, r_alpha = 1 - t21, 1 - t_alpha
    denominator = 1 - (r21 * tau) ** 2
    ta = t_alpha * tau * t21 / denominator
    ra = r_alpha + r21 * tau * ta
    t = t12 * tau * t21 / denominator
    r = (1 - t12) + r21 * tau * t
    d = np.sqrt(np.maximum((1 + r + t) * (1 + r - t) * (1 - r + t) * (1 - r - t), 1e-30))
    va = (1 + r ** 2 - t ** 2 + d) / (2 * r)
    vb = (1 - r ** 2 + t ** 2 + d) / (2 * t)
    vn = vb ** (layers - 1)
    inner = va ** 2 * vn ** 2 - 1
    r_sub = va * (vn ** 2 - 1) / inner
    t_sub = vn * (va ** 2 - 1) / inner
    denominator = 1 - r_sub * r
    return ra + ta * r_sub * t / denominator, ta * t_sub / denominator


def run(coefficients, parameters):
    """`parameters` as in PARAMETERS: layers, then contents in ug/cm2 (pigments), arbitrary (brown), g/cm2."""
    contents = np.array(parameters[1:])
    return leaf(coefficients.index, coefficients.absorption @ contents / parameters[0], parameters[0])


def fit(coefficients, wavelength_um, reflectance, first_um=0.42, last_um=2.4):
    """Parameters whose reflectance is nearest to a measured one (Levenberg-Marquardt on their logarithms), and the RMS
    difference that remains."""
    use = (coefficients.wavelength_um >= first_um) & (coefficients.wavelength_um <= last_um)
    part = Coefficients.__new__(Coefficients)
    part.index, part.absorption = coefficients.index[use], coefficients.absorption[use]
    wanted = np.interp(coefficients.wavelength_um[use], wavelength_um, reflectance)
    best = None
    for start in ([1.5, 40, 8, 1, 0.05, 0.012, 0.008], [2.5, 25, 6, 1, 0.3, 0.02, 0.015]):
        logs = np.log(np.array(start) - np.array([1.0] + [0.0] * 6))
        offset = np.array([1.0] + [0.0] * 6)
        damping, values = 1e-2, run(part, np.exp(logs) + offset)[0]
        for _ in range(120):
            slopes = np.empty((wanted.size, 7))
            for i in range(7):
                moved = logs.copy()
                moved[i] += 1e-4
                slopes[:, i] = (run(part, np.exp(moved) + offset)[0] - values) / 1e-4
            left = slopes.T @ slopes
            step = np.linalg.solve(left + damping * (np.diag(np.diag(left)) + 1e-9 * np.eye(7)),
                                   slopes.T @ (wanted - values))
            trial = np.clip(logs + np.clip(step, -1, 1), np.log([0.05, 1e-3, 1e-3, 1e-3, 1e-4, 1e-4, 1e-4]),
                            np.log([3.5, 150, 40, 20, 3, 0.08, 0.06]))
            found = run(part, np.exp(trial) + offset)[0]
            if np.sum((wanted - found) ** 2) < np.sum((wanted - values) ** 2):
                logs, values, damping = trial, found, damping / 3
            else:
                damping *= 5
            if damping > 1e8:
                break
        rms = math.sqrt(np.mean((wanted - values) ** 2))
        if best is None or rms < best[1]:
            best = (np.exp(logs) + offset, rms)
    return best

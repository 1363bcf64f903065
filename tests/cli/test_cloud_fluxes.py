"""Light that clouds send up and let through, against Mie's theory and adding of layers written here, of which the program has no line.

(Bohren and Huffman 1983, section 4.8; Wiscombe 1977, delta-M; Hansen and Travis 1974, section 3.)
"""

import functools
import math
import unittest

import numpy as np

import test_any_air

NODES = 16
UM, INDEX = 0.87, complex(1.328, 3.75e-7)  # of water: Hale and Querry 1973, Segelstein 1981
OFF = {gas: "off" for gas in ("h2o", "co2", "o3", "n2o", "co", "ch4", "o2", "nh3", "no", "no2", "so2", "n2")}


def amplitudes(x, m, terms):
    """Mie's coefficients a_n, b_n of spheres of size x, [size, order]."""
    y = x * m
    log_psi = np.zeros((terms + 16, x.size), complex)
    for n in range(terms + 15, 0, -1):
        log_psi[n - 1] = n / y - 1 / (log_psi[n] + n / y)
    a, b = (np.zeros((x.size, terms), complex) for _ in range(2))
    psi, before = np.sin(x), np.cos(x)
    chi, chi_before = np.cos(x), -np.sin(x)
    for n in range(1, terms + 1):
        alive = n <= x + 4.05 * np.cbrt(x) + 2
        with np.errstate(all="ignore"):
            psi, before = (2 * n - 1) / x * psi - before, psi
            chi, chi_before = (2 * n - 1) / x * chi - chi_before, chi
            xi, xi_before = psi - 1j * chi, before - 1j * chi_before
            for to, inner in ((a, log_psi[n] / m + n / x), (b, m * log_psi[n] + n / x)):
                to[:, n - 1] = np.where(alive, (inner * psi - before) / (inner * xi - xi_before), 0)
    return a, b


def droplets(radius_um, um, m, moments):
    """Extinction per geometric area, single-scattering albedo and Legendre moments of a gamma distribution of variance 0.1."""
    r = np.linspace(0.04, 3.4, 240) * radius_um
    weight = r ** (0.7 / 0.1) * np.exp(-r / (0.1 * radius_um))
    x = 2 * math.pi * r / um
    terms = int(x[-1] + 4.05 * x[-1] ** (1 / 3) + 2)
    a, b = amplitudes(x, m, terms)
    n = np.arange(1, terms + 1)
    factor = 2 / x**2
    extinction = factor * ((2 * n + 1) * (a + b).real).sum(1)
    scattering = factor * ((2 * n + 1) * (abs(a) ** 2 + abs(b) ** 2)).sum(1)
    cosine, step = np.polynomial.legendre.leggauss(terms + moments)
    pi, tau = (np.zeros((terms, cosine.size)) for _ in range(2))
    last, here = np.zeros_like(cosine), np.ones_like(cosine)
    for k in n:
        pi[k - 1], tau[k - 1] = here, k * cosine * here - (k + 1) * last
        last, here = here, ((2 * k + 1) * cosine * here - (k + 1) * last) / k
    share = (2 * n + 1) / (n * (n + 1))
    one, two = (a * share) @ pi + (b * share) @ tau, (a * share) @ tau + (b * share) @ pi
    intensity = (weight[:, None] * (abs(one) ** 2 + abs(two) ** 2)).sum(0)
    chi = [(step * intensity * np.polynomial.legendre.Legendre.basis(l)(cosine)).sum() for l in range(moments + 1)]
    area = weight * r**2
    return (area * extinction).sum() / area.sum(), (area * scattering).sum() / (area * extinction).sum(), np.array(chi) / chi[0]


class Layer:
    """Reflection and transmission of radiance, mean over azimuth, from above and from below."""

    def __init__(self, r, t, r_below=None, t_below=None):
        self.r, self.t = r, t
        self.r_below, self.t_below = (r, t) if r_below is None else (r_below, t_below)

    def over(self, other):
        one = np.eye(len(self.r))
        down, up = np.linalg.inv(one - self.r_below @ other.r), np.linalg.inv(one - other.r @ self.r_below)
        return Layer(self.r + self.t_below @ other.r @ down @ self.t, other.t @ down @ self.t,
                     other.r_below + other.t @ self.r_below @ up @ other.t_below, self.t_below @ up @ other.t_below)


def layer(depth, albedo, chi, mu, weight):
    peak = chi[2 * NODES]
    depth, albedo, chi = (1 - albedo * peak) * depth, (1 - peak) * albedo / (1 - albedo * peak), (chi - peak) / (1 - peak)
    doublings = max(0, math.ceil(math.log2(depth / 1e-6)))
    thin = depth / 2**doublings
    terms = np.arange(2 * NODES)
    p = np.array([np.polynomial.legendre.Legendre.basis(l)(mu) for l in terms])
    forth = (p * ((2 * terms + 1) * chi[:-1])[:, None]).T @ p
    back = (p * ((2 * terms + 1) * chi[:-1] * (-1.0) ** terms)[:, None]).T @ p
    into = thin / mu[:, None] * albedo / 2 * weight
    made = Layer(into * back, np.diag(np.exp(-thin / mu)) + into * forth)
    for _ in range(doublings):
        made = made.over(made)
    return made


def fluxes(layers, sun_deg):
    """Shares of sunlight on the top that go up there and down at the bottom. `layers`: depth, albedo, moments, from the top."""
    x, w = np.polynomial.legendre.leggauss(NODES)
    small = 1e-7
    mu, weight = np.append(0.5 * (x + 1), math.cos(math.radians(sun_deg))), np.append(0.5 * w, small)
    whole = None
    for described in layers:
        made = layer(*described, mu, weight)
        whole = made if whole is None else whole.over(made)
    sun = np.zeros(NODES + 1)
    sun[-1] = 1 / (2 * math.pi * small * mu[-1])
    return tuple(2 * math.pi * (weight * mu * (matrix @ sun)).sum() for matrix in (whole.r, whole.t))


RAYLEIGH = np.zeros(2 * NODES + 1)
RAYLEIGH[0], RAYLEIGH[2] = 1, 0.1
MOLECULES = 0.01505  # depth of all air at 0.87 um (Bodhaine et al. 1999)


class CloudFluxes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.extinction, cls.albedo, cls.chi = droplets(10.0, UM, INDEX, 2 * NODES)
        cls.at_550 = droplets(10.0, 0.55, complex(1.333, 2e-9), 2)[0]

    @staticmethod
    @functools.lru_cache
    def found(depth, sun_deg):
        document = {
            "ifov": 1,
            "scene": {"materials": {"lawn": {"reflectance": 0.2, "temperature": "288 K"}}, "objects": [{"plane": {}, "material": "lawn"}]},
            "light": {"sun": {"disc": {"zenith": f"{sun_deg} deg", "azimuth": "0 deg"}}},
            "atmosphere": {"profile": "US standard 1976", "gases": OFF, "aerosol": {"type": "none"},
                           "clouds": [{"kind": "water", "optical_depth": depth, "base": "1 km", "top": "2 km"}]},
            "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [2, 2]}},
                       "channels": [{"name": "one", "gaussian": {"center": f"{UM} um", "fwhm": "3 nm"}}]}}
        row = test_any_air.AnyAir().rows(document, [])[0]
        sunlight = float(row["solar_irradiance"]) * math.cos(math.radians(sun_deg))
        return float(row["sensor_up"]) / sunlight, (float(row["ground_direct"]) + float(row["ground_diffuse"])) / sunlight

    def right(self, depth, sun_deg, chi):
        cloud = depth * self.extinction / self.at_550
        above = math.exp(-2.0 / 8.2)  # of the air by weight, above the cloud's top; what is within it is put below
        return fluxes([(MOLECULES * above, 1.0, RAYLEIGH), (cloud, self.albedo, chi), (MOLECULES * (1 - above), 1.0, RAYLEIGH)], sun_deg)

    def test_are_those_of_added_layers(self):
        for depth, sun_deg in ((1, 50), (50, 30)):
            found, right = self.found(depth, sun_deg), self.right(depth, sun_deg, self.chi)
            for what, ours, theirs in zip(("up", "down"), found, right):
                with self.subTest(what=what, depth=depth, sun=sun_deg):
                    self.assertAlmostEqual(ours / theirs, 1, delta=0.003)

    def test_one_percent_of_side_scattering_is_seen(self):
        """Twin: every moment nearer to 1 by a hundredth of what it lacks."""
        faulty = 1 - 0.99 * (1 - self.chi)
        self.assertGreater(abs(self.found(50, 30)[1] / self.right(50, 30, faulty)[1] - 1), 0.006)


if __name__ == "__main__":
    unittest.main()

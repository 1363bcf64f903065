"""Opens the products of the synthetic image with another program and compares them with what was written.

check_rasters.py gdal|gdal-utm|spy FOLDER ROTATION_RAD; exits with 77 where a Python module is missing.
"""

import math
import sys

WIDTH, HEIGHT, CHANNELS = 31, 17, 5
WAVELENGTHS = [0.4 + 2.1 * c / (CHANNELS - 1) for c in range(CHANNELS)]


def radiance(x, y, c):
    u, v = (x + 0.5) / WIDTH, (y + 0.5) / HEIGHT
    disc = 1.0 if math.hypot(u - 0.5, v - 0.5) < 0.3 else 0.35
    return disc * (20 + 60 * math.exp(-0.5 * ((c + 1) / CHANNELS * 4 - 1.5) ** 2)) + 0.37 * x + 0.011 * y


def near(found, wanted, what, tolerance=1e-6):
    assert abs(found - wanted) <= tolerance * max(1.0, abs(wanted)), f"{what}: {found}, expected {wanted}"


def compare_values(values, what):
    for c in range(CHANNELS):
        for y in range(HEIGHT):
            for x in range(WIDTH):
                near(float(values[y][x][c]), radiance(x, y, c), f"{what} ({x}, {y}, {c})")


def need(module):
    try:
        return __import__(module, fromlist=["x"])
    except ImportError as error:
        print(f"the Python module is missing: {error}")
        sys.exit(77)


def check_gdal(folder, rotation, utm):
    numpy = need("numpy")
    gdal = need("osgeo.gdal")
    gdal.UseExceptions()
    right = (0.5 * math.cos(rotation), -0.5 * math.sin(rotation))
    down = (-0.5 * math.sin(rotation), -0.5 * math.cos(rotation))
    for name in ("radiance.img", "radiance.tif"):
        data = gdal.Open(f"{folder}/demo_{name}")
        assert data.GetDriver().ShortName == ("ENVI" if name.endswith("img") else "GTiff"), name
        assert (data.RasterXSize, data.RasterYSize, data.RasterCount) == (WIDTH, HEIGHT, CHANNELS), name
        for b in range(CHANNELS):
            band = data.GetRasterBand(b + 1)
            near(float(band.GetMetadataItem("wavelength")), WAVELENGTHS[b], f"{name} wavelength")
            assert band.GetMetadataItem("wavelength_units") == "Micrometers", name
            assert f"ch{b + 1}" in band.GetDescription(), (name, band.GetDescription())
        transform = data.GetGeoTransform()
        expected = (1000.0, right[0], down[0], 2000.0, right[1], down[1])
        for found, wanted in zip(transform, expected):
            near(found, wanted, f"{name} geotransform {transform}")
        if utm:
            system = data.GetSpatialRef()
            assert system.GetUTMZone() == 33, (name, system.ExportToWkt())
            assert "WGS" in system.GetAttrValue("DATUM"), name
        compare_values(numpy.moveaxis(data.ReadAsArray(), 0, 2), name)
    class_file = gdal.Open(f"{folder}/demo_quality_class.img")  # a band lives as long as its file is held
    classes = class_file.GetRasterBand(1)
    assert classes.DataType == gdal.GDT_Byte
    names = classes.GetRasterCategoryNames()
    assert names[:3] == ["converged", "unjudged", "samples"] and len(names) == 11, names
    assert classes.GetRasterColorTable().GetColorEntry(6)[:3] == (204, 46, 40)
    bits = gdal.Open(f"{folder}/demo_reasons.img")
    assert bits.GetRasterBand(1).DataType == gdal.GDT_UInt16
    assert "32 unseen light" in bits.GetMetadata("ENVI")["reason_bits"], bits.GetMetadata("ENVI")
    bits, classes = bits.ReadAsArray(), classes.ReadAsArray()
    for y in range(HEIGHT):
        for x in range(WIDTH):
            wide = 0.02 * ((x * 3 + y * 5) % 60) > 1.0000001
            assert bits[y][x] == (0 if not wide else 2 if y % 2 == 0 else 34), (x, y, bits[y][x])
            assert names[classes[y][x]] == ("converged" if not wide else "samples" if y % 2 == 0 else "unseen light")
    counts = gdal.Open(f"{folder}/demo_samples.img")
    assert counts.GetRasterBand(1).DataType == gdal.GDT_UInt32
    near(int(counts.ReadAsArray()[0][3][5]), 9 + (5 * 7 + 3 * 13) % 200, "samples")


def check_spy(folder):
    numpy = need("numpy")
    spectral = need("spectral")
    cube = spectral.open_image(f"{folder}/demo_radiance.img.hdr")
    assert cube.shape == (HEIGHT, WIDTH, CHANNELS), cube.shape
    assert cube.bands.band_unit == "Micrometers", cube.bands.band_unit
    for found, wanted in zip(cube.bands.centers, WAVELENGTHS):
        near(found, wanted, "wavelength")
    for found in cube.bands.bandwidths:
        near(found, 0.01, "fwhm")
    compare_values(numpy.asarray(cube.load()), "SPy")
    near(int(spectral.open_image(f"{folder}/demo_samples.img.hdr").read_pixel(3, 5)[0]), 9 + (5 * 7 + 3 * 13) % 200, "samples")


reader, folder, rotation = sys.argv[1], sys.argv[2], float(sys.argv[3])
if reader == "spy":
    check_spy(folder)
else:
    check_gdal(folder, rotation, reader == "gdal-utm")

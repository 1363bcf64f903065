"""What a reader sees in a product, as JSON: see.py READER FILE [VARIABLE]. Exits with 77 where the reader is not there."""

import importlib
import json
import sys


def need(module):
    try:
        return importlib.import_module(module)
    except ImportError as error:
        print(error)
        sys.exit(77)


def finite(values):
    return [[[None if v != v else round(float(v), 9) for v in row] for row in band] for band in values]


def rasterio(path, _):
    with need("rasterio").open(path) as data:
        return {"shape": [data.count, data.height, data.width], "epsg": data.crs.to_epsg() if data.crs else None,
                "wkt": data.crs.to_wkt() if data.crs else "", "transform": list(data.transform.to_gdal()),
                "nodata": str(data.nodata), "units": list(data.units), "names": list(data.descriptions),
                "colours": [c.name for c in data.colorinterp],
                "wavelengths": [data.tags(b + 1).get("wavelength") for b in range(data.count)],
                "overviews": data.overviews(1), "values": finite(data.read())}


def rioxarray(path, variable):
    need("rioxarray")
    data = need("xarray").open_dataset(path, engine="netcdf4", decode_coords="all")
    values = data[variable]
    return {"shape": list(values.shape), "dims": list(values.dims), "epsg": values.rio.crs.to_epsg() if values.rio.crs else None,
            "wkt": values.rio.crs.to_wkt() if values.rio.crs else "", "transform": list(values.rio.transform().to_gdal()),
            "nodata": str(values.encoding.get("_FillValue")), "units": values.attrs["units"],
            "wavelengths": [float(v) for v in data["wavelength"]], "wavelength_units": data["wavelength"].attrs["units"],
            "ancillary": values.attrs.get("ancillary_variables", ""), "conventions": data.attrs["Conventions"],
            "names": [str(v.decode() if isinstance(v, bytes) else v) for v in data["channel"].values],
            "values": finite(values.values)}


def spy(path, _):
    spectral = need("spectral")
    data = spectral.open_image(path + ".hdr")
    cube = data.load()
    return {"shape": [cube.shape[2], cube.shape[0], cube.shape[1]], "wavelengths": data.bands.centers,
            "units": data.bands.band_unit, "fwhm": data.bands.bandwidths, "header": data.metadata,
            "values": finite(need("numpy").moveaxis(need("numpy").asarray(cube), 2, 0))}


def qgis(path, _):
    need("qgis.core")
    core = sys.modules["qgis.core"]
    application = core.QgsApplication([], False)
    application.initQgis()
    layer = core.QgsRasterLayer(path, "layer")
    provider = layer.dataProvider()
    renderer = layer.renderer()
    extent = layer.extent()
    return {"valid": layer.isValid(), "shape": [layer.bandCount(), layer.height(), layer.width()],
            "crs": layer.crs().authid(), "crs_name": layer.crs().description(),
            "extent": [extent.xMinimum(), extent.yMinimum(), extent.xMaximum(), extent.yMaximum()],
            "renderer": renderer.type(),
            "colours": [renderer.redBand(), renderer.greenBand(), renderer.blueBand()] if renderer.type() == "multibandcolor" else [],
            "stretch": [[e.minimumValue(), e.maximumValue()] for e in (
                (renderer.redContrastEnhancement(), renderer.greenContrastEnhancement(), renderer.blueContrastEnhancement())
                if renderer.type() == "multibandcolor" else (renderer.contrastEnhancement(),))],
            "nodata": str(provider.sourceNoDataValue(1))}


if __name__ == "__main__":
    seen = {"rasterio": rasterio, "rioxarray": rioxarray, "spy": spy, "qgis": qgis}[sys.argv[1]](
        sys.argv[2], sys.argv[3] if len(sys.argv) > 3 else None)
    print(json.dumps(seen))

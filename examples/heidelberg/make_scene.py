#!/usr/bin/python3
"""Land cover, trees and a crown for the Heidelberg example, from the elevation model alone.

Land cover by rule, on cells of 25 m, after a median of 3 x 3 heights (the model holds treetops and roofs):
  1 water    below 122 m, at most 3 m above the lowest height within 250 m, and 4 m below the mean within 500 m, where
             a fifth of the cells within 100 m are so and where they hang together over 2 km or more: a river is long,
             gravel pits and errors of the model are not
  2 forest   steeper than 7 degrees and above 130 m, or steeper than 5 degrees above 170 m
  3 town     no forest, flatter than 6 degrees, below 135 m, with water on more than 2.5 % of the cells within 1.5 km
  4, 5 field bare soil and crop on the rest below 150 m, by parcels of about 350 m x 225 m, three in seven bare
  6 meadow   the rest
  7 floor    the forest where trees stand on it, see below
  8, 9, 10   streets, red roofs and grey roofs of the town, see below; what is left of 3 is gardens
and of the result the most frequent class in 3 x 3 cells, except for water. The map has cells of a third of that, 8.3 m,
with the most frequent class in 5 x 5 of them, which rounds the corners.

The town has streets every 67 m and 100 m along two directions that turn slowly from place to place, houses in three of
five cells along them, and gardens behind. A texture of the forest, which picks among crowns, holds stands of 75 m to
600 m that differ, and single crowns.

The tree is the crown of a voxel model (each voxel that it lists holds two square leaves of 0.25 m) about a
cylinder; it is copied onto forest cells of a window, one to each square of 8 m, at a random place, turn and size.
"""

import pathlib
import sys

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from osgeo import gdal, ogr

gdal.UseExceptions()
CELL_M = 25.0
RIVER_M = 2000.0
FINER = 3
ORIGIN_M = (478000.0, 5474000.0)
TREE_WINDOW_M = ((476900.0, 5474000.0), (478500.0, 5475700.0))
TREE_SPACING_M = 8.0
LEAF_M = 0.25
LEAVES_PER_VOXEL = 2


def over_window(values, radius, reduce):
    """`reduce` over the square of this radius in cells."""
    padded = np.pad(values, radius, mode="edge")
    for _ in range(2):
        padded = reduce(sliding_window_view(padded, 2 * radius + 1, axis=0), axis=-1).T
    return padded


def median_3(values):
    windows = sliding_window_view(np.pad(values, 1, mode="edge"), (3, 3))
    return np.median(windows.reshape(*values.shape, 9), axis=-1)


def long_pieces(mask, cells):
    """Of the pieces of the mask, joined across gaps of up to eight cells, those that reach this far."""
    joined = over_window(mask.astype(np.uint8), 4, np.max)
    source = gdal.GetDriverByName("MEM").Create("", mask.shape[1], mask.shape[0], 1)
    source.GetRasterBand(1).WriteArray(joined)
    shapes = gdal.GetDriverByName("MEM").Create("", mask.shape[1], mask.shape[0], 1)
    layers = ogr.GetDriverByName("Memory").CreateDataSource("")
    layer = layers.CreateLayer("pieces")
    gdal.Polygonize(source.GetRasterBand(1), source.GetRasterBand(1), layer, -1, ["8CONNECTED=8"])
    long = layers.CreateLayer("long")
    for piece in layer:
        west, east, low, high = piece.geometry().GetEnvelope()
        if np.hypot(east - west, high - low) >= cells:
            long.CreateFeature(piece)
    gdal.PushErrorHandler("CPLQuietErrorHandler")  # warns that rows and columns have no reference system
    gdal.RasterizeLayer(shapes, [1], long, burn_values=[1])
    gdal.PopErrorHandler()
    return mask & (shapes.ReadAsArray() == 1)


def land_cover(height):
    smooth = median_3(height)
    slope = np.degrees(np.arctan(np.hypot(*np.gradient(smooth, CELL_M))))
    water = (smooth < 122) & (smooth <= over_window(smooth, 10, np.min) + 3)
    water &= smooth < over_window(smooth, 20, np.mean) - 4
    water &= over_window(water.astype(float), 4, np.mean) > 0.2
    water[[0, -1], :] = water[:, [0, -1]] = False  # the model's rim is not terrain
    water = long_pieces(water, RIVER_M / CELL_M)
    forest = ~water & (((slope > 7) & (smooth > 130)) | ((slope > 5) & (smooth > 170)))
    town = (over_window(water.astype(float), 60, np.mean) > 0.025) & (slope < 6) & (smooth < 135) & ~water & ~forest
    row, column = np.indices(height.shape)
    parcel = (((row + column // 6) // 9) * 73856093) ^ (((column - row // 8) // 14) * 19349663)
    field = np.where(parcel % 7 < 3, 4, 5)
    classes = np.select([water, forest, town, smooth < 150], [1, 2, 3, field], 6)
    return np.where(water, 1, most_frequent(classes, 1))


def most_frequent(classes, radius):
    votes = [over_window((classes == k).astype(np.uint8), radius, np.sum) for k in range(1, 7)]
    return (np.argmax(votes, axis=0) + 1).astype(np.uint8)


def finer(classes, transform):
    """The map on cells of a third, with the floor under the trees."""
    fine = most_frequent(np.kron(classes, np.ones((FINER, FINER), dtype=np.uint8)), 2)
    (west, south), (east, north) = TREE_WINDOW_M
    column = [int(FINER * (x - transform[0]) / transform[1]) for x in (west, east)]
    row = [int(FINER * (y - transform[3]) / transform[5]) for y in (north, south)]
    window = fine[row[0]:row[1], column[0]:column[1]]
    window[window == 2] = 7
    return fine


def write_crown(voxels, path, random):
    """A unit of the crown's own metres, stem at x = y = 0 and ground at z = 0."""
    rows = [line.split()[:3] for line in voxels.read_text().splitlines()[6:]]
    places = np.array(rows, dtype=float) * 0.25
    places -= [places[:, 0].mean(), places[:, 1].mean(), places[:, 2].min() - 5.0]
    with path.open("w") as out:
        out.write("usemtl leaves\n")
        vertex = 1
        for place in np.repeat(places, LEAVES_PER_VOXEL, axis=0):
            along = random.normal(size=3)
            along /= np.linalg.norm(along)
            across = np.cross(along, random.normal(size=3))
            across /= np.linalg.norm(across)
            centre = place + random.uniform(0, 0.25, 3)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                x, y, z = centre + 0.5 * LEAF_M * (a * along + b * across)
                out.write(f"v {x:.3f} {y:.3f} {z:.3f}\n")
            out.write(f"f {vertex} {vertex + 1} {vertex + 2} {vertex + 3}\n")
            vertex += 4
    return places


def write_trees(height, classes, transform, path, random):
    (west, south), (east, north) = TREE_WINDOW_M
    x, y = np.meshgrid(np.arange(west, east, TREE_SPACING_M), np.arange(south, north, TREE_SPACING_M))
    x = (x + random.uniform(0, TREE_SPACING_M, x.shape)).ravel()
    y = (y + random.uniform(0, TREE_SPACING_M, y.shape)).ravel()
    column = (x - transform[0]) / transform[1]
    row = (y - transform[3]) / transform[5]
    wooded = classes[row.astype(int), column.astype(int)] == 2
    x, y, column, row = x[wooded], y[wooded], column[wooded] - 0.5, row[wooded] - 0.5
    c, r = column.astype(int), row.astype(int)
    u, v = column - c, row - r
    z = (1 - v) * ((1 - u) * height[r, c] + u * height[r, c + 1])
    z += v * ((1 - u) * height[r + 1, c] + u * height[r + 1, c + 1])
    turn, size = random.uniform(0, 360, x.size), random.uniform(0.7, 1.15, x.size)
    np.savetxt(path, np.column_stack([x, y, z - 0.3, turn, size]), fmt="%.3f", delimiter=",")
    return x.size


def write_over(model, path, values):
    """Values on a grid over the model's, of cells as many times finer as there are more of them."""
    rows, columns = values.shape
    raster = gdal.GetDriverByName("GTiff").Create(str(path), columns, rows, 1, options=["COMPRESS=DEFLATE"])
    west, dx, _, north, _, dy = model.GetGeoTransform()
    raster.SetGeoTransform([west, dx * model.RasterXSize / columns, 0, north, 0, dy * model.RasterYSize / rows])
    raster.SetProjection(model.GetProjection())
    raster.GetRasterBand(1).WriteArray(values)


def town(shape):
    """Classes of a town without an end."""
    row, column = np.indices(shape)
    turn = 0.4 * np.sin(row / 150.0) * np.cos(column / 190.0)
    along = (np.cos(turn) * column + np.sin(turn) * row).astype(int)
    across = (np.cos(turn) * row - np.sin(turn) * column).astype(int)
    from_street = np.minimum(np.minimum(along % 12, -along % 12), np.minimum(across % 8, -across % 8))
    chance = ((along * 73856093) ^ (across * 19349663)) % 1009 / 1009.0
    roof = (from_street > 0) & (from_street < 3) & (chance < 0.6)
    return np.select([from_street == 0, roof & (chance < 0.42), roof], [8, 9, 10], 3).astype(np.uint8)


def forest(shape, random):
    """Brightness of crowns, of four sizes of noise."""
    total = np.zeros(shape)
    for cells, weight in ((1, 1.0), (9, 0.8), (27, 0.8), (72, 0.8)):
        coarse = random.normal(size=[n // cells + 3 for n in shape])
        row, column = (np.arange(n) / cells for n in shape)
        r, c = row.astype(int), column.astype(int)
        v, u = (row - r)[:, None], (column - c)[None, :]
        corner = [coarse[r + i][:, c + k] for i in (0, 1) for k in (0, 1)]
        total += weight * ((1 - v) * ((1 - u) * corner[0] + u * corner[1]) + v * ((1 - u) * corner[2] + u * corner[3]))
    return (128 + 35 * total).clip(0, 255).astype(np.uint8)


def main(data, folder):
    random = np.random.default_rng(1)
    model = gdal.Open(str(data / "scenes/dem/dem_hd.tif"))
    height = model.ReadAsArray().astype(float)
    classes = land_cover(height)
    fine = finer(classes, model.GetGeoTransform())
    fine = np.where(fine == 3, town(fine.shape), fine)
    write_over(model, folder / "land_cover.tif", fine)
    write_over(model, folder / "forest.tif", forest(fine.shape, random))
    write_crown(data / "scenes/helios/trees/F_BR08_08_crown_250.vox", folder / "crown.obj", random)
    count = write_trees(height, classes, model.GetGeoTransform(), folder / "trees.csv", random)
    shares = ", ".join(f"{name} {100 * (classes == k).mean():.1f} %" for k, name in
                       enumerate(["water", "forest", "town", "bare soil", "crop", "meadow"], 1))
    print(f"land cover: {shares}; {count} trees")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))

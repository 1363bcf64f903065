"""More rows for the table of test_mistakes.py: spectra, cities, terrains, copies, sensors, weather, air and maps."""

import json

from mistaken_document import CAMERA, ERROR, FRAME, GOOD, MATERIALS, OBJECTS, WARM, WARNING, ascii_grid, changed, several


def lawn(**reflectance):
    return changed(MATERIALS + ".lawn", {"reflectance": reflectance, "temperature": "22 degC"})


def town(material="wall", **city):
    return changed(OBJECTS + "[1]", {"city": {"file": "town.json", **city}, "material": material})


def coloured(file, keys=None):
    return changed(OBJECTS + "[+]", {"mesh": {"file": file}, "material": {"from_file": keys or {}}, "temperature": "20 degC"})


FACE = "v 6 0 0\nv 7 0 0\nv 7 0 1\n"


def terrain(**keys):
    return changed(OBJECTS + "[0]", {"terrain": {"file": "dem.asc", **keys}, "material": "lawn"})


TREE = {"tree": [{"cylinder": {"base": ["0 m", "0 m", "0 m"], "radius": "0.2 m", "height": "2 m"}, "material": "wall"}]}


def with_trees(entry):
    return several(("scene.prototypes", TREE), (OBJECTS + "[+]", entry))


def scatter(**keys):
    area = {"low": ["-5 m", "-5 m"], "high": ["5 m", "5 m"]}
    return with_trees({"random_placement": {"of": "tree", "density": "0.1 m-2", "area": area, **keys}})


def house(**transform):
    return changed(OBJECTS + "[1].transform", transform)


def frame(**keys):
    return changed(CAMERA, {"frame": {k: v for k, v in {**FRAME, **keys}.items() if v is not None}})


def red(**shape):
    return changed("sensor.channels[0]", {"name": "red", **shape})


def air(**keys):
    return several(("light.sky", None), ("light.surroundings", None), ("atmosphere", {"profile": "mid-latitude summer", **keys}))


def sounding(*levels):
    return air(levels=[dict(zip(("altitude", "pressure", "temperature"), level)) for level in levels])


def imported(**keys):
    return several(("light.sky", None), ("light.surroundings", None), ("atmosphere", {"imported": keys}))


def moon(**keys):
    return several(("light.sun", None), ("light.moon", keys))


def measured_brdf():
    """Light from 60 deg seen upright is a quarter brighter than the other way round."""
    rows = [(i, o, a, um, 0.1 if i > o else 0.08) for i in (0, 60) for o in (0, 60) for a in (0, 180) for um in (0.5, 12)]
    return "light,view,azimuth,wavelength,BRDF\n" + "".join(",".join(map(str, row)) + "\n" for row in rows)


def classes(names, file="classes.asc"):
    return changed(OBJECTS + "[0].material", {"map": {"file": file, "classes": names}})


TEXT = json.dumps(GOOD, indent=1)

MISTAKES = [
    ("classes of another frame", classes({"5": "lawn"}, "elsewhere.asc"), WARNING,
     "map '.*elsewhere.asc' covers x 440000 to 440048 m, .*, and all of the scene lies at x .*: everything gets the value of its nearest cell"),
    # Materials and spectra files.
    ("a reflectance that is a name", changed(MATERIALS + ".lawn.reflectance", "grass"), ERROR, 'the text "grass", expected a number between 0 and 1'),
    ("a percentage of emissivity", changed(MATERIALS + ".lawn", {"emissivity": 95, "temperature": "22 degC"}), ERROR, "95 % is 0.95"),
    ("a model of scattering without its parameters", changed(MATERIALS + ".wall.scattering", "oren_nayar"), ERROR,
     'which needs its parameters: {"oren_nayar": {"slope": ...}}'),
    ("a field that sends back more than arrives", changed(MATERIALS + ".wall", {"reflectance": 0.6, "scattering": {"rpv": {"k": 0.8, "asymmetry": -0.1}}}), ERROR,
     "material 'wall': of light that comes .* deg from the normal it sends back 1.\\d+ times as much"),
    ("a field that sends back more than arrives in the infrared", changed(MATERIALS + ".wall", {
        "reflectance": {"table": {"wavelength": ["0.3 um", "2 um", "20 um"], "values": [0.2, 0.2, 0.6]}}, "scattering": {"rpv": {"k": 0.8, "asymmetry": -0.1}}}), ERROR,
     "material 'wall': of light of 20 um that comes 89 deg from the normal it sends back 1.\\d+ times as much; its parameters belong to no passive surface"),
    ("a model of leaves without its weights", changed(MATERIALS + ".wall.scattering", {"ross_li": {"f_geo": 0.01}}), ERROR, "lacks the key 'f_vol'"),
    ("a way to scatter that is not there", changed(MATERIALS + ".wall.scattering", "specular"), ERROR, "there is no scattering model 'specular'; there are 'lambertian', 'mirror', 'oren_nayar', 'ross_li', .*'shell_target' and 'maignan'"),
    ("a way to scatter that is misspelt", changed(MATERIALS + ".wall.scattering", {"ros_li": {"f_vol": 0.1, "f_geo": 0.1}}), ERROR,
     "there is no scattering model 'ros_li'; did you mean 'ross_li'\\? There are 'lambertian'"),
    ("parameters of a mirror", changed(MATERIALS + ".wall.scattering", {"mirror": {"roughness": 0.1}}), ERROR, "'mirror' has no parameters: write \"scattering\": \"mirror\""),
    ("a reflectance left to a model that has none", changed(MATERIALS + ".wall", {"scattering": {"oren_nayar": {"slope": "10 deg"}}}), ERROR,
     "needs exactly one of 'reflectance' or 'emissivity': 'oren_nayar' scattering has no reflectance of its own"),
    ("grains of snow as large as a hand", changed(MATERIALS + ".wall.scattering", {"snow": {"grain": "10 cm"}}), ERROR, "grain.*expected a length between 0.02 and 5 mm"),
    ("a measured BRDF that is not there", changed(MATERIALS + ".wall.scattering", {"table": {"file": "no.csv"}}), ERROR, "no.csv"),
    ("a measured BRDF that is not reciprocal", changed(MATERIALS + ".wall", {"reflectance": 1, "temperature": "30 degC", "scattering": {"table": {"file": "tile.csv"}}}), ERROR,
     "not reciprocal by 22.2 %: at 0.5 um light from 60 deg seen from 0 deg, azimuth 0 deg, has a BRDF of 0.1 /sr, and with both exchanged 0.08"),
    ("a measured BRDF that is repaired", changed(MATERIALS + ".wall", {"reflectance": 1, "temperature": "30 degC", "scattering": {"table": {"file": "tile.csv", "repair": True}}}), WARNING,
     "material 'wall': the mean of both directions is taken, which differ by up to 22.2 %"),
    ("a measured BRDF with a hole", changed(MATERIALS + ".wall.scattering", {"table": {"file": "hole.csv"}}), ERROR,
     "no row for light 60 deg, view 60 deg, azimuth 180 deg, 12 um"),
    ("a sheet that lets through more than is left", changed(MATERIALS + ".wall.scattering", {"table": {"file": "white.csv", "transmitted": "white.csv"}}), ERROR,
     "at 0.5 um it sends back and lets through 1.\\d+ times what comes 0 deg from the normal"),
    ("a table that turns and has no azimuths", changed(MATERIALS + ".wall.scattering", {"table": {"file": "white.csv", "direction": "10 deg"}}), ERROR,
     "'direction' is of tables with azimuths of light and view; this one has none"),
    ("ground glass so smooth that the Sun is missed", changed(MATERIALS + ".wall", {"reflectance": 1, "scattering": {"rough_boundary": {"n": 1.5, "k": 0, "roughness": 0.1}}}), ERROR,
     "material 'wall' has a roughness of 0.1; under a Sun it has to be 0.4 or more at its index of 1.5"),
    ("a grain that scatters less than nothing", changed(MATERIALS + ".wall.scattering", {"hapke": {"b": 1.2}}), ERROR,
     "hapke: the phase function would be -0.2, below 0, at a phase angle of 180 deg"),
    ("a metal without its roughness", changed(MATERIALS + ".wall.scattering", "rough_conductor"), ERROR,
     'which needs its parameters: {"rough_conductor": {"roughness": ...}}'),
    ("a metal that is not known", changed(MATERIALS + ".wall.scattering", {"rough_conductor": {"index": "gould", "roughness": 0.1}}), ERROR,
     "the text \"gould\", expected .*'gold'"),
    ("an index below 0", changed(MATERIALS + ".wall.scattering", {"rough_conductor": {"n": -1, "k": 2, "roughness": 0.1}}), ERROR,
     "'n' is -1, below 0.01: it lies between 0.01 and 1000"),
    ("an index of 0", changed(MATERIALS + ".wall.scattering", {"rough_conductor": {"n": 0, "k": 2, "roughness": 0.1}}), ERROR,
     "'n' is 0, below 0.01: it lies between 0.01 and 1000"),
    ("an index file below 0", changed(MATERIALS + ".wall.scattering", {"rough_conductor": {
        "n": {"csv": "index.csv", "wavelength_unit": "um"}, "k": 2, "roughness": 0.1}}), ERROR,
     "'n' is -1.5 at some wavelength, below 0.01: it lies between 0.01 and 1000"),
    ("a metal whose roughness is misspelt", changed(MATERIALS + ".wall.scattering", {"rough_conductor": {"index": "gold", "roughnes": 0.1}}), ERROR,
     "unknown key 'roughnes' in 'scene.materials.wall.scattering.rough_conductor'; did you mean 'roughness'\\?"),
    ("a metal of which the roughness is left out", changed(MATERIALS + ".wall.scattering", {"rough_conductor": {"index": "gold"}}), ERROR,
     "lacks the key 'roughness': a number between 0 and 1"),
    ("glass on a sheet", several((MATERIALS + ".wall", {"scattering": {"smooth": {"n": 1.5, "k": 0}}}),
                                 (OBJECTS + "[1]", {"polygon": {"vertices": [["0 m", "0 m", "1 m"], ["1 m", "0 m", "1 m"], ["1 m", "1 m", "1 m"]]}, "material": "wall"})), ERROR,
     "light is refracted into 'wall', but this shape has no inside: take a solid"),
    ("a sea in a storm", changed(MATERIALS + ".wall.scattering", {"sea": {"wind": 20}}), WARNING,
     "a wind of 20 m/s is above the 14 m/s up to which Cox and Munk \\(1954\\) measured the slopes of the sea"),
    ("snow in the thermal infrared", changed(MATERIALS + ".wall", {"temperature": "-4 degC", "scattering": {"snow": {"grain": "0.5 mm"}}}), WARNING,
     "material 'wall': the theory of its scattering holds to 1.3\\d? um; in 'thermal' it is only about right"),
    ("absorption below 0", changed(MATERIALS + ".wall.scattering", {"rough_conductor": {
        "n": 1, "k": {"table": {"wavelength": ["0.3 um", "20 um"], "values": [1, -0.5]}}, "roughness": 0.1}}), ERROR,
     "'k' is -0.5 at some wavelength, below 0: it lies between 0 and 1000"),
    ("an index by name and by value", changed(MATERIALS + ".wall.scattering", {"rough_conductor": {"index": "gold", "n": 1, "roughness": 0.1}}), ERROR,
     "either by its name, 'index', or as 'n' and 'k', not by both"),
    ("roughness of 0", changed(MATERIALS + ".wall.scattering", {"rough_conductor": {"index": "gold", "roughness": 0}}), ERROR,
     "a 'roughness' of 0 is below 0.01: .* a smooth surface is 'smooth', by its refractive index, or 'mirror'"),
    ("a coat thinner than air", changed(MATERIALS + ".wall.scattering", {"rough_dielectric": {"index": 0.9, "roughness": 0.1}}), ERROR,
     "'index' is 0.9, below 1: it lies between 1 and 10"),
    ("a plastic that sends back more than arrives", changed(MATERIALS + ".wall", {"reflectance": 0.6, "scattering": {"ward": {"specular": 0.6, "roughness": 0.1}}}), ERROR,
     "material 'wall': of light that comes .* deg from the normal it sends back 1.\\d+ times as much"),
    ("a polished metal by a lamp", several((MATERIALS + ".wall.scattering", {"rough_conductor": {"index": "gold", "roughness": 0.05}}),
                                           ("light.sources", [{"point": {"at": ["9 m", "0 m", "9 m"], "temperature": "3000 K"}}])), WARNING,
     "material 'wall' has a lobe of roughness 0.05: what lobes narrower than 0.1 throw on other surfaces of the light of what outshines the scene, .*pixels are marked that it may reach"),
    ("a metal beyond what was measured", changed(MATERIALS + ".wall.scattering", {"rough_conductor": {"index": "lead", "roughness": 0.1}}), ERROR,
     "refractive index of lead"),
    ("a sea without a wind", changed(MATERIALS + ".wall.scattering", "sea"), ERROR, 'which needs its parameters: {"sea": {"wind": ...}}'),
    ("a sea that is too calm", changed(MATERIALS + ".wall.scattering", {"sea": {"wind": 1}}), ERROR,
     "a wind of 1 m/s is below 1.6 m/s: .* calm water is {\"smooth\": {\"index\": \"water\", \"over\": \"absorber\"}}"),
    ("a leaf of half its matter", changed(MATERIALS + ".wall", {"reflectance": 1, "scattering": {"leaf": {"version": "PRO", "proteins": 0.001}}}), ERROR,
     "'carbon' is missing: version PRO of PROSPECT needs 'proteins' and 'carbon', such as 0.001 and 0.008"),
    ("a map of a parameter that is not there", changed(MATERIALS + ".wall.scattering", {"oren_nayar": {"slope": {"map": {"file": "no.tif"}}}}), ERROR, "no.tif"),
    ("a slope steeper than any by a map", changed(MATERIALS + ".wall.scattering", {"oren_nayar": {"slope": {"map": {"file": "voids.asc", "offset": "70 deg"}}}}), ERROR,
     "0 at row 1, column 1 of '.*voids.asc' makes 'slope' 70 deg; it lies between 0 and 60 deg"),
    ("a map of a parameter with a void", changed(MATERIALS + ".wall.scattering", {"oren_nayar": {"slope": {"map": {"file": "voids.asc"}}}}), ERROR,
     "no number at row 2, column 2 of '.*voids.asc': a map of 'slope' needs one in every cell"),
    ("a map of an index", changed(MATERIALS + ".wall.scattering", {"rough_dielectric": {"roughness": 0.2, "index": {"map": {"file": "voids.asc"}}}}), ERROR,
     "'index' cannot be a map"),
    ("a sheet with a side of nothing known", changed(MATERIALS + ".sheet", {"front": "wall", "back": "walls"}), ERROR, "there is no material 'walls'; did you mean 'wall'"),
    ("a leaf that transmits twice", changed(MATERIALS + ".wall", {"reflectance": 1, "transmittance": 0.2, "scattering": {"leaf": {"dry_matter": 0.01}}}),
     ERROR, "'leaf' says itself what it transmits; leave 'transmittance' out"),
    ("paint without an index", changed(MATERIALS + ".wall.scattering", {"priest_germer": {"slope": 0.2}}), ERROR,
     "a refractive index is given by its name, 'index', or as 'n' and 'k'"),
    ("paint that is too smooth", changed(MATERIALS + ".wall.scattering", {"priest_germer": {"n": 1.4, "k": 0, "slope": 0.05}}), ERROR,
     "a 'slope' of 0.05 is below 0.0707"),
    ("a target without its obscuration", changed(MATERIALS + ".wall.scattering", {"maxwell_beard": {"n": 1.4, "k": 0, "slope": 0.2, "omega": "8 deg"}}),
     ERROR, "'tau'"),
    ("land without its coefficient", changed(MATERIALS + ".wall.scattering", "maignan"), ERROR,
     'which needs its parameters: {"maignan": {"coefficient": ...'),
    ("several curves and no texture", changed(MATERIALS + ".lawn.reflectance", [0.1, 0.2]), ERROR, "several curves need a 'texture'"),
    ("no materials", changed("scene.materials", {}), ERROR, "there is no material 'lawn' \\(none is declared\\)"),
    ("a group for a material of the library", lawn(library="grass"), ERROR, "no material 'grass'; near it: .*'grass, lawn'"),
    ("wavelengths that fall", lawn(table={"wavelength": ["2 um", "1 um", "15 um"], "values": [0.1, 0.2, 0.3]}), ERROR, "does not rise"),
    ("more wavelengths than values", lawn(table={"wavelength": ["0.3 um", "1 um", "15 um"], "values": [0.1, 0.2]}), ERROR, "has 2 values for 3 wavelengths"),
    ("wavelengths without a unit", lawn(table={"wavelength": [0.3, 15], "values": [0.1, 0.2]}), ERROR, "0.3 without a unit, expected a wavelength"),
    ("a table of which nobody says the unit", lawn(csv="um.csv"), ERROR, "lacks the key 'wavelength_unit': 'um' or 'nm'"),
    ("a column that is not there", lawn(csv="um.csv", wavelength_unit="um", column=3), ERROR, "um.csv:2: found 2 columns; column 3 is wanted"),
    ("a table with a heading alone", lawn(csv="empty.csv", wavelength_unit="um"), ERROR, "empty.csv: found no row of numbers"),
    ("a word among the numbers", lawn(csv="gap.csv", wavelength_unit="um"), ERROR, "gap.csv:3:3: found 'n/a'; expected a number"),
    ("a wavelength twice", lawn(csv="twice.csv", wavelength_unit="um"), ERROR, "twice.csv:4: found a wavelength twice"),
    ("a spreadsheet", lawn(csv="sheet.xlsx", wavelength_unit="um"), ERROR, "sheet.xlsx: found no row of numbers"),
    ("channels that the library marks as deleted", lawn(csv="deleted.csv", wavelength_unit="um"), ERROR, "must lie between 0 and 1; it reaches from -1.23e\\+34"),
    ("a table taken for a file of ECOSTRESS", lawn(ecostress="um.csv"), ERROR, "um.csv: the header has no 'X Units:' line"),
    ("a library without its header", lawn(sli="library.sli", spectrum=1), ERROR, "found no header \\(.hdr\\) beside '.*library.sli'"),
    # City models and terrains.
    ("CityGML for CityJSON", town(file="town.gml"), ERROR, "town.gml:1:1: unexpected '<'"),
    ("GeoJSON for CityJSON", town(file="geo.json"), ERROR, 'geo.json:1:9: \'type\' is the text "FeatureCollection", expected "CityJSON"'),
    ("a city without materials for the ground", town({"slots": {"RoofSurface": "wall"}}), ERROR, "no material for the surfaces 'GroundSurface' of the Building 'h1'"),
    ("a level of detail that no building has", town(lod="3"), ERROR, "no object has the level of detail 3; the file has '1.2'"),
    ("a type in small letters", town(types=["building"]), ERROR, "no object is of a type asked for; the file has 'Building'"),
    ("a city on the map, and no origin", town(file="far.json"), WARNING, "state its easting and northing as 'origin'"),
    ("a band that the terrain has not", terrain(band=3), ERROR, "dem.asc has no band 3; it has 1"),
    ("a terrain on the map, and no origin", terrain(file="elsewhere.asc"), WARNING, "a terrain.*km from the picture: are its coordinates of another frame"),
    ("a terrain with voids", terrain(file="voids.asc"), WARNING, "1 of 16 cells have no height; they are holes"),
    ("a terrain with voids that nobody declared", terrain(file="undeclared.asc"), ERROR, "-32768 at row 2, column 2 is no height in metres.*-a_nodata -32768"),
    ("a rule that is misspelt", town({"slots": {"RoofSurfaces": "wall", "other": "wall"}}), WARNING, "has 'RoofSurfaces', which no surface is; is 'RoofSurface' meant"),
    ("a corner of a terrain without its size", terrain(low_left=["0 m", "0 m"]), ERROR, "'low_left' needs the key 'size' beside it"),
    # Copies.
    ("copies of what is not there", with_trees({"instances": {"of": "oak", "at": [["6 m", "0 m", "0 m"]]}}), ERROR, "there is no prototype 'oak' \\(declared: 'tree'\\)"),
    ("a prototype within itself", several(("scene.prototypes", {"tree": [{"instance": {"of": "tree"}}]}), (OBJECTS + "[+]", {"instance": {"of": "tree"}})), ERROR, "the prototype 'tree' holds itself"),
    ("a list of x and y", with_trees({"instances": {"of": "tree", "csv": "xy.csv"}}), ERROR, "xy.csv:2: found 2 fields; expected 3, 4, 5 or 7 numbers"),
    ("a list that begins with numbers of trees", with_trees({"instances": {"of": "tree", "csv": "numbered.csv"}}), ERROR, "numbered.csv:1:4: found 'x' as column 2"),
    ("copies of no size", with_trees({"instances": {"of": "tree", "csv": "flat.csv"}}), ERROR, "flat.csv:1:9: the scale is 0"),
    ("a density so low that nothing stands", scatter(density="0.1 ha-1"), WARNING, "random placement of .*tree.*: no copies stand there, 0.001 are expected on its 100 m2"),
    ("a density without a unit", scatter(density=0.1), ERROR, 'expected a density above 0 m-2, such as "300 ha-1"'),
    ("trees closer than they may stand", scatter(density="1 m-2", minimum_distance="4 m"), WARNING, "at a distance of 4 m at least, .* stand, not 1e\\+04 ha-1 as asked for"),
    ("trees on what has no name", scatter(on="terrain"), ERROR, "there is no object with a shape of its own 'terrain' \\(declared: 'house'\\)"),
    ("an area inside out", scatter(area={"low": ["5 m", "5 m"], "high": ["-5 m", "-5 m"]}), ERROR, "is not above 'low' in both coordinates"),
    ("a turn without a unit", house(rotate={"angle": 45}), ERROR, "the number 45 without a unit, expected an angle"),
    ("a mirrored house", house(scale=[1, -1, 1]), ERROR, "is the number -1, expected a number above 0"),
    ("a shift to the side alone", house(translate=["1 m", "2 m"]), ERROR, "is a list of 2, expected a list of 3"),
    # The sensor.
    ("a camera that looks nowhere", frame(look_at=None), ERROR, "needs exactly one of 'look_at' or 'attitude'"),
    ("up along the line of sight", frame(up=[0, 50, -100]), ERROR, '"up" is parallel to its line of sight'),
    ("two cameras", changed(CAMERA + ".frame", FRAME), ERROR, "'frame' cannot stand beside 'orthographic'"),
    ("a size in one number", changed(CAMERA + ".orthographic.pixels", 640), ERROR, "the number 640, expected a list of 2"),
    ("more pixels than there can be", changed(CAMERA + ".orthographic.pixels", [100000, 100000]), ERROR, "more than the 1000000000 allowed"),
    ("a blur in metres", changed("sensor.psf", {"gaussian": {"sigma": "0.5 m"}}), ERROR, "'m' is not a unit of number of pixels"),
    ("a filling in percent", changed("sensor.fill_factor", 85), ERROR, "expected a number between 0 \\(excluded\\) and 1"),
    ("a width in micrometres", red(gaussian={"center": "0.65 um", "fwhm": "40 um"}), ERROR, "'red': a Gaussian at 0.65 um with a width of 40 um is not possible"),
    ("a response in nanometres called um", red(tabulated={"file": "response.csv", "wavelength_unit": "um"}), WARNING, "'red' are above 100 um: are they nm"),
    ("a noise in kelvins", changed("sensor.channels[1].noise", "0.05 K"), ERROR, "'K' is not a unit of spectral radiance"),
    ("an error in noise, of a channel without", several(("sensor.channels[1].noise_temperature", "0.05 K"), ("sampling.accuracy", {"error": "0.5 noise"})), ERROR, "channel 'red' has none above 0"),
    # Weather, time and air.
    ("humidity without a percent sign", changed("weather", {"air_temperature": "25 degC", "humidity": 60}), ERROR, "expected a percentage between 0 and 100 %"),
    ("cloud in eighths", changed("weather", {"air_temperature": "25 degC", "cloud": 8}), ERROR, "the number 8, expected a number between 0 and 1"),
    ("a thirteenth month", changed("time", "2026-13-21T12:00:00Z"), ERROR, "found the time '2026-13-21T12:00:00Z'; expected ISO 8601 with a zone"),
    ("a profile in other words", air(profile="midlatitude summer"), ERROR, "did you mean 'mid-latitude summer'"),
    ("ozone in atmosphere-centimetres", air(ozone="0.3 DU"), WARNING, "'ozone' of 0.3 DU is none that air on Earth has"),
    ("carbon dioxide as a share", air(co2="0.00042 ppm"), WARNING, "'co2' of 0.00042 ppm is none .*about 420 ppm"),
    ("a haze thicker than any", air(aerosol={"visibility": "23 m"}), ERROR, "visibility of 0.023 km: expected 0.05 to 300 km"),
    ("a sounding from above", sounding(("1 km", "900 hPa", "10 degC"), ("0 m", "1013 hPa", "15 degC")), ERROR, "the altitudes of a profile must rise: 0 km follows 1 km"),
    ("pressures that rise", sounding(("0 m", "900 hPa", "15 degC"), ("1 km", "1013 hPa", "10 degC")), ERROR, "the pressures of a profile must fall: 1013 hPa follows 900 hPa"),
    ("degrees of a sounding as kelvins", sounding(("0 m", "1013 hPa", "15 K"), ("1 km", "900 hPa", "10 K")), ERROR, "temperature 15 K at 0 km: expected 120 to 350 K"),
    ("an atmosphere of another kind of file", imported(files=["um.csv"]), ERROR, "um.csv: found no file that is known here; expected a MODTRAN tape7"),
    ("albedos in percent", imported(files=["um.csv"], albedos=[30]), ERROR, "30 % is 0.3"),
    ("a Moon without a phase", moon(zenith="30 deg", azimuth="90 deg"), ERROR, "the Moon has no phase: give 'phase_angle', or the document's 'time'"),
    ("a Moon without a place", moon(), ERROR, "the Moon has no direction"),
    # Maps, output and text.
    ("a class without a material", classes({"1": "lawn"}), ERROR, "class 2 at row 1, column 2 of '.*classes.asc' has no material; the classes given are 1"),
    ("names for class numbers", classes({"grass": "lawn"}), ERROR, "the key 'grass' is not a class number"),
    ("fractions for classes", classes({"0": "lawn", "1": "wall"}, "fractions.asc"), ERROR, "class 0.2 at row 1, column 1 of '.*fractions.asc' has no material"),
    ("colours of a mesh without a library", coloured("bare.obj"), ERROR, "bare.obj: the file names no material library .mtllib."),
    ("a picture that is not there", coloured("hut.obj"), ERROR, "hut.mtl:4:8: there is no image '.*gone.png'"),
    ("a picture that is a table", coloured("sheet.obj"), ERROR, "sheet.mtl:2:8: .*empty.csv: not an image of a kind that is read"),
    ("a colour brighter than white", coloured("glow.obj"), ERROR, "glow.mtl:2:6: expected a number from 0 to 1, found '1.5'"),
    ("a slot of which the library says nothing", coloured("gate.obj"), ERROR, "'flat.mtl' says no colour of the slot 'door' of the mesh .it has 'paint'."),
    ("colours of a sphere", changed(OBJECTS + "[1].material", {"from_file": {}}), ERROR, "only a mesh has materials 'from_file'"),
    ("a colour of sRGB beyond bytes", coloured("flat.obj", {"colours": [{"srgb": [300, 0, 0], "material": "wall"}]}), ERROR, "between 0 and 255"),
    ("a colour of a mesh seen in the thermal infrared", coloured("flat.obj"), WARNING, "EMISSIVITY FROM A COLOUR: in .* 'paint' of 'flat.obj'"),
    ("a colour taken for a reflectance", coloured("flat.obj"), WARNING, "the reflectance of 'paint' of 'flat.obj' is a guess: made of colours"),
    ("an included document that is not there", changed("include", "gone.json"), ERROR, "gone.json"),
    ("a document that includes itself", changed("include", "scene.json"), ERROR, "include"),
    ("polarization of a sensor that does not tell it", changed("output.products", ["quality", "dolp", "aop"]), ERROR,
     r"json:\d+:\d+: .*output.products has 'dolp' and 'aop': that takes a sensor with \"stokes\": true, and sensor.stokes is not given or false"),
    ("probes in an image that is judged as a whole", changed("sampling", {"accuracy": {"error": "2 %", "of": "image", "probes": 4}}), ERROR,
     "'probes' is of errors pixel by pixel"),
    ("an audit of single pixels", changed("sampling", {"accuracy": {"error": "2 %", "audit": 200}}), ERROR, "an audit is of an image"),
    ("pooling of single pixels", changed("sampling", {"accuracy": {"error": "2 %", "pooling": True}}), ERROR, "\"of\": \"image\" goes with it"),
    ("an audit larger than the image", changed("sampling", {"grid": {"elements": [2, 2], "audit": 90000}}), ERROR,
     "an audit of 90000 pixels is asked for, and the image has"),
    ("a lattice that is too fine", changed("sampling", {"accuracy": {"error": "2 %", "lattice": 40}}), ERROR, "expected an integer between 1 and 32"),
    ("a lattice too fine for its tiles", changed("sampling", {"accuracy": {"error": "2 %", "lattice": 8}, "tile": 2000}), ERROR,
     r"json:\d+:\d+: .*a lattice of 8 cells a pixel goes with a 'tile' of 1664 pixels at most, and it has 2000"),
    ("an audit of too few", changed("sampling", {"grid": {"elements": [2, 2], "audit": 5}}), ERROR, "20"),
    ("a word that says of what the error is", changed("sampling", {"accuracy": {"error": "2 %", "of": "picture"}}), ERROR, "'image'"),
    ("the error of an image of one pixel", several(("sampling", {"accuracy": {"error": "2 %", "of": "image"}}), (CAMERA + ".orthographic.pixels", [1, 1])), ERROR,
     "the image is one pixel"),
    ("an error of polarization of a sensor that does not tell it", changed("sampling", {"accuracy": {"error": "0.5 % DoLP"}}), ERROR,
     r"json:\d+:\d+: .*an error of 0.5 % DoLP is asked for, and the sensor does not tell polarization: give it \"stokes\": true, or the error in K"),
    ("a picture in a channel that is not there", changed("output.quicklook", {"channels": ["nir"]}), ERROR, "there is no channel 'nir'"),
    ("a key twice", TEXT.replace('"ifov": 1,', '"ifov": 1, "ifov": 1,'), ERROR, "twice"),
    ("a brace that is missing", TEXT[:-2], ERROR, "scene.json:\\d+:\\d+"),
    ("single quotes", TEXT.replace('"ifov"', "'ifov'"), ERROR, "'"),
]


def city_json(translate):
    corners = [[x, y, z] for z in (0, 4000) for x, y in ((0, 0), (6000, 0), (6000, 6000), (0, 6000))]
    faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    solid = {"type": "Solid", "lod": "1.2", "boundaries": [[[face] for face in faces]]}
    return json.dumps({"type": "CityJSON", "version": "2.0", "transform": {"scale": [0.001] * 3, "translate": translate},
                       "CityObjects": {"h1": {"type": "Building", "geometry": [solid]}}, "vertices": corners})


FILES = {
    "index.csv": "wavelength,n\n0.3,1.5\n1,-1.5\n15,1.4\n",
    "empty.csv": "wavelength,reflectance\n",
    "gap.csv": "wavelength,reflectance\n0.4,0.1\n1,n/a\n15,0.3\n",
    "twice.csv": "wavelength,reflectance\n0.4,0.1\n1,0.1\n1,0.2\n15,0.3\n",
    "deleted.csv": "0.4,0.1\n1,-1.23e34\n15,0.3\n",
    "sheet.xlsx": b"PK\x03\x04\x14\x00\x06\x00\x08\x00" + bytes(range(256)),
    "library.sli": b"\0" * 64,
    "town.json": city_json([-3, -3, 0]),
    "far.json": city_json([84000, 447000, 0]),
    "town.gml": "<?xml version='1.0'?><CityModel/>",
    "geo.json": '{"type":"FeatureCollection","features":[]}',
    "dem.asc": ascii_grid([[0] * 4] * 4, corner=(-20, -20), cell=12),
    "voids.asc": ascii_grid([[0] * 4, [0, -32768, 0, 0], [0] * 4, [0] * 4], corner=(-20, -20), cell=12, nodata=-32768),
    "elsewhere.asc": ascii_grid([[5] * 4] * 4, corner=(440000, 4470000), cell=12),
    "undeclared.asc": ascii_grid([[0] * 4, [0, -32768, 0, 0], [0] * 4, [0] * 4], corner=(-20, -20), cell=12),
    "numbered.csv": "id,x,y,z\n1,6,0,0\n2,6,4,0\n",
    "xy.csv": "x,y\n6,0\n",
    "flat.csv": "6,0,0,0,0\n",
    "response.csv": "wavelength,response\n600,0\n650,1\n700,0\n",
    "classes.asc": ascii_grid([[1, 2, 1, 1]] * 4),
    "tile.csv": measured_brdf(),
    "white.csv": "light,view,azimuth,wavelength,BRDF\n" + "".join(f"{i},{o},{a},{um},0.2\n" for i in (0, 60) for o in (0, 60) for a in (0, 180) for um in (0.5, 12)),
    "hole.csv": measured_brdf().rsplit("\n", 2)[0] + "\n",
    "bare.obj": FACE + "usemtl paint\nf 1 2 3\n",
    "hut.obj": "mtllib hut.mtl\n" + FACE + "usemtl roof\nf 1 2 3\nusemtl door\nf 1 3 2\n",
    "hut.mtl": "newmtl roof\nKd 0.5 0.2 0.1\n# a picture\nmap_Kd gone.png\n",
    "sheet.obj": "mtllib sheet.mtl\n" + FACE + "usemtl paint\nf 1 2 3\n",
    "sheet.mtl": "newmtl paint\nmap_Kd empty.csv\n",
    "glow.obj": "mtllib glow.mtl\n" + FACE + "usemtl paint\nf 1 2 3\n",
    "glow.mtl": "newmtl paint\nKd 1 1.5 1\n",
    "flat.obj": "mtllib flat.mtl\n" + FACE + "usemtl paint\nf 1 2 3\n",
    "gate.obj": "mtllib flat.mtl\n" + FACE + "usemtl door\nf 1 2 3\n",
    "flat.mtl": "newmtl paint\nKd 0.5 0.2 0.1\n",
    "fractions.asc": ascii_grid([[0.2, 0.5, 0.7, 1.0]] * 4),
}

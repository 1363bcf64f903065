"""Plants, ground and water."""
from .catalogue import DRY, SOIL, Curve, Material, canopy, mixed, prospect, slum, usgs

LEAF = "Single leaves; transmittance by PROSPECT-D fitted to the reflectance. "
CANOPY = ("Model of leaves in all directions over bare soil, light from 45 deg: leaves of PROSPECT-D, canopy by Goudriaan's "
          "formula. The curves differ in leaves, leaf area, dry parts and the shade of the surface's own form. ")
LAWN = "Lawn_Grass_GDS91"

VEGETATION = [
    Material("grass, lawn", "turf garden park green", CANOPY + "A lawn, green and slightly dry.",
             [canopy("green", "blade", 4, 0.05), canopy("slightly dry", "tired blade", 3, 0.05, dry=0.2)]),
    Material("grass, lawn, sparse", "turf park", CANOPY + "A thin lawn.", [canopy("sparse", "tired blade", 1, 0.05, dry=0.25)]),
    Material("grass, pasture", "agricultural grassland field", CANOPY + "Grazed and mown grassland.",
             [canopy("high", "blade", 3, 0.25), canopy("grazed", "tired blade", 1.8, 0.2, dry=0.2),
              canopy("short", "tired blade", 1.2, 0.2, dry=0.25)]),
    Material("meadow", "clover lucerne alfalfa field herbs", CANOPY + "A meadow of broad-leaved herbs.",
             [canopy("dense", "crop", 4, 0.15), canopy("tufted", "crop", 3, 0.4), canopy("open", "mature", 2.5, 0.3)],
             instead_of=("meadow, clover and lucerne",)),
    Material("grass, blades, pile", "lawn clippings green blade", "Green lawn grass, probably Kentucky bluegrass, in a pile without "
             "gaps, twice as bright in the near infrared as a lawn from above.",
             [usgs("GDS91", LAWN, "canopy"), mixed("GDS91, a quarter dry", (0.75, LAWN), (0.25, DRY), donor="canopy")],
             instead_of=("grass, wild oat, green", "grass, ripgut brome, green")),
    Material("grass, dry", "straw meadow senescent yellow litter hay", "Golden dry grass (1), a field of cheatgrass (2) and of "
             "goatgrass (3).",
             [usgs("GDS480", DRY, "dry grass"), usgs("ANPC1", "Cheatgrass_ANPC1", "dry grass"),
              usgs("AETR70", "Grass_AETR70", "dry grass")], instead_of=("grass, wild oat, dry",)),
    Material("reed, dry", "stems straw phragmites marsh", "Brown stems of common reed in a marsh.",
             [usgs("DWO-3-DEL-2a", "P.austr.", "dry grass")]),
    Material("crop, green", "field agriculture maize corn beet potato sunflower", CANOPY + "A field crop, closed and in rows.",
             [canopy("closed", "crop", 4.5, 0.2), canopy("half closed", "crop", 2, 0.25), canopy("in rows", "crop", 0.8, 0.2)],
             instead_of=("crop, sunflower", "crop, maize", "crop, sorghum", "crop, sugar beet", "crop, potato")),
    Material("tree crown, broadleaf", "canopy forest deciduous", CANOPY + "Crowns of deciduous trees.",
             [canopy(f"{leaf}, {shade:.0%} shade", leaf, 5, shade) for leaf, shade in (
                 ("mature", 0.3), ("mature", 0.4), ("young", 0.3), ("shade", 0.6), ("shade", 0.5), ("young", 0.45),
                 ("mature", 0.5), ("shade", 0.4))]),
    Material("tree crown, conifer", "canopy forest evergreen", CANOPY + "Crowns of conifers.",
             [canopy("new needles, 50% shade", "new needle", 5, 0.5), canopy("older needles, 55% shade", "old needle", 5, 0.55)]),
    Material("leaf, aspen", "broadleaf tree foliage populus", LEAF + "Populus tremuloides, green, two leaves.",
             [usgs("Leaf-A DW92-2", "Aspen_Leaf-A", "leaf", leaf=True), usgs("Aspen-1, upper face", "Aspen_Aspen-1", "leaf", leaf=True)],
             instead_of=("leaf, red maple", "leaf, eucalyptus")),
    Material("leaf, aspen, yellow", "broadleaf tree foliage populus autumn", LEAF + "Populus tremuloides, upper face.",
             [usgs("Aspen-4, upper face", "Aspen_Aspen-4", "leaf", leaf=True)]),
    Material("leaves, stacked", "foliage maple walnut manzanita bush", "Fresh leaves in a pile, brighter than one: maple (three thick), "
             "walnut, manzanita.",
             [usgs("Maple DW92-1", "Maple_Leaves", "leaf"), usgs("Walnut", "Walnut_Leaf_SUN", "leaf"),
              usgs("Manzanita", "Manzanita", "leaf")]),
    Material("leaves, willow, dry", "litter dead shrub", "Dried leaves (1) and a dead bush (2).",
             [usgs("Willow-Leaves-1", "Willow_Willow-Leaves-1", "dry grass"), usgs("FluvTailSite A", "Willow_Dead", "dry grass")]),
    Material("leaf, broadleaf, modelled", "tree foliage deciduous prospect",
             "PROSPECT-D, no measurement: contents chosen for each state, layers N, pigments in ug/cm2, water and dry matter in g/cm2.",
             [prospect("mature", 1.5, 45, 9, 1, 0, 0.012, 0.006), prospect("young", 1.3, 25, 6, 2, 0, 0.014, 0.004),
              prospect("shade", 1.4, 60, 11, 1, 0, 0.009, 0.0035), prospect("yellow, autumn", 1.7, 3, 8, 1, 0.15, 0.010, 0.006),
              prospect("red, autumn", 1.7, 6, 6, 12, 0.1, 0.010, 0.006),
              prospect("brown, dead", 2.4, 0.5, 1, 1, 1.5, 0.0005, 0.007, donor="dry grass")]),
    Material("leaf, evergreen shrub, modelled", "bush chaparral foliage leathery prospect",
             "PROSPECT-D, no measurement: a thick leathery leaf of dry country.",
             [prospect("leathery", 2.0, 40, 9, 1, 0.1, 0.014, 0.018)], instead_of=("leaf, chamise",)),
    Material("needle, conifer, modelled", "pine spruce fir evergreen foliage leaf prospect",
             "PROSPECT-D, no measurement; applicable to spruce needles with care (Z. Malenovsky et al., Int. J. Remote Sensing "
             "27 (2006) 5315). Contents chosen as for the modelled broadleaf.",
             [prospect("this year", 1.9, 35, 8, 1, 0.02, 0.025, 0.016), prospect("older", 2.3, 55, 12, 1, 0.15, 0.030, 0.024)]),
    Material("needles, conifer, pile", "pine spruce fir juniper evergreen canopy",
             "Needles in a pile: blue spruce, Engelmann spruce, lodgepole pine, pinyon, juniper.",
             [usgs("Blue spruce", "Blue_Spruce", "leaf"), usgs("Engelmann spruce", "Engelmann", "leaf"),
              usgs("Lodgepole pine", "Lodgepole", "leaf"), usgs("Pinyon", "Pinon", "leaf"), usgs("Juniper", "Juniper", "leaf")]),
    Material("lichen", "rock xanthoparmelia", "Green rock lichen.", [usgs("Xanthoparmelia-1", "Lichen", "dry grass")]),
]

SOIL_GROUP = [
    Material("soil, bare", "earth ground dirt loam field", "Brown rangeland with a twentieth of plants (1), and the same moist, by a "
             "model (2).",
             [usgs("rangeland", SOIL, "clay"), Curve("rangeland, moist", lambda library: library.moist(SOIL), donor="muck")],
             instead_of=("soil, bare, urban", "soil, brown sandy loam", "soil, brown silty loam", "soil, brown gravelly loam",
                         "soil, brown loamy sand", "soil, black loam", "cinder, red")),
    Material("soil, playa mud, pale", "earth ground dirt desert clay lake", "Dry mud of a playa, mean of 174 field spectra.",
             [usgs("Stonewall Playa", "Stonewall", "clay")], instead_of=("soil, pale gypsum loam",)),
    Material("soil, clay, pale", "earth ground dirt montmorillonite illite", "A tan powder of montmorillonite and illite.",
             [usgs("CM37", "Montmorillonite+Illite", "clay")]),
    Material("soil, burnt", "earth ground fire ash charcoal", "A severely burnt forest floor: topmost (1), along a traverse (2).",
             [usgs("WRF00-02", "BurnArea_Top", "muck"), usgs("WRF00-01", "BurnArea_Traverse", "muck")]),
    Material("sand, beach", "ground dune delta playground sandpit", "Clean dune sand (1) and sand of a river's delta (2).",
             [usgs("Grand Isle", "Sand_GrndIsle1", "quartz sand"), usgs("Delta", "Sand_DWO-3-DEL2a", "quartz sand")],
             instead_of=("sand, brown quartz", "sand, playground")),
    Material("sand, wet", "beach ground delta shore", "Wet sand of a delta's shore.",
             [usgs("Delta", "Sand_DWO-3-DEL2b", "quartz sand")]),
    Material("sand, quartz, white", "ground", "Pure quartz sand of commerce, Ottawa; the bands of quartz at 8 to 9.5 um have "
             "the shape of its measurement and the level of sands in the field.",
             [usgs("GDS74", "Quartz_GDS74_Sand_Ottawa_BECK", "quartz sand")]),
    Material("stone, granite", "rock gravel ballast rail track kerb", "Granites of London's streets and walls.",
             slum("G005", "G002", "G001", "G003", "G004"), instead_of=("railway ballast",)),
    Material("stone, sandstone", "rock wall building", "Sandstones of London's buildings.", slum("S001", "S003", "S005")),
    Material("stone, limestone", "rock wall building marble", "Limestones of London's buildings (S002, S004) and an outcrop.",
             slum("S004", "S002") + [usgs("CU02-11A", "Limestone", "limestone")], instead_of=("marble, white",)),
    Material("stone, quartzite conglomerate", "rock gravel pebbles", "Quartzite conglomerate.", slum("X001", "X002", "X003")),
]

WATER = [
    Material("water, pure", "tap clear surface", "The surface alone, at normal incidence: nothing returns from below.",
             [Curve("surface", lambda library: library.water())], instead_of=("water, tap",)),
    Material("water, coastal", "lake river pond sea", "Sea water with plankton (1) and of the open ocean (2): surface and depth "
             "together, as a diffuse surface.",
             [usgs("SW1, coast", "Seawater_Coast", "water"), usgs("SW2, open ocean", "Seawater_Open", "water")],
             instead_of=("water, lake",)),
    Material("water, turbid", "river pond flood mud", "Water with 0.5 (1) and 16.5 g/l (2) of clay.",
             [usgs("0.5 g/l", "Water+Montmor_SWy-2+0.50", "water"), usgs("16.5 g/l", "Water+Montmor_SWy-2+16.5", "water")]),
    Material("water, swimming pool", "clear blue", "Model: clear water over a light bottom.",
             [Curve("2 m deep", lambda library: library.pool())]),
    Material("ice", "frozen water", "The surface of clear ice alone, at normal incidence.",
             [Curve("surface", lambda library: library.ice())]),
    Material("snow, melting", "old granular firn wet slush", "Colorado snow that melts in the laboratory, from moist (1) to slush (3); "
             "its 1.6 um level (0.01 to 0.02) is below that of dry snow.",
             [usgs("moist", "Melting_snow_mSnw01a", "ice"), usgs("wet", "Melting_snow_mSnw05", "ice"),
              usgs("slush", "Melting_snow_mSnw12", "ice")], instead_of=("snow, fine", "snow, coarse")),
]

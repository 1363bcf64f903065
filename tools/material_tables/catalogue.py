"""What is in the library: every material with its curves. `eco` names files of the ECOSTRESS library, `berlin` spectra of
the Berlin image library; `kin` is the sample that lends figures where a curve was not measured."""
from dataclasses import dataclass, field

JHU = "jhu.becknic.spectrum.txt"


@dataclass
class Curve:
    name: str
    eco: tuple = ()
    berlin: str = ""
    table: str = ""        # file in tools/material_tables
    metal: str = ""        # Lorentz-Drude model
    prospect: tuple = ()   # N, Cab, Car, Cant, Cbrown, Cw, Cm
    kin: str = ""
    leaf: bool = False     # transmittance by a fit of PROSPECT-D to the measured reflectance


@dataclass
class Material:
    name: str
    words: str
    about: str
    curves: list = field(default_factory=list)


def man(kind):
    return (f"manmade.{kind}.{JHU}",)


def soil(kind):
    return (f"soil.{kind}.{JHU}",)


def pair(kind, number, owner="ucsb"):
    return (f"{kind}.vswir.{number}.{owner}.asd.spectrum.txt", f"{kind}.tir.{number}.{owner}.nicolet.spectrum.txt")


KIN = {
    "wild oat": pair("vegetation.grass.avena.fatua", "vh352"),
    "dry wild oat": pair("nonphotosyntheticvegetation.leaves.avena.fatua", "vh354"),
    "maple": pair("vegetation.tree.acer.rubrum", "acru-1-13"),
    "conifer": ("../aster-v2/jhu.becknic.vegetation.trees.conifers.solid.conifer.spectrum.txt",),
    "sand": soil("entisol.quartzipsamment.none.all.87p706"),
    "silty loam": soil("aridisol.camborthid.none.all.87p337"),
    "brick": man("generalconstructionmaterial.brick.solid.all.0097uuubrk"),
    "concrete": man("concrete.constructionconcrete.solid.all.0598uuucnc"),
    "asphalt": man("road.pavingasphalt.solid.all.0674uuuasp"),
    "asphaltic concrete": man("concrete.pavingconcrete.solid.all.0425uuuasp"),
    "clay tile": man("roofingmaterial.tile.solid.all.0484uuupot"),
    "tar paper": man("roofingmaterial.roofingpaper.solid.all.0522uuutar"),
    "shingle": man("roofingmaterial.shingle.solid.all.0597uuuasp"),
    "rubber": man("roofingmaterial.rubber.solid.all.0795uuurbr"),
    "galvanised steel": man("roofingmaterial.metal.solid.all.0525uuustla"),
    "tap water": ("water.tapwater.none.liquid.all.tapwater." + JHU,),
}


def berlin(names, kin):
    return [Curve(f"Berlin {i + 1}" if len(names) > 1 else "Berlin", berlin=name, kin=kin)
            for i, name in enumerate(names)]


IMAGE = "Mean of an airborne image at 3.6 m (HyMap, Berlin 2009): the surface as seen from above. "
LEAF = "Single leaves; transmittance by PROSPECT-D fitted to the reflectance. "

VEGETATION = [
    Material("grass, wild oat, green", "meadow blade avena", LEAF + "Avena fatua.",
             [Curve("VH352", eco=KIN["wild oat"], leaf=True)]),
    Material("grass, ripgut brome, green", "meadow blade bromus", LEAF + "Bromus diandrus.",
             [Curve("VH350", eco=pair("vegetation.grass.bromus.diandrus", "vh350"), leaf=True)]),
    Material("grass, wild oat, dry", "straw litter hay senescent", "Dead leaves of Avena fatua.",
             [Curve("VH354", eco=KIN["dry wild oat"])]),
    Material("grass, lawn", "turf garden park green", IMAGE + "Intensively manicured lawn.",
             berlin(["grass (intensively manicured) 1", "grass (intensively manicured) 2"], "wild oat")),
    Material("grass, lawn, sparse", "turf park", IMAGE + "Extensively manicured lawn.",
             berlin(["grass (extensively manicured)"], "wild oat")),
    Material("grass, pasture", "agricultural grassland field", IMAGE + "Agricultural grassland.",
             berlin(["grass (agricultural grassland) 1", "grass (agricultural grassland) 2",
                     "grass (agricultural grassland)3"], "wild oat")),
    Material("grass, dry", "straw meadow senescent yellow", IMAGE + "Dry grass; the third is agricultural grassland.",
             berlin(["grass (dry) 1", "grass (dry) 2", "grass (dry agricultural grassland)"], "dry wild oat")),
    Material("meadow, clover and lucerne", "alfalfa field", IMAGE + "Clover (1, 2) and lucerne (3).",
             berlin(["grass (meadow clover) 1", "grass (meadow clover) 2", "grass (meadow alfalfa/lucerne)"],
                    "wild oat")),
    Material("crop, sunflower", "field agriculture", IMAGE + "Sunflower.", berlin(["sunflower"], "maple")),
    Material("crop, maize", "corn field agriculture", IMAGE + "Maize.", berlin(["corn"], "wild oat")),
    Material("crop, sorghum", "field agriculture", IMAGE + "Sorghum.", berlin(["sorghum"], "wild oat")),
    Material("crop, sugar beet", "field agriculture", IMAGE + "Sugar beet.",
             berlin(["sugarbeet 1", "sugarbeet 2"], "maple")),
    Material("crop, potato", "field agriculture", IMAGE + "Potatoes.", berlin(["potatoes"], "maple")),
    Material("tree crown, broadleaf", "canopy forest deciduous", IMAGE + "Crowns of deciduous trees with their shade.",
             berlin([f"deciduous tree {i}" for i in range(1, 12)], "maple")),
    Material("tree crown, conifer", "canopy forest evergreen", IMAGE + "Crowns of conifers with their shade.",
             berlin(["coniferous tree 1", "coniferous tree 2"], "conifer")),
    Material("leaf, red maple", "broadleaf tree foliage acer", LEAF + "Acer rubrum.",
             [Curve("ACRU-1-13", eco=KIN["maple"], leaf=True)]),
    Material("leaf, eucalyptus", "broadleaf tree foliage gum", LEAF + "Eucalyptus maculata.",
             [Curve("JPL087", eco=pair("vegetation.tree.eucalyptus.maculata", "jpl087", "jpl"), leaf=True)]),
    Material("leaf, chamise", "shrub bush chaparral foliage", LEAF + "Adenostoma fasciculatum, needle-like leaves.",
             [Curve("VH033", eco=pair("vegetation.shrub.adenostoma.fasciculatum", "vh033"), leaf=True)]),
    Material("leaf, broadleaf, modelled", "tree foliage deciduous prospect",
             "PROSPECT-D, no measurement below 2.5 um: contents chosen for each state, layers N, pigments in ug/cm2, water "
             "and dry matter in g/cm2.",
             [Curve("mature", prospect=(1.5, 45, 9, 1, 0, 0.012, 0.006), kin="maple"),
              Curve("young", prospect=(1.3, 25, 6, 2, 0, 0.014, 0.004), kin="maple"),
              Curve("shade", prospect=(1.4, 60, 11, 1, 0, 0.009, 0.0035), kin="maple"),
              Curve("yellow, autumn", prospect=(1.7, 3, 8, 1, 0.15, 0.010, 0.006), kin="maple"),
              Curve("red, autumn", prospect=(1.7, 6, 6, 12, 0.1, 0.010, 0.006), kin="maple"),
              Curve("brown, dead", prospect=(2.4, 0.5, 1, 1, 1.5, 0.0005, 0.007), kin="dry wild oat")]),
    Material("needle, conifer, modelled", "pine spruce fir evergreen foliage leaf prospect",
             "PROSPECT-D, no measurement below 2.5 um; applicable to spruce needles with care (Z. Malenovsky et al., Int. "
             "J. Remote Sensing 27 (2006) 5315). Contents chosen as for the modelled broadleaf.",
             [Curve("this year", prospect=(1.9, 35, 8, 1, 0.02, 0.025, 0.016), kin="conifer"),
              Curve("older", prospect=(2.3, 55, 12, 1, 0.15, 0.030, 0.024), kin="conifer")]),
    Material("needles, conifer, pile", "pine spruce fir evergreen canopy",
             "A pile of needles that stands for a canopy; bidirectional below 2.5 um.",
             [Curve("JHU", eco=KIN["conifer"])]),
]

SOIL = [
    Material("soil, brown sandy loam", "earth ground dirt alfisol", "Fine sandy loam over volcanic tuff.",
             [Curve("87P3665", eco=soil("alfisol.haplustalf.none.all.87p3665"))]),
    Material("soil, brown silty loam", "earth ground dirt aridisol", "Silty loam from volcanic ash.",
             [Curve("87P337", eco=KIN["silty loam"])]),
    Material("soil, brown gravelly loam", "earth ground dirt desert aridisol", "Gravelly sandy loam of a fan terrace.",
             [Curve("89P1793", eco=soil("aridisol.haplargid.none.all.89p1793"))]),
    Material("soil, pale gypsum loam", "earth ground dirt desert gypsiorthid aridisol",
             "Very pale brown gravelly silt loam with gypsum, grazed rangeland.",
             [Curve("82P2695", eco=soil("aridisol.gypsiorthid.none.all.82p2695"))]),
    Material("soil, black loam", "earth ground dirt humus mollisol", "Black loam from andesite.",
             [Curve("85P4663", eco=soil("mollisol.cryoboroll.none.all.85p4663"))]),
    Material("soil, brown loamy sand", "earth ground dirt cropland ultisol", "Loamy sand of cropland, coastal plain.",
             [Curve("87P707", eco=soil("utisol.hapludult.none.all.87p707"))]),
    Material("sand, brown quartz", "beach ground entisol", "Coated quartz sand of a coastal plain.",
             [Curve("87P706", eco=KIN["sand"])]),
    Material("sand, playground", "beach sandpit", IMAGE + "Sand of playgrounds.",
             berlin(["sand (playground) 1", "sand (playground) 2"], "sand")),
    Material("soil, bare, urban", "earth ground dirt", IMAGE + "Bare soil.",
             berlin(["bare soil 1", "bare soil 2"], "silty loam")),
    Material("cinder, red", "tennis court sports field running track crushed brick", IMAGE + "Cinder field (1), "
             "cinder courts (2, 3).",
             berlin(["red sand (cinder field)", "red sand (cinder court) 1", "red sand (cinder court) 2"], "brick")),
]

WATER = [
    Material("water, tap", "pure clear", "Surface and volume of clear water.", [Curve("tap water", eco=KIN["tap water"])]),
    Material("water, lake", "river pond sea", IMAGE + "Open water.", berlin(["water1"], "tap water")),
    Material("water, swimming pool", "clear blue", IMAGE + "Pool with a light bottom.", berlin(["water 2"], "tap water")),
    Material("ice", "frozen water", "Modelled by the source up to 2.08 um, measured above.",
             [Curve("ice", eco=("water.ice.none.solid.all.ice_dat_." + JHU,))]),
    Material("snow, fine", "fresh powder", "Grains of 24 um; modelled by the source up to 2.08 um, measured above.",
             [Curve("fine", eco=("water.snow.finegranular.fine.all.fine_snw_." + JHU,))]),
    Material("snow, coarse", "old granular firn", "Grains of 178 um; modelled by the source up to 2.08 um, measured above.",
             [Curve("coarse", eco=("water.snow.coarsegranular.coarse.all.coarse_snw_." + JHU,))]),
]

CONSTRUCTION = [
    Material("concrete, weathered", "runway pavement wall building cement",
             "Concrete of runways: 30 years old with granite (0598), smooth with little aggregate (0092), with quartz and "
             "limestone (0424).",
             [Curve("0598UUUCNC", eco=KIN["concrete"]),
              Curve("0092UUUCNC", eco=man("concrete.pavingconcrete.solid.all.0092uuu_cnc")),
              Curve("0424UUUCNC", eco=man("concrete.pavingconcrete.solid.all.0424uuucnc"))]),
    Material("concrete, pavement", "sidewalk road court cement", IMAGE + "Concrete pavement.",
             berlin(["concrete 1", "concrete 2", "concrete 3"], "concrete")),
    Material("cinder block", "concrete wall building", "Light brown cement block.",
             [Curve("0432UUUCNC", eco=man("generalconstructionmaterial.cementcinderblock.solid.all.0432uuucnc"))]),
    Material("brick, red", "wall house building", "Smooth-faced (0097) and weathered (0412).",
             [Curve("0097UUUBRK", eco=KIN["brick"]),
              Curve("0412UUUBRK", eco=man("generalconstructionmaterial.brick.solid.all.0412uuubrk"))]),
    Material("marble, white", "stone wall pavement", "Weathered pavement at a beach.",
             [Curve("0722UUUMBL", eco=man("generalconstructionmaterial.marble.solid.all.0722uuumbl"))]),
    Material("wood, pine, weathered", "lumber fence pole timber board", "Bare, weathered boards.",
             [Curve("0404UUUWOD", eco=man("generalconstructionmaterial.wood.solid.all.0404uuuwod"))]),
    Material("glass, window", "pane car windscreen building",
             "Plate glass. It transmits below about 2.7 um, and its transmittance was not measured: as an opaque surface it "
             "absorbs what it does not reflect.",
             [Curve("0796UUUGLS", eco=man("generalconstructionmaterial.glas.solid.all.0796uuugls"))]),
    Material("asphalt, road, weathered", "street pavement tar", "Grey, with limestone and quartz showing.",
             [Curve("0095UUUASP", eco=man("road.pavingasphalt.solid.all.0095uuuasp")),
              Curve("0096UUUASP", eco=man("road.pavingasphalt.solid.all.0096uuuasp"))]),
    Material("asphalt, black", "runway pavement tar road new", "Weathered runway asphalt with little aggregate showing.",
             [Curve("0674UUUASP", eco=KIN["asphalt"])]),
    Material("asphalt, street", "road pavement parking", IMAGE + "Streets.",
             berlin([f"asphalt {i}" for i in range(1, 5)], "asphalt")),
    Material("asphalt concrete, rough", "road pavement runway", "With limestone and quartz aggregate, black, rough.",
             [Curve("0425UUUASP", eco=KIN["asphaltic concrete"])]),
    Material("railway ballast", "track stones gravel rail", IMAGE + "Rail tracks.",
             berlin(["railtrack 1", "railtrack 2"], "asphaltic concrete")),
    Material("artificial turf", "sports field plastic grass", IMAGE + "Sports grounds.",
             berlin(["artificial turf 1", "artificial turf 2"], "rubber")),
    Material("running track, tartan", "sports rubber polyurethane", IMAGE + "Red synthetic track.",
             berlin(["tartan (sports ground)"], "rubber")),
]

ROOF = [
    Material("roof tile, terracotta", "clay house building", "Weathered, orange.", [Curve("0484UUUPOT", eco=KIN["clay tile"])]),
    Material("roof tile, red clay", "house building", IMAGE + "Red clay tiles.",
             berlin([f"red clay tile {i}" for i in range(1, 5)], "clay tile")),
    Material("roof tile, red cement", "house building concrete", IMAGE + "Red cement tiles.",
             berlin([f"red cement tile {i}" for i in range(1, 4)], "concrete")),
    Material("roof tile, brown", "house building", IMAGE + "Brown tiles.", berlin(["brown tile"], "clay tile")),
    Material("roof tile, black", "house building", IMAGE + "Black tiles.", berlin(["black tile"], "concrete")),
    Material("roof shingle, asphalt, white", "house building", "White granules on tarred paper.",
             [Curve("0490UUUASP", eco=man("roofingmaterial.roofingshingle.solid.all.0490uuuasp"))]),
    Material("roof shingle, asphalt, grey", "house building old", "15 years old, soiled, grey granules.",
             [Curve("0597UUUASP", eco=KIN["shingle"])]),
    Material("roof shingle, asphalt, brown", "house building", IMAGE + "Brown shingle.",
             berlin(["brown shingle"], "shingle")),
    Material("roof shingle, slate", "house building stone", "Weathered, grey.",
             [Curve("0680UUUSTO", eco=man("roofingmaterial.shingle.solid.all.0680uuusto"))]),
    Material("roof, tar paper", "flat house building felt", "Extremely weathered, thickly tarred.",
             [Curve("0522UUUTAR", eco=KIN["tar paper"])]),
    Material("roof, bitumen", "flat building", IMAGE + "Bitumen roofs.",
             berlin([f"bitumen {i}" for i in range(1, 6)], "tar paper")),
    Material("roof, rubber coating, white", "flat building membrane", "Five years old, weathered.",
             [Curve("0795UUURBR", eco=KIN["rubber"])]),
    Material("roof, white", "flat building membrane plastic", IMAGE + "Polyethylene (1) and unknown materials (2 to 5).",
             berlin(["white roof material (polyethylene)"] + [f"white roof material (unknown) {i}" for i in range(1, 5)],
                    "rubber")),
]

METAL = [
    Material("aluminium, weathered", "aluminum metal roof bare car", "Bare, weathered and scratched.",
             [Curve("0384UUUALM", eco=man("roofingmaterial.metal.solid.all.0384uuualm"))]),
    Material("steel, galvanised", "metal roof zinc iron vent", "Weathered, of roofs and vents. The source's figures: 3 to 7 % beyond 3 um, "
             "as of a coated or corroded sheet; a bright one reflects most of it.",
             [Curve("0525UUUSTLA", eco=KIN["galvanised steel"])]),
    Material("copper, weathered", "metal roof flashing", "Slightly weathered roof flashing. The source's figures: 3 to 8 % beyond 3 um, "
             "as of an oxide; clean copper is 'copper, polished'.",
             [Curve("0681UUUCOP", eco=man("roofingmaterial.metal.solid.all.0681uuucop"))]),
    Material("zinc, roof", "metal building", IMAGE + "Zinc roof; the thermal part is lent by a galvanised steel that is "
             "nearly black there.", berlin(["zinc"], "galvanised steel")),
    Material("paint, olive green gloss", "painted metal car vehicle coating",
             "Gloss paint; what it was painted on is not recorded.", [Curve("0385UUUPNT", table="olive_green_paint.csv")]),
    Material("aluminium, polished", "aluminum metal mirror", "Clean smooth metal, model of its optical constants.",
             [Curve("model", metal="aluminium")]),
    Material("copper, polished", "metal mirror", "Clean smooth metal, model of its optical constants.",
             [Curve("model", metal="copper")]),
    Material("gold, polished", "metal mirror", "Clean smooth metal, model of its optical constants.",
             [Curve("model", metal="gold")]),
    Material("silver, polished", "metal mirror", "Clean smooth metal, model of its optical constants.",
             [Curve("model", metal="silver")]),
]

GROUPS = {"vegetation": VEGETATION, "soil": SOIL, "water": WATER, "construction": CONSTRUCTION, "roof": ROOF,
          "metal": METAL}

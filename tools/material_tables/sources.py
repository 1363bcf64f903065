"""Whose figures they are. Each text ends in the licence: tests/data holds the list of those that are open."""

COMPUTED = "Licence: computed here, Apache-2.0."
FIGURE = "Licence: a single published figure, cited."
INDEX = "Licence: CC0 1.0 (refractiveindex.info database, M. N. Polyanskiy, Scientific Data 11 (2024) 94); reflectance "\
        "computed here by Fresnel's equations at normal incidence."

SOURCES = {
    "usgs": "R. F. Kokaly et al., USGS Spectral Library Version 7, U.S. Geological Survey Data Series 1035 (2017), "
            "doi:10.3133/ds1035. Credit: U.S. Geological Survey. Licence: public domain (work of the U.S. Government).",
    "slum": "S. Kotthaus, T. E. L. Smith, M. J. Wooster, C. S. B. Grimmond, Derivation of an urban materials spectral library "
            "through emittance and reflectance spectroscopy, ISPRS Journal of Photogrammetry and Remote Sensing 94 (2014) "
            "194-212; data doi:10.5281/zenodo.4263842. Licence: CC0 1.0 (as the authors' own repository states).",
    "hale": "Water: G. M. Hale and M. R. Querry, Applied Optics 12 (1973) 555-563. " + INDEX,
    "warren": "Ice: S. G. Warren and R. E. Brandt, Journal of Geophysical Research 113 (2008) D14220. " + INDEX,
    "rubin": "Window glass: M. Rubin, Solar Energy Materials 12 (1985) 275-288. " + INDEX,
    "rakic": "A. D. Rakic et al., Applied Optics 37 (1998) 5271-5283, table 2 (Lorentz-Drude), and Fresnel's equation at "
             "normal incidence. " + COMPUTED,
    "prospect": "PROSPECT-D, J.-B. Feret et al., Remote Sensing of Environment 193 (2017) 204-215. " + COMPUTED,
    "canopy": "Canopy of leaves: J. Goudriaan, Crop Micrometeorology (1977); G. S. Campbell and J. M. Norman, An Introduction "
              "to Environmental Biophysics (1998), chapter 15. " + COMPUTED,
    "lopez": "Emissivity of leaves, 0.98 (nine crops, 0.973 to 0.985): A. Lopez, F. D. Molina-Aiz, D. L. Valera, A. Pena, "
             "Scientia Horticulturae 137 (2012) 49-58. " + FIGURE,
    "sutherland": "Emissivity at 8 to 14 um of sands, 0.89 to 0.92, of clay, 0.96, and of grass, peat and muck, 0.97 to 0.99: R. A. Sutherland, Journal "
                  "of Atmospheric and Oceanic Technology 3 (1986) 199-202. " + FIGURE,
    "hottel": "Emissivity of planed oak, 0.90: H. C. Hottel, table of emissivities in W. H. McAdams, Heat Transmission, "
              "3rd ed. (1954). " + FIGURE,
}

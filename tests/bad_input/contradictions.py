"""Keys that are good alone and not together; steps and meshes beyond what is stable or sensible."""

from entry import DRY, DUNE, TABLE, Entry


def fluid(line):
    return {"[fluid]": "[fluid]\n" + line}


def grains(line):
    return {"[grains]": "[grains]\n" + line}


STATISTICS = "[statistics]\nstart = 0\n"
CHECK = "check case.toml"

ENTRIES = [
    Entry("two drives", ["@pressure_gradient", "give one of the two"], fluid("pressure_gradient = 1.0")),
    Entry("no drive for turbulence", ["@fluid =", "mean_velocity or pressure_gradient"], {"mean_velocity = 0.2\n": ""}),
    Entry("turbulence without viscosity", ["viscosity"], fluid("kinematic_viscosity = 0"), problems=2),
    Entry("ramp without a velocity", ["@ramp_time", "mean_velocity"], {"mean_velocity = 0.2": "pressure_gradient = 1\nramp_time = 1"}),
    Entry("moving top that slips", ["@top_velocity", 'top = "no_slip"'], fluid("top_velocity = 0.1")),
    Entry("still water twice", ["@[grains.ambient]", "contradicts [fluid]"], {"[initial]": "[grains.ambient]\n[initial]"}),
    Entry("linear springs without stiffness", ["@[grains]", "linear_stiffness", "above 0"], grains('contact_model = "linear"')),
    Entry("stiffness without linear springs", ["@linear_stiffness", 'contact_model = "linear"'], grains("linear_stiffness = 100")),
    Entry("rolling friction without a model", ["@rolling_model", "rolling_friction"], grains('rolling_model = "none"')),
    Entry("pour of nothing", ["[grains] sizes", "which grains to pour"], {"sizes = [[1.5e-4, 20], [2e-4, 160], [2.5e-4, 20]]\n": ""}),
    Entry("pour of no sizes", ["@sizes"], {"sizes = [[1.5e-4, 20], [2e-4, 160], [2.5e-4, 20]]": "sizes = []"}),
    Entry("pour of held grains", ["@frozen", "contradicts pour"], grains("frozen = true")),
    Entry("pour and a file", ["not TOML"], {'fluid = "turbulent"': 'fluid = "turbulent"\ngrains = "a.csv"'}),
    Entry("cone outside the domain", ["@radius", "inside the domain"], {"centre = [0.008, 0.003]": "centre = [0.0, 0.003]"}),
    Entry("cone wider than the domain", ["@radius", "along z"], {"radius = 0.0018": "radius = 0.0038"}),
    Entry("cone higher than the domain", ["@radius", "above the domain"], {"radius = 0.0018": "radius = 0.0004"}),
    Entry("dropped from above the top", ["@radius", "above the domain"], {"radius = 0.0018": "radius = 0.0018\ndrop_height = 0.01"}),
    Entry("turbulence without water", ["@fluid =", "without a [fluid] section"], {"[initial]": '[initial]\nfluid = "turbulent"'}, base=DRY),
    Entry("pour without grains", ["without a [grains] section"],
          {"[grains]\nyoungs_modulus = 1.25e6\nrolling_friction = 0.05\nsizes = [[1.5e-4, 20], [2e-4, 160], [2.5e-4, 20]]\n": ""}),
    Entry("statistics without water", ["@start", "without a [fluid] section"], {"[output]": STATISTICS + "[output]"}, base=DRY),
    Entry("statistics after the end", ["@start", "before the end"], {"[output]": "[statistics]\nstart = 5\n[output]"}),
    Entry("grain step over fluid step", ["@grain_step", "at most fluid_step"], {"grain_step = 5e-6": "grain_step = 1e-3"}, problems=2),
    Entry("a million grain steps and more", ["@grain_step", "millionth"], {"grain_step = 5e-6": "grain_step = 1e-11"}),
    Entry("grain step over the Rayleigh limit", ["@grain_step", "must be at most", "Rayleigh", "smallest grain"],
          {"grain_step = 5e-6": "grain_step = 2.5e-5"}),
    Entry("grain step of the wrong exponent", ["@grain_step", "must be at most", "Rayleigh"], {"grain_step = 5e-6": "grain_step = 5e-5"}),
    Entry("the paper's modulus at the soft step", ["@grain_step", "must be at most", "Rayleigh"],
          {"youngs_modulus = 1.25e6": "youngs_modulus = 70e9"}),
    Entry("one tiny grain among many", ["@grain_step", "d = 1e-06 m"], {"[1.5e-4, 20]": "[1e-6, 1]"}),
    Entry("linear springs at too long a step", ["@grain_step", "a fifth of the contact"],
          grains('contact_model = "linear"\nlinear_stiffness = 1e6')),
    Entry("fluid step over the CFL limit", ["@fluid_step", "CFL", "below 1"], {"fluid_step = 2.5e-4": "fluid_step = 0.01"}),
    Entry("velocity in mm/s", ["@fluid_step", "CFL"], {"mean_velocity = 0.2": "mean_velocity = 200"}),
    Entry("viscous limit", ["@fluid_step", "at most", "viscosity is explicit"], fluid("kinematic_viscosity = 1e-3")),
    Entry("rows that cannot grow", ["@first_cell_height", "at most Ly / ny"], {"first_cell_height = 2.6e-4": "first_cell_height = 1e-3"}),
    Entry("first row higher than the channel", ["@first_cell_height", "at most"], {"first_cell_height = 2.6e-4": "first_cell_height = 0.26"}),
    Entry("grains wider than a period", ["@size", "its own image"], {"[2.5e-4, 20]": "[2.5e-3, 1]"}, problems=2),
    Entry("grains wider than the channel", ["@sizes", "0.008 m, wider than the domain"], {"[2.5e-4, 20]": "[8e-3, 1]"}),
    Entry("diameters in mm", ["@sizes", "0.25 m, wider than the domain", "0.2 mm is 2e-4"], {"[[1.5e-4, 20], [2e-4, 160], [2.5e-4, 20]]": "[[0.15, 20], [0.2, 160], [0.25, 20]]"}),
    Entry("diameters in um", ["@sizes", "250 m, wider than the domain", "lengths are in m"], {"[[1.5e-4, 20], [2e-4, 160], [2.5e-4, 20]]": "[[150, 20], [200, 160], [250, 20]]"}),
    Entry("cells smaller than grains", ["warning", "0.50 mean grain diameters", "1.2 to 1.6"], {"cells = [10, 14, 6]": "cells = [100, 50, 60]",
                                                                         "first_cell_height = 2.6e-4\n": "",
                                                                         "fluid_step = 2.5e-4": "fluid_step = 1e-4"},
          command=CHECK, code=0),
    Entry("cells far coarser than grains", ["warning", "mean grain diameters"], {"cells = [10, 14, 6]": "cells = [3, 3, 2]",
                                                                                  "first_cell_height = 2.6e-4\n": ""},
          command=CHECK, code=0),
    Entry("no gravity", [], grains("gravity = [0, 0, 0]"), command=CHECK, code=0),
    Entry("gravity upwards", [], grains("gravity = [0, 9.81, 0]"), command=CHECK, code=0),
    Entry("walls where water passes", ["warning", "boundary_z"], grains('boundary_z = "wall"'), command=CHECK, code=0),
    Entry("outputs more often than steps", ["warning", "shorter than a fluid step"], {"grains_interval = 0.0025": "grains_interval = 1e-9"},
          command=CHECK, code=0),
    Entry("end between two steps", ["warning", "whole number of fluid steps"], {"end = 0.01": "end = 0.0101"}, command=CHECK, code=0),
    Entry("contradictions in two sections", ["give one of the two", "contradicts pour"],
          {"[fluid]": "[fluid]\npressure_gradient = 1.0", "[grains]": "[grains]\nfrozen = true"}, problems=2),
]

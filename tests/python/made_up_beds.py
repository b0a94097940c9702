"""Runs of a flat bed that nobody has computed."""

import math

import numpy as np

from barchan.io.frames import Grains

SCALE = math.sqrt(1.5 * 9.81 * 8e-12)  # of q* [m2/s]


class MadeUpRun:
    """1,000 grains of 0.2 mm over 16 x 6 mm: 2e-7 m2/s under 20 Pa/m from 2 s on, something else before."""

    config = {"domain": {"size": [0.016, 0.0137, 0.006]}, "grains": {"density": 2500.0, "rolling_friction": 0.1},
              "coupling": {"smoothing_length": 3e-4}, "fluid": {"mean_velocity": 0.3}, "initial": {"realisation": 2}}
    t = np.arange(1, 801) / 100
    second = np.floor(t - 0.005) % 2  # blocks of one second: 1e-7 and 3e-7 in turn
    history_columns = {"t": t, "grain_flux": np.where(t > 2, 1e-7 + 2e-7 * second, 1.0),
                       "pressure_gradient": np.where(t > 2, 20.0, 90.0)}

    bed_load_columns = {}

    @staticmethod
    def frame(index):
        return Grains(0.0, np.arange(1000), np.zeros((1000, 3)), np.full(1000, 2e-4, np.float32))


class RisingRun(MadeUpRun):
    """The stress rises by 0.1 Pa a window; of all grains a tenth move, tenfold as fast from the fourth window on.

    The flow gains 0.08 m/s in a second. That pushes the grains by 80 Pa/m times their volume, not the bed's surface.
    """

    config = {**MadeUpRun.config, "coupling": {"forces": ["drag", "torque"]}}
    t = np.arange(1, 201) / 100
    window = np.ceil(t / 0.25 - 1e-9)
    solid = 1000 * math.pi / 6 * 8e-12 / (0.016 * 0.006)  # [m3/m2]
    flux = 1e-5 * SCALE * 10.0**np.maximum(0, window - 3)
    history_columns = {"t": t, "bulk_velocity": 0.3 + 0.08 * t,
                       "stress_on_grains": 0.1 * window + 80 * solid, "grain_flux": flux,
                       "grain_kinetic_energy": 0.016 * 0.006 * 2500 * flux**2 / (2 * 0.1 * solid)}

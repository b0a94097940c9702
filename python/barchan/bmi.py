"""The program as a component of a chain of models: the Basic Model Interface 2.0 of CSDMS (docs/results.md).

    from barchan.bmi import BarchanBmi

Signatures and meanings are those of the interface, https://bmi.readthedocs.io: arrays are filled in place and returned.
The program runs from one time to the next by its restart, whose bits are those of an unbroken run.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np

from barchan.api import program
from barchan.api.run import Run
from barchan.dune.height_map import HeightMap
from barchan.errors import BadInput, BarchanError
from barchan.io.study_folder import run_name
from barchan.studies.spec import flatten, load, unknown

SPEED = "channel_water_flow__speed"
BED, SHEAR = "channel_bottom_surface__elevation", "channel_bottom_water_flow__shear_speed"
COUNT = "sediment_grain__count"
OUTPUTS = {  # name: (unit, type)
    BED: ("m", "float64"),
    SHEAR: ("m s-1", "float64"),
    "dune__width": ("m", "float64"),
    "dune__length": ("m", "float64"),
    "dune__height": ("m", "float64"),
    "dune__celerity": ("m s-1", "float64"),
    COUNT: ("1", "int64"),
}
INPUTS = {SPEED: ("m s-1", "float64")}
COLUMNS = {"dune__width": "W", "dune__length": "L", "dune__height": "H", "dune__celerity": "celerity"}
SETTINGS = ("case", "out", "interval", "spacing", "threads", "overwrite", "set")
FRAMES = ("grains_interval", "dune_interval", "history_interval")
SCALAR_GRID, BED_GRID = 0, 1
NO_MESH = "the grids of this component are no meshes"


class BarchanBmi:
    """A case as a component. SI units throughout; raises barchan.BarchanError.

    `initialize` takes a case, or a file of settings: case (relative to this file), out (run folder, default: that of
    the case and "-bmi"), interval (time step of the component [s], default: output.dune_interval), spacing (of the map
    of the bed [m], default: two mean diameters), threads, overwrite (of earlier results in `out`), set (keys of the
    case).
    """

    def __init__(self) -> None:
        self._values: dict[str, np.ndarray] = {}
        self._step = 0

    # --- control

    def initialize(self, config_file: str) -> None:
        """Checks the case, runs what it starts from where results are missing, and takes its state at t = 0.

        Parameters
        ----------
        config_file : str
            A case, or a file of settings.

        Raises
        ------
        BadInput
            The case or a setting is refused.
        """
        said = _settings(Path(config_file))
        self._case, self._threads = said["case"], said.get("threads")
        self._out = Path(said.get("out", Path("runs") / f"{run_name(self._case)}-bmi"))
        self._keys = {key.replace(".", "__"): value for key, value in flatten(said.get("set", {})).items()}
        config = program.resolved(self._case, **self._keys)
        if "grains" not in config:
            raise BadInput(f"{self._case}: a component needs [grains]")
        self._fluid_step, self._end = config["time"]["fluid_step"], config["time"]["end"]
        self._own = {name: config["output"][name] for name in FRAMES}
        self._interval = said.get("interval") or self._own["dune_interval"] or self._own["history_interval"]
        if not self._interval >= self._fluid_step:
            raise BadInput(f"{config_file}: interval must be at least time.fluid_step, {self._fluid_step:g} s")
        flow = config.get("fluid", {})
        held = not flow.get("schedule") and flow.get("pressure_gradient") is None
        self._values, self._step = {}, 0
        if held and isinstance(flow.get("mean_velocity"), int | float):
            self._values[SPEED] = np.array([float(flow["mean_velocity"])])
        run = self._run(1, overwrite=said.get("overwrite", False))
        self._spacing = said.get("spacing") or 2 * float(run.frame(0).d.mean())
        x, _, z = config["domain"]["size"]
        self._shape = tuple(max(3, math.ceil(length / self._spacing - 1e-9)) for length in (z, x))
        self._take(run)

    def update(self) -> None:
        """Goes on by one time step of the component."""
        self.update_until(self.get_current_time() + self.get_time_step())

    def update_until(self, time: float) -> None:
        """Goes on to the first fluid step at or after `time` [s]; not back."""
        self._check_ready()
        step = math.ceil(time / self._fluid_step - 1e-6) if math.isfinite(time) else -1
        if step < self._step:
            raise BadInput(f"the component is at {self.get_current_time():g} s and cannot go to {time:g} s")
        if step > self._step:
            run = self._run(step, overwrite=self._step == 0)
            self._step = step
            self._take(run)

    def finalize(self) -> None:
        """Ends the component. Its results stay in the run folder."""
        self._values = {}

    # --- what it exchanges

    def get_component_name(self) -> str:
        return "Barchan"

    def get_input_item_count(self) -> int:
        return len(self.get_input_var_names())

    def get_output_item_count(self) -> int:
        return len(OUTPUTS)

    def get_input_var_names(self) -> tuple[str, ...]:
        """None where the case drives its flow by another key than a scalar fluid.mean_velocity."""
        return tuple(name for name in INPUTS if name in self._values)

    def get_output_var_names(self) -> tuple[str, ...]:
        return tuple(OUTPUTS)

    def get_var_grid(self, name: str) -> int:
        self._value(name)
        return BED_GRID if name == BED else SCALAR_GRID

    def get_var_type(self, name: str) -> str:
        return str(self._value(name).dtype)

    def get_var_units(self, name: str) -> str:
        self._value(name)
        return {**INPUTS, **OUTPUTS}[name][0]

    def get_var_itemsize(self, name: str) -> int:
        return self._value(name).itemsize

    def get_var_nbytes(self, name: str) -> int:
        return self._value(name).nbytes

    def get_var_location(self, name: str) -> str:
        self._value(name)
        return "node"

    # --- time

    def get_current_time(self) -> float:
        self._check_ready()
        return self._step * self._fluid_step

    def get_start_time(self) -> float:
        return 0.0

    def get_end_time(self) -> float:
        """time.end of the case; the component can go further."""
        self._check_ready()
        return float(self._end)

    def get_time_units(self) -> str:
        return "s"

    def get_time_step(self) -> float:
        self._check_ready()
        return float(self._interval)

    # --- values

    def get_value(self, name: str, dest: np.ndarray) -> np.ndarray:
        dest[:] = self._value(name)
        return dest

    def get_value_ptr(self, name: str) -> np.ndarray:
        """The array itself, (n) in the order of the grid; its values follow those of the component."""
        return self._value(name)

    def get_value_at_indices(self, name: str, dest: np.ndarray, inds: np.ndarray) -> np.ndarray:
        dest[:] = self._value(name)[inds]
        return dest

    def set_value(self, name: str, src: np.ndarray) -> None:
        """Of an input; it counts from the next update on."""
        self.set_value_at_indices(name, np.array([0]), src)

    def set_value_at_indices(self, name: str, inds: np.ndarray, src: np.ndarray) -> None:
        value = self._value(name)
        if name not in INPUTS:
            raise BadInput(f"{name} is computed and cannot be set; inputs: {', '.join(self.get_input_var_names())}")
        if np.size(src) != np.size(inds) or not np.isfinite(src).all():
            raise BadInput(f"{name} must be {np.size(inds)} finite number, and is {src}")
        value[inds] = src

    # --- grids

    def get_grid_rank(self, grid: int) -> int:
        return len(self._grid_shape(grid))

    def get_grid_size(self, grid: int) -> int:
        return math.prod(self._grid_shape(grid))

    def get_grid_type(self, grid: int) -> str:
        return "uniform_rectilinear" if self._grid_shape(grid) else "scalar"

    def get_grid_shape(self, grid: int, shape: np.ndarray) -> np.ndarray:
        """Rows across the flow (z), then columns along it (x)."""
        shape[:] = self._grid_shape(grid)
        return shape

    def get_grid_spacing(self, grid: int, spacing: np.ndarray) -> np.ndarray:
        spacing[:] = [self._spacing for _ in self._grid_shape(grid)]
        return spacing

    def get_grid_origin(self, grid: int, origin: np.ndarray) -> np.ndarray:
        """The middle of the first bin of the map: half a spacing from the corner of the domain."""
        origin[:] = [0.5 * self._spacing for _ in self._grid_shape(grid)]
        return origin

    def get_grid_x(self, grid: int, x: np.ndarray) -> np.ndarray:
        x[:] = self._middles(grid, 1)
        return x

    def get_grid_y(self, grid: int, y: np.ndarray) -> np.ndarray:
        """z of the program: across the flow."""
        y[:] = self._middles(grid, 0)
        return y

    def get_grid_z(self, grid: int, z: np.ndarray) -> np.ndarray:
        raise NotImplementedError("no grid of this component has three dimensions")

    def get_grid_node_count(self, grid: int) -> int:
        return self.get_grid_size(grid)

    def get_grid_edge_count(self, grid: int) -> int:
        raise NotImplementedError(NO_MESH)

    def get_grid_face_count(self, grid: int) -> int:
        raise NotImplementedError(NO_MESH)

    def get_grid_edge_nodes(self, grid: int, edge_nodes: np.ndarray) -> np.ndarray:
        raise NotImplementedError(NO_MESH)

    def get_grid_face_edges(self, grid: int, face_edges: np.ndarray) -> np.ndarray:
        raise NotImplementedError(NO_MESH)

    def get_grid_face_nodes(self, grid: int, face_nodes: np.ndarray) -> np.ndarray:
        raise NotImplementedError(NO_MESH)

    def get_grid_nodes_per_face(self, grid: int, nodes_per_face: np.ndarray) -> np.ndarray:
        raise NotImplementedError(NO_MESH)

    # --- behind the interface

    def _check_ready(self) -> None:
        if not self._values:
            raise BadInput("the component has no case: call initialize first")

    def _value(self, name: str) -> np.ndarray:
        self._check_ready()
        if name not in self._values:
            raise unknown(name, list(self._values), self.get_component_name())
        return self._values[name]

    def _grid_shape(self, grid: int) -> tuple[int, ...]:
        self._check_ready()
        if grid not in (SCALAR_GRID, BED_GRID):
            raise BadInput(f"there is no grid {grid}: {SCALAR_GRID} has one value, {BED_GRID} the bed")
        return self._shape if grid == BED_GRID else ()

    def _middles(self, grid: int, axis: int) -> np.ndarray:
        if grid != BED_GRID:
            raise NotImplementedError("a scalar has no coordinates")
        return self._spacing * (0.5 + np.arange(self._grid_shape(grid)[axis]))

    def _run(self, step: int, overwrite: bool) -> Run:
        """The program to the end of this fluid step, from its last state; at first from the start of the case."""
        end = step * self._fluid_step
        keys = {**self._keys, "time__end": end, "time__fluid_step": self._fluid_step}  # also at another speed
        for name, own in self._own.items():  # output at the end, and where the case wants it
            whole = own > 0 and abs(end / own - round(end / own)) < 1e-6
            keys[f"output__{name}"] = own if whole else end
        if SPEED in self._values:
            keys["fluid__mean_velocity"] = float(self._values[SPEED][0])
        return program.run(self._case, out=self._out, threads=self._threads, overwrite=overwrite, quiet=True,
                           restart="latest" if self._step else None, **keys)

    def _take(self, run: Run) -> None:
        """The values of the present time, into the arrays that get_value_ptr() has given away."""
        time = self._step * self._fluid_step
        grains = run.frame(run.need_grains().index(time))
        size = self._spacing
        rows, columns = self._shape
        height = HeightMap(grains, (0, (columns - 0.5) * size, 0, (rows - 0.5) * size), size).h
        dune = _row(run.main_dune_columns, time, self._fluid_step) if run.dune_columns else {}
        flow = _row(run.history_columns, time, self._fluid_step)
        now: dict[str, Any] = {BED: height.T.ravel(), SHEAR: [flow.get("u_star", 0.0)], COUNT: [len(grains.d)],
               **{name: [dune.get(column, math.nan)] for name, column in COLUMNS.items()}}
        for name, value in now.items():
            self._values.setdefault(name, np.zeros(len(value), OUTPUTS[name][1]))[:] = value


def _row(table: dict[str, np.ndarray] | None, time: float, fluid_step: float) -> dict[str, float]:
    """The row of this time, {} where there is none."""
    rows = np.nonzero(abs(table["t"] - time) < 0.5 * fluid_step)[0] if table else np.zeros(0, int)
    return {name: float(column[rows[-1]]) for name, column in table.items()} if table and len(rows) else {}


def _settings(file: Path) -> dict[str, Any]:
    """Those of a file of settings; of a case itself."""
    said = load(file)
    if "domain" in said:
        return {"case": file}
    for key in said:
        if key not in SETTINGS:
            raise unknown(key, SETTINGS, str(file))
    if not isinstance(said.get("case"), str):
        raise BadInput(f"{file}: case must name a case")
    for key in ("interval", "spacing", "threads"):
        if key in said and not (type(said[key]) in (int, float) and said[key] > 0):
            raise BadInput(f"{file}: {key} must be a number above 0")
    return {**said, "case": file.parent / said["case"]}

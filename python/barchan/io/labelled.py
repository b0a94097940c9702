"""Tables and grains with their names and units: pandas, imported where it is first needed. Figures do without."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from barchan.errors import BarchanError, MissingData, optional
from barchan.io.units import About

VECTOR_PARTS = {"x": "xyz", "u": "uvw"}  # of others the axis follows the name: omega_x
AXES = {3: "xyz", 4: "wxyz"}  # of a vector, of a quaternion


def data_frame(columns: dict[str, np.ndarray], about: About) -> Any:
    """A pandas.DataFrame; attrs["units"] and attrs["long_names"] say what its columns are."""
    frame = optional("pandas", "pandas").DataFrame(columns)
    frame.attrs["units"] = {name: about[name][0] for name in columns if name in about}
    frame.attrs["long_names"] = {name: about[name][1] for name in columns if name in about}
    return frame


def xarray_fields() -> ModuleType:
    """The module that makes Datasets of the flow."""
    optional("xarray", "xarray")
    from barchan.io import fields

    return fields


def together(tables: Mapping[Any, dict[str, np.ndarray]], whole: str) -> dict[str, np.ndarray]:
    """Columns of several tables, one after another; those of the column `whole` as integers."""
    joined = {name: np.concatenate([table[name] for table in tables.values()])
              for name in next(iter(tables.values()))}
    return {**joined, whole: joined[whole].astype(int)}


def grains_frame(time: float, columns: dict[str, np.ndarray], arrays: About) -> Any:
    """Grains of a frame as a pandas.DataFrame, one column for each part of a vector; attrs["time"] [s]."""
    flat: dict[str, np.ndarray] = {}
    about: About = {}
    for name, values in columns.items():
        if values.ndim == 1:
            parts = {name: values}
        else:
            names = VECTOR_PARTS.get(name) or [f"{name}_{axis}" for axis in AXES[values.shape[1]]]
            parts = dict(zip(names, values.T))
        flat |= parts
        about |= {part: arrays[name] for part in parts if name in arrays}
    frame = data_frame(flat, about).set_index("id")
    frame.attrs["time"] = time
    return frame


def read_table(path: Path, source: str, about: About, text: Sequence[str] = ()) -> Any:
    """A table in CSV whose columns `text` are words. Raises MissingData, with the `source` that writes it."""
    pandas = optional("pandas", "pandas")
    if not path.is_file():
        raise MissingData(f"needs {path.name}: {source}")
    try:
        table = pandas.read_csv(path, dtype=dict.fromkeys(text, str), keep_default_na=False, na_values=["nan"])
    except ValueError as problem:
        raise BarchanError(f"{path} cannot be read: {problem}") from None
    return data_frame({key: table[key].to_numpy() for key in table}, about)

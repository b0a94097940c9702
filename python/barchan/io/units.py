"""What files say of their columns and arrays: {name: (unit, long name)}, units as CF writes them."""

import re
from collections.abc import Mapping
from typing import Any

About = dict[str, tuple[str, str]]


def cf(unit: str) -> str:
    """A unit of a file, "m^2/s" or "m2/s", as CF has it: "m2 s-1"; "1" has no dimension."""
    above, *below = unit.replace("^", "").split("/")
    factors = [factor for factor in above.split() if factor not in ("1", "-")]
    factors += [f"{name}-{power or 1}" for name, power in re.findall(r"([A-Za-z]+)(\d*)", " ".join(below))]
    return " ".join(factors) or "1"


def of_columns(columns: Any) -> About:
    """What columns.json says of a table. A run of an earlier version has no such file: {}."""
    if not isinstance(columns, dict):
        return {}
    return {name: (cf(str(one["unit"])), str(one.get("meaning", ""))) for name, one in columns.items()
            if isinstance(one, dict) and "unit" in one}


def of_arrays(group: Any, names: list[str]) -> About:
    """What arrays of an HDF5 file say of themselves."""
    found: dict[str, Mapping[str, Any]] = {name: group[name].attrs for name in names}
    return {name: (cf(str(attrs["units"])), str(attrs.get("long_name", ""))) for name, attrs in found.items()
            if "units" in attrs}

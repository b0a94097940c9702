"""Bodies at rest, as the program has surveyed them (bodies.h5): heights, distances, outlines; no drawing.

Lengths in m, y upwards.
"""

import warnings
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from barchan.io.run_folder import RunFolder

POINTS = 181      # of a section
MOST_POSTS = 200  # with outlines of their own; no picture shows more
NO_FILE = "bodies.h5, which versions after 0.3.0 write when a run starts or goes on"


@dataclass(frozen=True)
class Body:
    """One [[body]] with its keys (docs/keys.md); `number` from 0 in their order, `domain` (Lx, Ly, Lz) [m].

    `lattice`: x, z, bottom, top (lines, points), and copies (n, 2), as in docs/files.md.
    """

    number: int
    name: str
    shape: str
    domain: tuple[float, float, float]
    lattice: dict[str, np.ndarray] = field(compare=False, repr=False)
    centre: tuple[float, float] = (0.0, 0.0)
    base: float = 0.0
    axis: str = "y"
    radius: float = 0.0
    height: float = 0.0
    length: float = 0.0
    size: tuple[float, float] = (0.0, 0.0)
    wavelength: float = 0.0

    @property
    def top(self) -> float:
        """Height of its highest point above the floor [m]."""
        return float(self.lattice["top"].max())

    @property
    def middle(self) -> float:
        """Height above the floor, halfway from its lowest to its highest point [m]."""
        return 0.5 * (self.base + self.top)

    @property
    def unit(self) -> tuple[float, str]:
        """(its size [m], "D" or "H"): the diameter of what is round, else the height."""
        return (2 * self.radius, "D") if self.radius > 0 else (self.height, "H")

    @cached_property
    def heart(self) -> tuple[float, float]:
        """(x, z) of its middle [m]; of a fence that of the post next to it, of a wave the middle of the domain."""
        if self.shape == "wave":
            return self.centre[0], 0.5 * self.domain[2]
        copies = self.lattice["copies"]
        x, z = self.centre + copies[len(copies) // 2]
        return float(x), float(z)

    @property
    def spans(self) -> bool:
        """Whether it is the same in every plane across the stream."""
        endless = {"wave": True, "cylinder": self.axis == "z" and self.length == 0, "box": self.size[1] == 0}
        return endless.get(self.shape, False)

    @property
    def across(self) -> bool:
        """Whether the lines of its lattice go across the domain, not from its middle to its outline."""
        return len(self.lattice["x"][0]) == 2

    @property
    def origin(self) -> np.ndarray:
        """(2) x and z of the middle of the part that the lattice is of [m]."""
        return np.array([self.lattice["x"][0, 0], self.lattice["z"][0, 0]])

    @cached_property
    def lines(self) -> np.ndarray:
        """(lines, points, 2) x and z from `origin` [m]."""
        return np.stack([self.lattice["x"], self.lattice["z"]], axis=-1) - self.origin

    @cached_property
    def rim(self) -> np.ndarray:
        """(lines + 1, 2) outline of that part from `origin`, closed [m]."""
        return np.concatenate([self.lines[:, -1], self.lines[:1, -1]])

    def _from_part(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """(..., 2) from the middle of the nearest part, or of its image, to places [m]."""
        period, copies = np.array([self.domain[0], self.domain[2]]), self.lattice["copies"]
        s = np.stack(np.broadcast_arrays(x, z), axis=-1) - self.origin
        s = s - period * np.round(s / period) - copies[0]
        if len(copies) == 1:
            return s
        step = copies[1] - copies[0]
        return s - np.clip(np.round(s @ step / (step @ step)), 0, len(copies) - 1)[..., None] * step

    def _heights(self, x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(bottom, top, share of the way from the middle to the outline) at places; beyond it those at it."""
        if self.across:
            x = (x + 0.0 * z) % self.domain[0]
            bottom, top = (np.interp(x, self.lattice["x"][:, 0], self.lattice[name][:, 0])
                           for name in ("bottom", "top"))
            return bottom, top, 0.0 * x
        s = self._from_part(x, z)
        turn = np.unwrap(np.arctan2(self.rim[:, 1], self.rim[:, 0]))
        angle = turn[0] + (np.arctan2(s[..., 1], s[..., 0]) - turn[0]) % (2 * np.pi)
        line = np.clip(np.searchsorted(turn, angle, side="right") - 1, 0, len(turn) - 2)
        ends = self.rim[line], self.rim[line + 1]
        sines = [abs(s[..., 0] * end[..., 1] - s[..., 1] * end[..., 0]) for end in ends]
        beside = sines[0] / np.maximum(sines[0] + sines[1], 1e-300)
        to_rim = ends[0] + beside[..., None] * (ends[1] - ends[0])
        outwards = np.hypot(*np.moveaxis(s, -1, 0)) / np.hypot(*np.moveaxis(to_rim, -1, 0))
        last = self.lines.shape[1] - 1
        place = last * np.arcsin(np.minimum(outwards, 1)) / (np.pi / 2)  # as even as heights of a sphere
        point = np.minimum(place.astype(int), last - 1)
        corners = [(way * far, (line + i) % len(self.lines), point + j)
                   for i, way in enumerate((1 - beside, beside))
                   for j, far in enumerate((1 - place + point, place - point))]
        bottom, top = (sum(weight * self.lattice[name][row, column] for weight, row, column in corners)
                       for name in ("bottom", "top"))
        return bottom, top, outwards

    def interval(self, x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(bottom, top) above the floor [m] of what is solid over places x, z (...); NaN where nothing is."""
        bottom, top, outwards = self._heights(np.asarray(x, float), np.asarray(z, float))
        solid = (outwards <= 1) & (top > 0)
        return np.where(solid, bottom, np.nan), np.where(solid, top, np.nan)

    def holds(self, x: np.ndarray) -> np.ndarray:
        """(...) whether places x (..., 3) lie in it."""
        low, high = self.interval(x[..., 0], x[..., 2])
        return (x[..., 1] > low) & (x[..., 1] < high) if self.base > 0 else x[..., 1] < high

    def beside(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """(...) from places x, z to its outline from above [m]; 0 within."""
        s = self._from_part(x, z)
        square = np.full(s.shape[:-1], np.inf)
        for a, b in zip(self.rim, self.rim[1:]):
            along = np.clip((s - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
            square = np.minimum(square, ((s - a - along[..., None] * (b - a))**2).sum(axis=-1))
        return np.where(self._heights(x, z)[2] <= 1, 0.0, np.sqrt(square))

    def touches(self, x: np.ndarray, reach: np.ndarray) -> np.ndarray:
        """(n) which places x (n, 3) are within `reach` (n) [m] of its outline, of its bottom and of its top."""
        low, high, _ = self._heights(x[:, 0], x[:, 2])
        found = (x[:, 1] > low - reach) & (x[:, 1] < high + reach)
        found[found] = self.beside(x[found, 0], x[found, 2]) < reach[found]
        return found

    def plan(self) -> list[np.ndarray]:
        """Outlines (n, 2) in x and z [m] where it is widest, of a wave where it is above half its height.

        Of a fence one for each post, or one around all if they are more than MOST_POSTS.
        """
        if self.across:
            return self._stripes()
        copies = self.lattice["copies"]
        if len(copies) <= MOST_POSTS:
            return [self.rim + self.origin + each for each in copies]
        along = (copies[1] - copies[0]) / np.linalg.norm(copies[1] - copies[0])
        beside = np.array([-along[1], along[0]])
        first, last = (self.origin + copies[end] + (1 + 2 * end) * -self.radius * along for end in (0, -1))
        side = self.radius * beside
        return [np.array([first - side, last - side, last + side, first + side, first - side])]

    def _stripes(self) -> list[np.ndarray]:
        x, top = self.lattice["x"][:, 0], self.lattice["top"][:, 0]
        over = top - (self.base + 0.5 * self.height if self.shape == "wave" else 0.0)
        turn = np.flatnonzero(np.diff(over > 0))
        ends = x[turn] - over[turn] * (x[turn + 1] - x[turn]) / (over[turn + 1] - over[turn])
        ends = np.concatenate([[x[0]] * bool(over[0] > 0), ends, [x[-1]] * bool(over[-1] > 0)])
        return [np.array([(a, 0), (b, 0), (b, self.domain[2]), (a, self.domain[2]), (a, 0)])
                for a, b in ends.reshape(-1, 2)]

    @cached_property
    def reach(self) -> tuple[float, float, float, float]:
        """(x0, x1, z0, z1) [m] of its outline where it is widest."""
        if self.across:
            return 0.0, self.domain[0], 0.0, self.domain[2]
        places = np.concatenate(self.plan())
        (x0, z0), (x1, z1) = places.min(axis=0), places.max(axis=0)
        return float(x0), float(x1), float(z0), float(z1)

    def section(self, z: float) -> list[np.ndarray]:
        """Outlines (n, 2) in x and y [m] in the vertical plane z = `z` [m] along x."""
        x0, x1 = self.reach[:2]
        count = POINTS if len(self.lattice["copies"]) == 1 else 8 * POINTS
        x = 0.5 * (x0 + x1) - 0.5 * (x1 - x0) * (1 - 1e-9) * np.cos(np.linspace(0, np.pi, count))
        x = np.unique(np.append(self.lattice["x"][:, 0] if self.across else x, self.heart[0]))
        low, high = self.interval(x, np.full_like(x, z))
        held = np.flatnonzero(np.isfinite(high))
        pieces = np.split(held, np.flatnonzero(np.diff(held) > 1) + 1) if len(held) else []
        return [np.concatenate([np.stack([x[rows], high[rows]], axis=1),
                                np.stack([x[rows], low[rows]], axis=1)[::-1]]) for rows in pieces]

    def frontal_area(self) -> float:
        """Of its projection along x above the floor [m2]."""
        x0, x1, z0, z1 = self.reach
        x, z = np.linspace(x0, x1, 201), z0 + (z1 - z0) * (np.arange(400) + 0.5) / 400
        low, high = self.interval(*np.meshgrid(x, z, indexing="ij"))
        held = np.isfinite(high).any(axis=0)
        tall = np.nanmax(high[:, held], axis=0) - np.nanmin(low[:, held], axis=0)
        return float(tall.sum() * (z1 - z0) / 400)


def bodies_of(run: RunFolder) -> tuple[Body, ...]:
    """The bodies of a run in their order; () where it has none, or was computed before the program surveyed them."""
    tables = run.config.get("body", ())
    if not tables:
        return ()
    if run.body_lattices is None:
        warnings.warn(f"{run.path}: the bodies are left out: needs {NO_FILE}", stacklevel=2)
        return ()
    x, y, z = map(float, run.config["domain"]["size"])
    known = {"name", "shape", "centre", "base", "axis", "radius", "height", "length", "size", "wavelength"}
    return tuple(Body(number=number, domain=(x, y, z), lattice=lattice,
                      **{key: tuple(value) if isinstance(value, list) else value
                         for key, value in table.items() if key in known})
                 for number, (table, lattice) in enumerate(zip(tables, run.body_lattices)))


def tops(bodies: tuple[Body, ...], x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """(...) height of the highest body over places x, z [m]; NaN where none is."""
    each = [body.interval(x, z)[1] for body in bodies]
    return np.fmax.reduce([np.full(np.broadcast(x, z).shape, np.nan), *each])

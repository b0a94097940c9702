"""Bodies at rest: how far from them a place is, where they begin and end, and their outlines; no drawing.

The distances are those of kernels/bodies once more. Both are tested against
tests/reference/body_distances.csv. Lengths in m, y upwards.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

POINTS = 181  # of an outline: a round one has a corner every 2 degrees
MOST_POSTS = 200  # with outlines of their own; no picture shows more


@dataclass(frozen=True)
class Body:
    """One [[body]] with its keys (docs/keys.md); `number` from 0 in their order, `domain` (Lx, Ly, Lz) [m]."""

    number: int
    name: str
    shape: str
    domain: tuple[float, float, float]
    centre: tuple[float, float] = (0.0, 0.0)
    base: float = 0.0
    axis: str = "y"
    radius: float = 0.0
    height: float = 0.0
    length: float = 0.0
    size: tuple[float, float] = (0.0, 0.0)
    lee: float = 0.0
    spacing: float = 0.0
    wavelength: float = 0.0
    angle: float = 0.0
    form: str = field(init=False)  # the shape, of a lying cylinder with its axis

    def __post_init__(self) -> None:
        lies = self.shape == "cylinder" and self.axis != "y"
        object.__setattr__(self, "form", f"cylinder_{self.axis}" if lies else self.shape)

    @property
    def posts(self) -> int:
        """Of a fence; 1 of anything else."""
        return 1 + int(np.floor(self.length / self.spacing * (1 + 1e-9))) if self.form == "fence" else 1

    @property
    def tall(self) -> float:
        """From its lowest to its highest point [m]."""
        if self.form in ("sphere", "cylinder_x", "cylinder_z"):
            return 2 * self.radius
        return self.radius if self.form == "half_sphere" else self.height

    @property
    def top(self) -> float:
        """Height of its highest point above the floor [m]."""
        return self.base + self.tall

    @property
    def widest(self) -> float:
        """The height above the floor where its outline is largest [m]; of a wave halfway up."""
        middle = {"half_sphere": 0.0, "dune": 0.0}.get(self.form, 0.5 * self.tall)
        return max(self.base + middle, 0.0)

    @property
    def unit(self) -> tuple[float, str]:
        """(its size [m], "D" or "H"): the diameter of what is round, else the height."""
        return (2 * self.radius, "D") if self.radius > 0 else (self.height, "H")

    @property
    def heart(self) -> tuple[float, float]:
        """(x, z) of its middle [m]; of a fence that of the post next to it, of a wave the middle of the domain."""
        x, z = self.centre
        if self.form == "wave":
            return x, 0.5 * self.domain[2]
        beside = 0.5 * self.spacing if self.posts % 2 == 0 else 0.0
        return x - np.sin(self.angle) * beside, z + np.cos(self.angle) * beside

    @property
    def spans(self) -> bool:
        """Whether it is the same in every plane across the stream."""
        endless = {"wave": True, "cylinder_z": self.length == 0, "box": self.size[1] == 0}
        return endless.get(self.form, False)

    def local(self, x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Along and across of places from the middle of the nearest image, turned with the body [m]."""
        sx, sz = x - self.centre[0], z - self.centre[1]
        sx = sx - self.domain[0] * np.round(sx / self.domain[0])
        sz = sz - self.domain[2] * np.round(sz / self.domain[2])
        c, s = np.cos(self.angle), np.sin(self.angle)
        return c * sx + s * sz, c * sz - s * sx

    def placed(self, p: np.ndarray, q: np.ndarray) -> np.ndarray:
        """(n, 2) x and z of places p (n) along and q (n) across [m]."""
        c, s = np.cos(self.angle), np.sin(self.angle)
        return np.stack([self.centre[0] + c * p - s * q, self.centre[1] + s * p + c * q], axis=-1)

    def distance(self, x: np.ndarray) -> np.ndarray:
        """(...) from places x (..., 3) to the surface [m], negative inside.

        The distances below are of p along, y above the lowest point and q across, all of one shape (...), in m.
        """
        x = np.asarray(x, float)
        p, q = self.local(x[..., 0], x[..., 2])
        return getattr(self, f"_to_{self.form}")(p, x[..., 1] - self.base, q)

    def _to_cylinder(self, p: np.ndarray, y: np.ndarray, q: np.ndarray) -> np.ndarray:
        return _corner(np.hypot(p, q) - self.radius, abs(y - 0.5 * self.height) - 0.5 * self.height)

    def _to_cylinder_x(self, p: np.ndarray, y: np.ndarray, q: np.ndarray) -> np.ndarray:
        out = np.hypot(y - self.radius, q) - self.radius
        return _corner(out, abs(p) - 0.5 * self.length) if self.length > 0 else out

    def _to_cylinder_z(self, p: np.ndarray, y: np.ndarray, q: np.ndarray) -> np.ndarray:
        return self._to_cylinder_x(q, y, p)

    def _to_sphere(self, p: np.ndarray, y: np.ndarray, q: np.ndarray) -> np.ndarray:
        return np.sqrt(p**2 + (y - self.radius)**2 + q**2) - self.radius

    def _to_half_sphere(self, p: np.ndarray, y: np.ndarray, q: np.ndarray) -> np.ndarray:
        above = np.maximum(-y, np.sqrt(p**2 + y**2 + q**2) - self.radius)
        return np.where(y < 0, _corner(np.hypot(p, q) - self.radius, -y), above)

    def _to_box(self, p: np.ndarray, y: np.ndarray, q: np.ndarray) -> np.ndarray:
        sides = [abs(each) - 0.5 * size for each, size in ((p, self.size[0]), (q, self.size[1])) if size > 0]
        return _corner(abs(y - 0.5 * self.height) - 0.5 * self.height, *sides)

    def _to_fence(self, p: np.ndarray, y: np.ndarray, q: np.ndarray) -> np.ndarray:
        return self._to_cylinder(p, y, q - self._post(q))

    def _post(self, q: np.ndarray) -> np.ndarray:
        """Where across the nearest post stands [m]."""
        last, shift = 0.5 * (self.posts - 1), 0.5 * (self.posts % 2 == 0)
        return self.spacing * np.clip(np.round(q / self.spacing - shift) + shift, -last, last)

    def _to_dune(self, p: np.ndarray, y: np.ndarray, q: np.ndarray) -> np.ndarray:
        """The largest distance to the planes that touch it, which an angle t counts, or that to the crest."""
        p, y, q = np.broadcast_arrays(p, y, q)
        half_width = 0.5 * self.size[1]
        t = np.arctan2(q / half_width, p / self._half_axes(p)[0])
        best, upwards, goes_on = np.zeros(p.shape), np.ones(p.shape), np.ones(p.shape, bool)
        for n in range(5):
            c, s = np.cos(t), np.sin(t)
            k_x, k_z = self.height / self._half_axes(c)[0], self.height / half_width
            a = k_x * c * p + k_z * s * q
            square = 1 + k_x**2 * c**2 + k_z**2 * s**2
            distance = (y - (self.height - a)) / np.sqrt(square)
            if n > 0:
                goes_on = goes_on & (distance > best)
            best, upwards = np.where(goes_on, distance, best), np.where(goes_on, 1 / np.sqrt(square), upwards)
            slope, half_slope = -k_x * s * p + k_z * c * q, (k_z**2 - k_x**2) * s * c
            height = a + y - self.height
            curve = -a * square + slope * half_slope - height * (k_z**2 - k_x**2) * (c**2 - s**2)
            goes_on = goes_on & (curve < 0)
            t = np.where(goes_on, t - (slope * square - height * half_slope) / np.where(goes_on, curve, 1.0), t)
        above = y - self.height > best * upwards  # the planes touch above the crest
        return np.where(above, np.sqrt(p**2 + (y - self.height)**2 + q**2), best)

    def _half_axes(self, p: np.ndarray) -> tuple[np.ndarray, float]:
        """Of a dune's foot [m]: along, upstream or downstream of the crest by the sign of p, and across."""
        return np.where(p < 0, self.size[0] - self.lee, self.lee), 0.5 * self.size[1]

    def _to_wave(self, p: np.ndarray, y: np.ndarray, q: np.ndarray) -> np.ndarray:
        """Near it by Newton's steps to the nearest point, else to first order in the curvature."""
        k, half = 2 * np.pi / self.wavelength, 0.5 * self.height

        def surface(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
            slope = -half * k * np.sin(k * x)
            return half * (1 + np.cos(k * x)), slope, 1 / np.sqrt(1 + slope**2)

        f, slope, scale = surface(p)
        first = scale * (y - f)
        x = p + first * scale * slope
        for _ in range(4):
            f, slope, _ = surface(x)
            curve = 1 + slope**2 + (f - y) * k**2 * (half - f)
            x = x - (x - p + (f - y) * slope) / np.where(curve == 0, 1.0, curve)
        f, slope, scale = surface(x)
        return np.where(abs(first) * half * k**2 > 0.5, first, scale * ((y - f) - slope * (p - x)))

    def interval(self, x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(bottom, top) above the floor [m] of what is solid over places x, z (...); NaN where nothing is."""
        p, q = self.local(np.asarray(x, float), np.asarray(z, float))
        r, low, high = self.radius, 0.0 * (p + q), self.tall + 0.0 * (p + q)
        if self.form == "cylinder":
            inside = np.hypot(p, q) <= r
        elif self.form == "fence":
            inside = np.hypot(p, q - self._post(q)) <= r
        elif self.form == "box":
            inside = np.all([(abs(each) <= 0.5 * size) | (size == 0) for each, size in zip((p, q), self.size)], axis=0)
        elif self.form == "dune":
            a, b = self._half_axes(p)
            high = self.height * (1 - np.hypot(p / a, q / b))
            low = np.full_like(high, -self.base)  # it goes on below its foot, until the floor
            inside = high >= low
        elif self.form == "wave":
            high = 0.5 * self.height * (1 + np.cos(2 * np.pi / self.wavelength * p))
            low, inside = np.full_like(high, -max(self.base, 0.0)), high == high
        else:
            along, across = {"cylinder_x": (p, q), "cylinder_z": (q, p)}.get(self.form, (0 * p, np.hypot(p, q)))
            half = np.sqrt(np.maximum(0, r**2 - across**2))
            middle = 0.0 if self.form == "half_sphere" else r
            low, high = np.maximum(middle - half, 0.0), middle + half
            inside = (across <= r) & ((self.length == 0) | (abs(along) <= 0.5 * self.length))
        inside = inside & (self.base + high >= 0)
        return (np.where(inside, np.maximum(self.base + low, 0.0), np.nan),
                np.where(inside, self.base + high, np.nan))

    def plan(self, y: float | None = None) -> list[np.ndarray]:
        """Outlines (n, 2) in x and z [m] at the height y above the floor; None: where it is widest.

        Of a fence one for each post, or one around all if they are more than MOST_POSTS.
        """
        up = (self.widest if y is None else y) - self.base
        if self.form == "wave":
            return self._stripes(up)
        if not (self.form == "dune" or -1e-12 <= up <= self.tall * (1 + 1e-12)):
            return []
        r, (a, b) = self.radius, (0.5 * self.size[0], 0.5 * self.size[1])
        if self.posts > MOST_POSTS:
            return [self._rectangle(r, r + 0.5 * self.spacing * (self.posts - 1))]
        if self.form in ("cylinder", "fence"):
            circle = _ring(r, r)
            across = self.spacing * (np.arange(self.posts) - 0.5 * (self.posts - 1))
            return [self.placed(circle[0], circle[1] + at) for at in across]
        if self.form == "dune":
            rho = 1 - up / self.height
            p, q = _ring(1.0, 0.5 * self.size[1])
            return [self.placed(rho * p * self._half_axes(p)[0], rho * q)] if rho > 0 else []
        if self.form in ("sphere", "half_sphere"):
            side = np.sqrt(max(0.0, r**2 - (up - (r if self.form == "sphere" else 0.0))**2))
            return [self.placed(*_ring(side, side))]
        if self.form != "box":
            side = np.sqrt(max(0.0, r**2 - (up - r)**2))
            a, b = (0.5 * self.length, side) if self.form == "cylinder_x" else (side, 0.5 * self.length)
        return [self._rectangle(a, b)]

    def _rectangle(self, a: float, b: float) -> np.ndarray:
        """Of half sizes a along and b across [m]; 0: through the whole domain."""
        corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)], float)
        places = self.placed(a * corners[:, 0], b * corners[:, 1])
        for axis, half, length in ((0, a, self.domain[0]), (1, b, self.domain[2])):
            if half == 0:
                places[:, axis] = 0.5 * length * (1 + corners[:, axis])
        return places

    def _stripes(self, up: float) -> list[np.ndarray]:
        """Of a wave: where it is higher than `up` [m]."""
        share = np.clip(2 * up / self.height - 1, -1, 1)
        half, n = np.arccos(share) / (2 * np.pi) * self.wavelength, round(self.domain[0] / self.wavelength)
        first = self.centre[0] % self.wavelength
        crests = first + self.wavelength * np.arange(-1, n + 1)
        ends = [np.clip((x - half, x + half), 0, self.domain[0]) for x in crests]
        return [np.array([(a, 0), (b, 0), (b, self.domain[2]), (a, self.domain[2]), (a, 0)])
                for a, b in ends if b > a]

    @property
    def reach(self) -> tuple[float, float, float, float]:
        """(x0, x1, z0, z1) [m] of its outline where it is widest."""
        if self.form == "wave":
            return 0.0, self.domain[0], 0.0, self.domain[2]
        places = np.concatenate(self.plan())
        (x0, z0), (x1, z1) = places.min(axis=0), places.max(axis=0)
        return float(x0), float(x1), float(z0), float(z1)

    def section(self, z: float) -> list[np.ndarray]:
        """Outlines (n, 2) in x and y [m] in the vertical plane z = `z` [m] along x."""
        x0, x1 = self.reach[:2]
        count = POINTS if self.form != "fence" else 8 * POINTS
        x = 0.5 * (x0 + x1) - 0.5 * (x1 - x0) * (1 - 1e-9) * np.cos(np.linspace(0, np.pi, count))
        if self.form == "wave":
            x = np.linspace(x0, x1, POINTS)
        x = np.unique(np.append(x, self.heart[0]))
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


def _corner(*faces: np.ndarray) -> np.ndarray:
    """Distance to a convex body from those to its faces, which meet at right angles; all (...) in m."""
    nearest = np.maximum.reduce(faces)
    outside = np.sqrt(sum(np.maximum(face, 0.0)**2 for face in faces))
    return np.where(np.sum([face > 0 for face in faces], axis=0) < 2, nearest, outside)


def _ring(a: float, b: float) -> tuple[np.ndarray, np.ndarray]:
    """Along (POINTS) and across (POINTS) of an ellipse of half axes a and b, closed [m]."""
    angle = np.linspace(0, 2 * np.pi, POINTS)
    return a * np.cos(angle), b * np.sin(angle)


def bodies_of(config: Mapping[str, Any]) -> tuple[Body, ...]:
    """The bodies of a case in their order; () where it has none."""
    size = config.get("domain", {}).get("size")
    known = {"name", "shape", "centre", "base", "axis", "radius", "height", "length", "size", "lee", "spacing",
             "wavelength", "angle"}
    if not isinstance(size, list) or len(size) != 3:
        return ()
    domain = (float(size[0]), float(size[1]), float(size[2]))
    return tuple(Body(number=number, domain=domain, **{key: tuple(value) if isinstance(value, list) else value
                                                       for key, value in table.items() if key in known})
                 for number, table in enumerate(config.get("body", ())))


def nearest(bodies: tuple[Body, ...], x: np.ndarray) -> np.ndarray:
    """(...) from places x (..., 3) to the nearest surface [m]; infinite without bodies."""
    x = np.asarray(x, float)
    return np.minimum.reduce([np.full(x.shape[:-1], np.inf)] + [body.distance(x) for body in bodies])


def tops(bodies: tuple[Body, ...], x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """(...) height of the highest body over places x, z [m]; NaN where none is."""
    each = [body.interval(x, z)[1] for body in bodies]
    return np.fmax.reduce([np.full(np.broadcast(x, z).shape, np.nan), *each])

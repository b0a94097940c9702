"""Pictures of the pages: film, six top views and 3-D still of one run, every grain a sphere.

Needs barchan and, of Debian, python3-numpy python3-matplotlib python3-pil python3-h5py python3-pandas ffmpeg povray.

    PYTHONPATH=python python3 docs/site/pictures.py runs/barchan-10k [film] [grid] [hero] [--time 9.36]

    ./barchan run configs/validation/resolved-load.toml --out runs/film --set time.end=0.34096 \\
        --set output.grains_interval=2.56e-4 --set output.fields_interval=1.024e-3
    PYTHONPATH=python python3 docs/site/pictures.py runs/film bed --every 1

film: docs/site/barchan.mp4 and .png, docs/barchan.webp; grid: docs/barchan-10k.png; hero: docs/barchan.png; bed:
docs/site/resolved-bed.mp4 and .png, the last 40 intervals of the fields.
Lengths are in millimetres; x points along the flow, y upward, z across. In views from above x points to the right
and z down the page, as in the figures of the program: the left horn is the upper one.
"""

from __future__ import annotations

import argparse
import subprocess
from pathlib import Path
from typing import NamedTuple

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont

import barchan
from barchan.figures import grain_image

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

DOCS = Path(__file__).resolve().parent.parent
FLOOR = np.array([0.925, 0.915, 0.895], np.float32)
SANDS = np.array([[87, 70, 45], [83, 65, 40], [90, 75, 52], [80, 61, 36], [93, 80, 60], [77, 57, 34], [86, 69, 46],
                  [55, 36, 22]], np.float32) / 100  # fmt: skip
DIAMETER, INK = 0.2, "#222222"
BED_FIELDS = 41  # frames of the flow behind resolved grains


class Window(NamedTuple):
    """Part of the floor seen from above: upper left corner and size in mm, pixels per mm."""
    x: float
    z: float
    length: float
    width: float
    scale: float

    @property
    def shape(self) -> tuple[int, int]:
        return round(self.width * self.scale / 2) * 2, round(self.length * self.scale / 2) * 2


def grains_of(run: barchan.Run, t: float) -> dict[str, np.ndarray]:
    """Grains at time t: positions and radii in mm, colour index from the number of the grain."""
    g = run.grains(t=t)
    ids = np.asarray(g.index, dtype=np.int64)
    colour = np.where(ids * 7919 % 100 < 7, 7, ids * 104729 % 7)
    columns = {k: 1e3 * np.asarray(g[k], dtype=float) for k in ("x", "y", "z", "d")}
    return columns | {"r": columns["d"] / 2, "colour": colour, "dune": np.asarray(g["dune"])}


def paint(g: dict[str, np.ndarray], w: Window) -> tuple[np.ndarray, np.ndarray]:
    """Height of the highest sphere at each pixel in mm, and its grain (-1: floor). Row 0 is the smallest z."""
    rows, columns = w.shape
    cx, cz, r = (g["x"] - w.x) * w.scale, (g["z"] - w.z) * w.scale, g["r"] * w.scale
    reach = int(np.ceil(r.max())) + 1
    i0, j0 = np.floor(cz).astype(int), np.floor(cx).astype(int)
    found = []
    for di in range(-reach, reach + 1):
        for dj in range(-reach, reach + 1):
            i, j = i0 + di, j0 + dj
            gap = (j + 0.5 - cx) ** 2 + (i + 0.5 - cz) ** 2
            k = np.flatnonzero((gap < r * r) & (i >= 0) & (i < rows) & (j >= 0) & (j < columns))
            found.append((i[k] * columns + j[k], g["y"][k] + np.sqrt(r[k] ** 2 - gap[k]) / w.scale, k))
    place, height, owner = (np.concatenate(part) for part in zip(*found, strict=True))
    order = np.argsort(height)  # lets the highest be written last
    h, who = np.zeros(rows * columns, np.float32), np.full(rows * columns, -1)
    h[place[order]], who[place[order]] = height[order], owner[order]
    return h.reshape(rows, columns), who.reshape(rows, columns)


def blurred(a: np.ndarray, half: int) -> np.ndarray:
    """Mean over a box of 2 half + 1 pixels, twice along each direction (nearly a Gaussian)."""
    for axis in (0, 1, 0, 1):
        pad = [(half + 1, half) if k == axis else (0, 0) for k in (0, 1)]
        s = np.cumsum(np.pad(a, pad, mode="edge"), axis=axis, dtype=np.float32)
        n = s.shape[axis]
        after, before = np.arange(2 * half + 1, n), np.arange(0, n - 2 * half - 1)
        a = ((s.take(after, axis) - s.take(before, axis)) / (2 * half + 1)).astype(np.float32)
    return a


def lit(h: np.ndarray, scale: float, elevation: float = 30.0, turn: float = 0.35) -> np.ndarray:
    """Share of the side light from upstream (`turn`: pixels across per pixel along) that reaches each pixel."""
    rows, columns = h.shape
    j = np.arange(columns)
    drift = np.round(turn * j).astype(int)
    reach = int(drift[-1]) + 1
    i = np.minimum(np.arange(rows + reach)[:, None] + drift, rows + 2 * reach - 1)
    rays = np.take_along_axis(np.pad(h, ((reach, reach), (0, 0))), i, axis=0)
    light = np.zeros_like(rays)
    step = np.hypot(1.0, turn) / scale
    for angle in elevation + np.array([-6.0, -3.0, 0.0, 3.0, 6.0]):
        along = rays + (np.tan(np.radians(angle)) * step * j).astype(np.float32)
        light += (np.maximum.accumulate(along, axis=1) - along) < 0.2 / scale
    back = np.arange(reach, rows + reach)[:, None] - drift[None, :]
    return np.take_along_axis(light, back, axis=0) / 5


def facing(h: np.ndarray, scale: float, sun: np.ndarray) -> np.ndarray:
    """Cosine between the normal of the height field and the light, not less than 0."""
    down, along = np.gradient(h * np.float32(scale))
    return np.maximum((sun[2] - sun[0] * along - sun[1] * down) / np.sqrt(1 + along**2 + down**2), 0)


def shade(h: np.ndarray, scale: float, sand: np.ndarray) -> np.ndarray:
    """Brightness of each pixel: side light with shadows, light of the sky less what neighbours hide."""
    sun = np.array([-np.cos(np.radians(30)), -0.3, np.sin(np.radians(30))], np.float32)
    sun /= np.linalg.norm(sun)
    low, s = h[::2, ::2], scale / 2
    form = facing(2 * blurred(low, round(1.2 * DIAMETER * s)), s, sun)
    form[~sand[::2, ::2]] = sun[2]
    hidden = sum(np.maximum(blurred(low, round(k * DIAMETER * s)) - low, 0) / (k * DIAMETER) for k in (0.4, 1.2, 3.0))
    sky, light = np.exp(-1.1 * hidden), lit(low, s)
    coarse = np.stack([0.42 * sky + 0.72 * light * form, 0.38 * light]).astype(np.float32)  # on every second pixel
    smooth, round_part = coarse.repeat(2, axis=1).repeat(2, axis=2)
    return smooth + round_part * facing(h, scale, sun)


def top_view(g: dict[str, np.ndarray], w: Window) -> np.ndarray:
    """Picture of the grains from above in sand colours, floats of 0 to 1."""
    h, who = paint(g, w)
    colour = np.concatenate([SANDS[g["colour"]], FLOOR[None]])[who]
    return np.clip(colour * (1.12 * shade(h, w.scale, who >= 0))[..., None], 0, 1) ** np.float32(0.88)


def labelled(picture: np.ndarray, w: Window, t: float) -> Image.Image:
    """Picture with the bar of 5 mm, the arrow of the flow and the time."""
    image = Image.fromarray((255 * picture).astype(np.uint8))
    pen, ink, u = ImageDraw.Draw(image), (40, 44, 48), image.width / 1600
    font = f"{matplotlib.get_data_path()}/fonts/ttf/DejaVuSans.ttf"
    letters, low = ImageFont.truetype(font, round(34 * u)), image.height - round(50 * u)
    start, end = image.width - round(60 * u) - 5 * w.scale, image.width - round(60 * u)
    pen.rectangle([start, low - 4 * u, end, low + 4 * u], fill=ink)
    pen.text(((start + end) / 2, low - 14 * u), "5 mm", fill=ink, font=letters, anchor="ms")
    pen.text((50 * u, 66 * u), "water", fill=ink, font=letters, anchor="ls")
    pen.line([170 * u, 55 * u, 300 * u, 55 * u], fill=ink, width=round(7 * u))
    pen.polygon([(295 * u, 38 * u), (335 * u, 55 * u), (295 * u, 72 * u)], fill=ink)
    pen.text((50 * u, low + 8 * u), f"t = {t:.1f} s", fill=ink, font=letters, anchor="ls")
    return image


def film(run: barchan.Run, work: Path, still: float, every: int) -> None:
    """Film of each `every`-th frame, 12 a second; the window follows the dune at its mean speed."""
    (frames := work / "frames").mkdir(parents=True, exist_ok=True)
    times = np.asarray(run.grain_times)[::every]
    path = np.polyfit(run.dune_columns[0]["t"], 1e3 * run.dune_columns[0]["Cx"], 3)
    for k, t in enumerate(times):
        name = frames / f"{k:04d}.png"  # remains from an interrupted call are used
        if not name.exists():
            w = Window(float(np.polyval(path, t)) - 11.0, 10.0, 32.0, 20.0, 50.0)
            labelled(top_view(grains_of(run, t), w), w, t).save(name, compress_level=1)
    call = f"ffmpeg -y -loglevel error -framerate 12 -i {frames}/%04d.png -c:v libx264 -preset veryfast"
    call += f" -crf 31 -pix_fmt yuv420p -movflags +faststart {DOCS}/site/barchan.mp4"
    subprocess.run(call.split(), check=True)
    poster = Image.open(frames / f"{int(np.argmin(abs(times - still))):04d}.png")
    poster.quantize(200, dither=Image.Dither.NONE).save(DOCS / "site" / "barchan.png", optimize=True)
    small = [Image.open(frame).resize((704, 440)) for frame in sorted(frames.glob("*.png"))]
    name = DOCS / "barchan.webp"
    for quality in (15, 5):
        small[0].save(name, save_all=True, append_images=small[1:], duration=95, loop=0, quality=quality, method=2)
        if name.stat().st_size < 2e6:
            return


def grid(run: barchan.Run, times: list[float]) -> None:
    """Six views from above, cropped to the dune; the colour is the height."""
    tint = matplotlib.colors.ListedColormap(plt.get_cmap("YlOrBr")(np.linspace(0.12, 0.87, 256)))
    arrow = {"arrowstyle": "-|>", "color": INK}
    figure, axes = plt.subplots(2, 3, figsize=(12, 7.4), layout="constrained")
    for axis, t in zip(axes.flat, times, strict=True):
        g = grains_of(run, t)
        w = Window(float(np.median(g["x"][g["dune"] == 0])) - 9.3, 9.0, 23.0, 22.0, 32.0)
        h, who = paint(g, w)
        light = np.clip(0.25 + 0.95 * shade(h, w.scale, who >= 0), 0, 1.15)[..., None]
        colour = np.where(who[..., None] < 0, 0.97, tint(h / 1.3)[..., :3])
        extent = (w.x, w.x + w.length, w.z + w.width, w.z)
        axis.imshow(np.clip(colour * light, 0, 1), extent=extent, interpolation="antialiased")
        smooth = blurred(h, round(1.5 * DIAMETER * w.scale))[::4, ::4]
        across, along = (np.linspace(0, side, n) for side, n in zip((w.width, w.length), smooth.shape, strict=True))
        axis.contour(w.x + along, w.z + across, smooth, 2 * DIAMETER * np.arange(1, 6), colors=INK, linewidths=0.7)
        axis.set(title=f"{t:g} s", xticks=[], yticks=[])
        axis.plot([w.x + 17, w.x + 22], [w.z + 21.2] * 2, color=INK, linewidth=3, solid_capstyle="butt")
        axis.text(w.x + 19.5, w.z + 20.8, "5 mm", ha="center", va="bottom", fontsize=10)
        axis.text(w.x + 0.8, w.z + 1.4, "water", ha="left", va="center", fontsize=10)
        axis.annotate("", (w.x + 7.5, w.z + 1.4), (w.x + 3.8, w.z + 1.4), arrowprops=arrow)
    bar = plt.cm.ScalarMappable(matplotlib.colors.Normalize(0, 1.3), tint)
    figure.colorbar(bar, ax=axes, shrink=0.6, aspect=30, label="height (mm); lines every 2 d = 0.4 mm")
    figure.savefig(DOCS / "barchan-10k.png", dpi=110)
    picture = Image.open(DOCS / "barchan-10k.png").convert("RGB").quantize(256, dither=Image.Dither.NONE)
    picture.save(DOCS / "barchan-10k.png", optimize=True)


def hero(run: barchan.Run, work: Path, t: float) -> None:
    """Still in three dimensions from the downstream side; POV-Ray paints it."""
    g = grains_of(run, t)
    cx, cz = (float(np.median(g[k][g["dune"] == 0])) + shift for k, shift in (("x", 1.2), ("z", 0.0)))
    lines = [
        "#version 3.7;",
        "global_settings { assumed_gamma 1.0 radiosity { count 30 error_bound 1.2 recursion_limit 1 brightness 0.8 } }",
        "background { rgb <0.50, 0.52, 0.55> }",
        "camera { perspective location <26, 19, -4> right x*16/9 up y angle 40 look_at <2.2, -0.2, 0.7> }",
        "light_source { <-34, 27, 30> rgb 1.75 area_light <6, 0, 7>, <0, 9, 0>, 4, 4 adaptive 1 jitter }",
        "#declare Ink = texture { pigment { rgb <0.03, 0.035, 0.04> } finish { ambient 0 diffuse 0.6 } }",
        "#declare Flat = transform { matrix <0, 0, 0.9, -0.9, 0, 0, 0, -1, 0, 0, 0, 0> };",
        "plane { y, 0 texture { pigment { rgb <0.80, 0.785, 0.755> } finish { ambient 0 diffuse 0.85 } } }",
    ]
    for k, sand in enumerate(SANDS):
        r, gr, b = sand**2.0
        lines.append(f"#declare S{k} = texture {{ pigment {{ rgb <{r:.3f},{gr:.3f},{b:.3f}> }} "
                     "finish { ambient 0 diffuse 0.9 specular 0.06 roughness 0.06 } }")  # fmt: skip
    for x, y, z, r, k in zip(g["x"] - cx, g["y"], g["z"] - cz, g["r"], g["colour"], strict=True):
        lines.append(f"sphere {{ <{x:.4f},{y:.4f},{-z:.4f}>,{r:.4f} texture {{ S{k} }} }}")
    lines += [
        "box { <8.2, 0, -2.5>, <8.32, 0.02, 2.5> texture { Ink } }",
        'text { internal 1 "5 mm" 0.02, 0 transform { Flat } translate <9.3, 0.02, -1> texture { Ink } }',
        "box { <-1.4, 0, -8.76>, <1.4, 0.02, -8.64> texture { Ink } }",
        "prism { linear_spline 0, 0.02, 4, <1.4, -9.1>, <1.4, -8.3>, <2.5, -8.7>, <1.4, -9.1> texture { Ink } }",
        'text { internal 1 "water" 0.02, 0 transform { Flat } translate <-1.8, 0.02, -9.9> texture { Ink } }',
    ]
    work.mkdir(parents=True, exist_ok=True)
    scene, picture = work / "hero.pov", work / "hero.png"
    scene.write_text("\n".join(lines) + "\n")
    size = ["+W1600", "+H900", "+A0.3", "+AM1", "+R2", "-D", "-GA", "-V", "+WT1"]
    subprocess.run(["povray", f"+I{scene}", f"+O{picture}", *size], check=True)
    Image.open(picture).convert("RGB").quantize(256).save(DOCS / "barchan.png", optimize=True)


def bed(run: barchan.Run, work: Path, every: int) -> None:
    """Film of resolved grains from the side; the water behind is blue where it is slower than its row, red: faster."""
    (frames := work / "bed").mkdir(parents=True, exist_ok=True)
    (length, height, _), seen_part = run.config["domain"]["size"], 0.75
    fields, largest, width = run.need_fields().times, run.config["fluid"]["top_velocity"] / 25, 720
    times = [t for t in run.grain_times if fields[-BED_FIELDS:][0] <= t <= fields[-1]][::every]
    for k, t in enumerate(times):
        after = int(np.clip(np.searchsorted(fields, t), 1, len(fields) - 1))
        flows = [run.flow_plane(frame, 0.0) for frame in (after - 1, after)]
        part = (t - fields[after - 1]) / (fields[after] - fields[after - 1])
        u = sum(w * flow.u for w, flow in zip((1 - part, part), flows, strict=True))
        u -= u.mean(axis=1, keepdims=True)
        g = run.grains(t=t)
        x, d = np.stack([g["x"], g["z"], height - g["y"]], axis=1), np.asarray(g["d"], float)
        x, d = np.concatenate([x, x + [length, 0, 0], x - [length, 0, 0]]), np.tile(d, 3)  # the box is periodic
        window, pixel = (0.0, length, (1 - seen_part) * height, height), length / width / 2
        who, top = grain_image.depth_buffer(x, d, window, pixel)
        down, along = ((np.arange(n) + 0.5) * pixel for n in who.shape)
        water = np.apply_along_axis(lambda line: np.interp(along, flows[0].x, line), 1, u)
        water = np.apply_along_axis(lambda line: np.interp(seen_part * height - down, flows[0].y, line), 0, water)
        picture = plt.get_cmap("RdBu_r")(0.5 + 0.5 * water / largest)[..., :3]
        colour = SANDS[np.arange(len(d)) % (len(d) // 3) * 7919 % 8]
        seen = who >= 0
        picture[seen] = colour[who[seen]] * grain_image.shade(who, top, x, d, window, pixel)[:, None]
        small = grain_image.block_mean(picture, 2)
        Image.fromarray((255 * small[: len(small) // 2 * 2]).astype(np.uint8)).save(frames / f"{k:04d}.png")
    call = f"ffmpeg -y -loglevel error -framerate 20 -i {frames}/%04d.png -c:v libx264 -preset veryslow -crf 30"
    subprocess.run([*call.split(), *f"-pix_fmt yuv420p -movflags +faststart {DOCS}/site/resolved-bed.mp4".split()],
                   check=True)
    poster = Image.open(frames / f"{len(times) // 2:04d}.png")
    poster.quantize(200, dither=Image.Dither.NONE).save(DOCS / "site" / "resolved-bed.png", optimize=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run")
    parser.add_argument("pictures", nargs="*", help="film, grid, hero (if none is named), bed")
    parser.add_argument("--time", type=float, default=9.36, help="time of the still and of the poster in s")
    parser.add_argument("--times", type=float, nargs=6, default=[0, 2, 4, 6, 8, 9.4], help="times of the six views")
    parser.add_argument("--every", type=int, default=3, help="step between the frames of the film")
    parser.add_argument("--work", type=Path, default=Path("build/pictures"), help="folder of frames and scene")
    o = parser.parse_args()
    run, wanted = barchan.Run(o.run), o.pictures or ["film", "grid", "hero"]
    calls = {"hero": (hero, o.work, o.time), "grid": (grid, o.times), "film": (film, o.work, o.time, o.every),
             "bed": (bed, o.work, o.every)}
    for call, *values in (calls[name] for name in wanted):
        call(run, *values)


if __name__ == "__main__":
    main()

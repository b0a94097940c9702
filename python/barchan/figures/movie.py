"""movie: the grains from above through a whole run, window and colours fixed.

RUN/movie.mp4 where ffmpeg is installed, else numbered pictures RUN/movie/0000.png and so on. Frames
are those of tracks.h5 where it has more than grains.h5 (diameters are then looked up by id). A run
of more than MOST frames (PICTURES without ffmpeg) is thinned evenly, so that it takes a few MB. As the
multimedia view of Fig. 10 of Lima et al. (2022).
"""

import io
import shutil
import subprocess

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from barchan.dune.bodies import bodies_of
from barchan.dune.current import always_along_x
from barchan.dune.tracks import known_grains
from barchan.errors import MissingData
from barchan.figures import bodies as body_pictures
from barchan.figures import style
from barchan.figures.grain_image import by_group, top_view
from barchan.figures.result import Told, write_numbers
from barchan.figures.topviews import colour_key, frame_window
from barchan.io import writing
from barchan.io.frames import FrameFile, Grains
from barchan.io.tables import thin

WIDTH, DPI = 6.4, 120         # [in], pixels per inch
AROUND = 0.95                 # [in], for the colour bar below and time, scale, flow above
TALLEST = 10.0                # [in], of the grains
MOST, PICTURES = 750, 150     # frames
RATE = 25                     # frames per second; fewer for runs of few frames
SHORTEST = 8.0                # [s] of film
LARGEST_RATE = 1_000_000      # [bit/s]


class Frames:
    """The frames to show: times [s], and their grains by index."""

    def __init__(self, run):
        self.run = run
        tracks = run.path / "tracks.h5"
        self.tracks = FrameFile(tracks, ("id", "x")) if tracks.exists() else None
        known = len(run.grain_file.frames) if run.grain_file else 0
        if not self.tracks or len(self.tracks.frames) <= known:
            self.tracks = None
        self.all = self.tracks.frames if self.tracks else run.need_grains().frames
        count = len(self.all)
        self.chosen = np.arange(count)
        self.thin(MOST)
        if self.tracks:
            self.known = known_grains(run)

    def thin(self, most):
        """At most `most` of the frames, first and last included."""
        self.chosen = self.chosen[thin(len(self.chosen), most)]

    def grains(self, index):
        if not self.tracks:
            return self.run.frame(index)
        time, name = self.all[index]
        with self.tracks.open() as file:
            number, x = file[name]["id"][:], file[name]["x"][:].astype(float)
            turned = file[name]["orientation"][:].astype(float) if "orientation" in file[name] else None
        known = self.known
        place = np.clip(np.searchsorted(known.id, number), 0, len(known.id) - 1)
        found = known.id[place] == number
        place = place[found]
        heap, kind = (None if group is None else group[place] for group in (known.heap, known.kind))
        return Grains(time, number[found], x[found], known.d[place], heap=heap, heaps=known.heaps, kind=kind,
                      kinds=known.kinds, orientation=None if turned is None else turned[found], shapes=known.shapes)

    def __iter__(self):
        return (self.grains(int(index)) for index in self.chosen)


def write_files(run):
    """Draws the frames; returns the paths to name."""
    frames = Frames(run)
    sample = [g for g in (frames.grains(int(index)) for index in
                          frames.chosen[np.linspace(0, len(frames.chosen) - 1, 9).astype(int)])
              if len(g.d)]
    if not sample:
        raise MissingData("needs a frame with grains in it")
    top = max(np.percentile(g.x[:, 1] + 0.5 * g.d, 99.9) for g in sample)
    named = max(sample, key=lambda grains: len(grains.groups))
    bodies = bodies_of(run)
    window = body_pictures.in_window(frame_window(sample), bodies)
    scene = Scene(window, top, named, always_along_x(run.config), bodies)
    log = {"frame": [], "t_s": [], "n_grains": []}
    program = shutil.which("ffmpeg")
    pictures = recorded(scene, frames, log)
    paths = film(run.path / "movie.mp4", pictures, program, len(frames.chosen)) if program else None
    if not paths:
        frames.thin(PICTURES)
        paths = numbered(run.path / "movie", recorded(scene, frames, clear(log)), len(named.groups))
    write_numbers(Told([], {"movie": log}), run.path)
    return paths


def clear(log):
    for values in log.values():
        values.clear()
    return log


def recorded(scene, frames, log):
    """The pictures one by one, noting what each shows."""
    for number, grains in enumerate(frames):
        for name, value in (("frame", number), ("t_s", grains.time), ("n_grains", len(grains.d))):
            log[name].append(value)
        yield scene.picture(grains)


class Scene:
    """A figure whose picture and time are replaced; even numbers of pixels, as film wants."""

    def __init__(self, window, top, named, along_x, bodies=()):
        ratio = min((window[3] - window[2]) / (window[1] - window[0]), TALLEST / WIDTH)
        height = WIDTH * ratio + AROUND
        even = [2 * round(0.5 * DPI * inches) / DPI for inches in (WIDTH, height)]
        self.window, self.top, self.bodies = window, top, bodies
        self.figure = Figure(figsize=even, dpi=DPI)
        FigureCanvasAgg(self.figure)
        axes = self.figure.subplots()
        extent = [1e3 * window[0], 1e3 * window[1], 1e3 * window[3], 1e3 * window[2]]
        axes.set(xticks=[], yticks=[], aspect="equal", xlim=extent[:2], ylim=extent[2:])
        self.image = axes.imshow(np.ones((2, 2, 3)), extent=extent, interpolation="antialiased")
        body_pictures.draw_plan(axes, bodies, named=True)
        above = 1.0 + 0.1 / (WIDTH * ratio)
        self.time = axes.text(0.005, above, "", transform=axes.transAxes, fontsize=10)
        style.scale_bar(axes, style.round_length(0.25e3 * (window[1] - window[0])), 0.4, above)
        if along_x:
            axes.annotate("", xy=(0.995, above), xytext=(0.9, above), xycoords="axes fraction",
                          arrowprops={"arrowstyle": "-|>", "color": style.BLACK, "shrinkA": 0, "shrinkB": 0})
            axes.text(0.89, above, "flow", transform=axes.transAxes, ha="right", va="center")
        colour_key(self.figure, axes, top, named.groups, named.kinds)
        self.figure.canvas.draw()
        self.figure.set_layout_engine("none")  # nothing moves from frame to frame

    def picture(self, grains):
        """RGB (rows, columns, 3), bytes."""
        self.image.set_data(top_view(grains, self.window, round(DPI * WIDTH), self.top, self.bodies))
        self.time.set_text(f"$t$ = {grains.time:.2f} s")
        self.figure.canvas.draw()
        return np.ascontiguousarray(np.asarray(self.figure.canvas.buffer_rgba())[:, :, :3])


def film(path, pictures, program, count):
    """H.264 by ffmpeg, beside and renamed; None when this ffmpeg cannot."""
    rate = max(2, min(RATE, round(count / SHORTEST)))
    first = next(pictures)
    size = f"{first.shape[1]}x{first.shape[0]}"
    command = [program, "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size,
               "-r", str(rate), "-i", "-", "-an", "-c:v", "libx264", "-crf", "24", "-maxrate",
               str(LARGEST_RATE), "-bufsize", str(2 * LARGEST_RATE), "-pix_fmt", "yuv420p",
               "-movflags", "+faststart", "-f", "mp4"]
    try:
        with writing.replacing(path) as beside:
            encode([*command, str(beside)], first, pictures)
    except (subprocess.CalledProcessError, FileNotFoundError):
        return None
    return [path]


def encode(command, first, pictures):
    """CalledProcessError where the program cannot."""
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.DEVNULL)
    try:
        process.stdin.write(first.tobytes())
        for picture in pictures:
            process.stdin.write(picture.tobytes())
        process.stdin.close()
    except BrokenPipeError:  # it has ended early, see its status
        pass
    if process.wait():
        raise subprocess.CalledProcessError(process.returncode, command)


def numbered(folder, pictures, groups):
    """PNG files of one palette; those of an earlier, longer run go."""
    writing.folder(folder)
    few_colours, names = palette(groups), set()
    for number, picture in enumerate(pictures):
        few = Image.fromarray(picture).quantize(palette=few_colours, dither=Image.Dither.NONE)
        encoded = io.BytesIO()
        few.save(encoded, format="png", optimize=True)
        writing.write(folder / f"{number:04d}.png", encoded.getvalue())
        names.add(f"{number:04d}.png")
    writing.only(folder, "[0-9][0-9][0-9][0-9].png", names)
    return [folder]


def palette(groups):
    """256 colours: the height map in light, in shade and towards white at the edges of grains; greys.

    Of kinds or heaps instead: their colours from shade to light and on towards white.
    """
    shades = matplotlib.colormaps[style.HEIGHT_MAP](np.linspace(0.0, 1.0, 45))[:, :3]
    if groups:
        colours = by_group(np.arange(min(groups, len(style.GROUPS))))
        steps = np.linspace(0.5, 1.0, 45 // len(colours))
        shades = (steps[:, None, None] * colours).reshape(-1, 3)
    grey = np.linspace(0.0, 1.0, 31)[:, None] * np.ones(3)
    colours = np.concatenate([shades, 0.6 * shades, 0.8 * shades, 0.67 * shades + 0.33,
                              0.33 * shades + 0.67, grey])
    result = Image.new("P", (1, 1))
    result.putpalette((255 * colours).round().astype(int).ravel().tolist())
    return result

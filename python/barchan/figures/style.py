"""One look for all figures, and the saving of them."""

import io
import logging

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from PIL import Image

from barchan.errors import BarchanError
from barchan.io.writing import write

# Okabe & Ito (2008), "Color universal design": told apart with any colour vision.
BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
BLUE, VERMILLION, PURPLE, GREY = "#0072B2", "#D55E00", "#CC79A7", "#8C8C8C"
SAND, SAND_EDGE = "#E8D9B5", "#6B5B3A"
BODY, BODY_EDGE = "#DADADA", "#4A4A4A"  # solids at rest

GROUPS = (ORANGE, BLUE, GREEN, PURPLE, SKY, VERMILLION)  # of grains: kinds, heaps; again from the first for more

HEIGHT_MAP = "viridis"
VELOCITY_MAP = "cividis"
FORCE_MAP = "coolwarm"  # Moreland (2009): zero is grey, so that white is left for "no data"

FULL_WIDTH = 7.1  # [in], two columns of a journal page
TALLEST = 50.0    # [in]: what is much wider across the stream than along it is drawn narrower
DPI = 150
LARGEST_PNG = 250_000  # [bytes]; above it the picture is stored with a palette

_SETTINGS = {
    "font.size": 8.5,
    "axes.titlesize": 8.5,
    "axes.labelsize": 8.5,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "legend.fontsize": 7.5,
    "mathtext.fontset": "dejavusans",
    "axes.linewidth": 0.6,
    "axes.prop_cycle": plt.cycler(color=[BLUE, VERMILLION, GREEN, ORANGE, PURPLE, SKY]),
    "axes.formatter.use_mathtext": True,
    "axes.formatter.limits": (-4, 6),
    "axes.formatter.useoffset": False,
    "lines.linewidth": 1.2,
    "legend.frameon": False,
    "legend.handlelength": 1.6,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "figure.constrained_layout.use": True,
    "pdf.fonttype": 42,
}


def look():
    """A context in which figures are drawn in the style of the project; outside of it nothing changes."""
    logging.getLogger("fontTools").setLevel(logging.ERROR)  # it remarks on the dates of fonts
    return plt.rc_context(_SETTINGS)


def panels(ax, rows=1, columns=1, **options):
    """(figure, axes (rows, columns)): of a new figure, or `ax`, an array of as many axes of the caller's.

    A new figure is not known to pyplot: a notebook shows it once, and it goes away with the last name for it.
    """
    if ax is None:
        layout = {name: options.pop(name) for name in ("figsize", "layout") if name in options}
        figure = Figure(**layout)
        figure.set_figheight(min(figure.get_figheight(), TALLEST))
        return figure, figure.subplots(rows, columns, squeeze=False, **options)
    given = np.array(ax, dtype=object).ravel()
    if len(given) != rows * columns:
        raise BarchanError(f"this figure has {rows * columns} panels: ax must be as many axes, not {len(given)}")
    return given[0].figure, given.reshape(rows, columns)


def own_page(ax):
    """For figures that lay out a whole page."""
    if ax is not None:
        raise BarchanError("this figure lays out a page of its own: it takes no ax")


def panel_label(axes, index, colour=BLACK):
    """(a), (b), ... in the upper left corner, outside the frame."""
    axes.set_title(f"({chr(ord('a') + index)})", loc="left", pad=3, color=colour)


WHITE_EDGE = [withStroke(linewidth=2.5, foreground="white")]  # of words over grains


def scale_bar(axes, length_mm, x, y, colour=BLACK, edge=()):
    """A horizontal bar of `length_mm`; the axes are in mm; x, y (its left end) in axes fractions; `edge`: none, or
    WHITE_EDGE."""
    left, right = axes.get_xlim()
    span = length_mm / abs(right - left)
    axes.plot([x, x + span], [y, y], transform=axes.transAxes, color=colour, lw=2,
              solid_capstyle="butt", clip_on=False, path_effects=edge)
    axes.annotate(f"{length_mm:g} mm", (x + 0.5 * span, y), xycoords="axes fraction",
                  xytext=(0, 3), textcoords="offset points", ha="center", va="bottom",
                  color=colour, fontsize=7.5, path_effects=edge)


def flow_arrow(axes, x, y, colour=BLACK):
    """"flow" and an arrow to the right behind it; x, y (left end) in axes fractions."""
    text = axes.annotate("flow", (x, y), xycoords="axes fraction", va="center", color=colour, fontsize=7.5,
                         annotation_clip=False)
    axes.annotate("", (1.05, 0.5), xycoords=text, xytext=(20, 0), textcoords="offset points", va="center",
                  arrowprops={"arrowstyle": "<|-", "color": colour, "lw": 1.0, "shrinkA": 0, "shrinkB": 0},
                  annotation_clip=False)


def mark_if_few(t):
    """The marker for a curve: few points are marked, many are a line."""
    return "o" if len(t) <= 12 else None


def reference_marks(colour=BLACK, marker="o", size=3.4):
    """Points of a reference: open symbols, beside lines of ours."""
    return {"ls": "", "marker": marker, "mfc": "none", "mec": colour, "mew": 0.7, "ms": size}


def round_length(length):
    """The largest of 1, 2, 5 x 10^n not above `length`."""
    power = 10.0
    while power > length:
        power /= 10.0
    while 10.0 * power <= length:
        power *= 10.0
    return max(m * power for m in (1.0, 2.0, 5.0) if m * power <= length)


def legend_outside(figure, handles, height, **options):
    """A legend above all panels (height > 0) or below them, in inches; on a page of others in their first panel."""
    if figure.get_layout_engine() is None:
        figure.axes[0].legend(handles=handles)
        return
    share = abs(height) / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, share if height < 0 else 0, 1, 1 - share))
    figure.legend(handles=handles, loc="upper center" if height > 0 else "lower center", **options)


def legend_above(axes, handles, **options):
    """A legend in one row above the right end of a panel, beside its title."""
    if handles:
        axes.legend(handles=handles, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=len(handles),
                    borderaxespad=0.0, borderpad=0.2, **options)


def save(figure, folder, name, title, kinds=("png",), largest=LARGEST_PNG):
    """Writes `name`.png, .pdf, .svg, as `kinds` says, into the folder, beside and renamed; returns the paths."""
    contents = {}
    for kind in ("png", "pdf", "svg"):  # an SVG file changes the figure: it comes last
        if kind in kinds:
            contents[folder / f"{name}.{kind}"] = ENCODERS[kind](figure, f"{title}: {name}", largest)
    for path, content in contents.items():
        write(path, content)
    return list(contents)


def _png(figure, _, largest):
    encoded = io.BytesIO()
    figure.savefig(encoded, format="png", dpi=DPI, facecolor="white")
    if encoded.tell() > largest:
        encoded = _with_palette(encoded, _colour_maps(figure))
    figure.set_layout_engine("none")  # panels stay where the PNG file has them
    return encoded.getvalue()


def _pdf(figure, title, _):
    document = io.BytesIO()
    figure.savefig(document, format="pdf", dpi=3 * DPI, metadata={"Title": title})
    return document.getvalue()


def _svg(figure, title, _):
    from barchan.figures import svg

    return svg.encoded(figure, title)


ENCODERS = {"png": _png, "pdf": _pdf, "svg": _svg}


def _colour_maps(figure):
    """The maps of the colour bars, each once."""
    shown = [axes._colorbar.cmap for axes in figure.axes if hasattr(axes, "_colorbar")]
    return list({colours.name: colours for colours in shown}.values())


def _with_palette(encoded, colour_maps):
    """256 colours: most fitted to the picture, some kept for the gradients of the colour bars."""
    picture = Image.open(encoded).convert("RGB")
    kept = np.concatenate([colours(np.linspace(0, 1, 48))[:, :3] for colours in colour_maps]
                          + [np.zeros((1, 3))])
    n_fitted = 256 - len(kept)
    fitted = np.array(picture.quantize(n_fitted).getpalette()).reshape(-1, 3)[:n_fitted]
    fitted[fitted.min(axis=1) > 245] = 255  # paper stays white
    colours = np.concatenate([fitted, (255 * kept).round().astype(int)])
    palette = Image.new("P", (1, 1))
    palette.putpalette(colours.ravel().tolist())
    smaller = picture.quantize(palette=palette, dither=Image.Dither.NONE)
    result = io.BytesIO()
    smaller.save(result, format="png", optimize=True, dpi=(DPI, DPI))
    return result

"""Which figures a study folder has: one per varied key, and those of all cases together."""

FIGURES = {
    "topviews": ("topview_study", "the grains from above, a row per time, a column per value"),
    "morphology": ("morphology_study", "width, length, centroid against time, a curve per value"),
    "laws": ("laws", "celerity, W, H, horns, loss and formation time against L, with fits (--from, --to)"),
    "means": ("means_study", "in words: what each dune is and does, with its spread (--from, --to); no picture"),
    "channel": ("channel_study", "turbulence statistics of all cases beside channel DNS"),
    "force_depth": ("force_depth", "force of the water on held heaps by depth below the surface (--from, --to)"),
}
# figures of Lima et al. (2022): (figure, what it varies)
PAPER = {
    "fig2": ("channel", None),
    "fig4": ("topviews", "grains.sliding_friction"),
    "fig5": ("topviews", "grains.restitution"),
    "fig6": ("topviews", "grains.rolling_friction"),
    "fig7": ("morphology", "grains.sliding_friction"),
    "fig8": ("morphology", "grains.restitution"),
    "fig9": ("morphology", "grains.rolling_friction"),
}
SAME = {"profiles": "channel"}
ON_REQUEST = ("laws", "means", "force_depth")  # of studies of sizes; draws nothing; of held heaps
# and the name that the picture has by default
OF_ALL_CASES = {"laws": "laws", "means": "means", "channel": "fig2", "force_depth": "force_depth"}


def known(name):
    return name in PAPER or SAME.get(name, name) in FIGURES


def jobs(study, names):
    """(file name, module, further arguments) of each figure; without names those of all keys."""
    result = []
    for name in names or (name for name in FIGURES if name not in ON_REQUEST):
        figure, key = PAPER.get(name, (SAME.get(name, name), None))
        module = FIGURES[figure][0]
        if figure in OF_ALL_CASES:
            result.append((name if names else OF_ALL_CASES[figure], module, ()))
        elif key:
            result.append((name, module, (key,)))
        else:
            result += [(file_name(study, figure, key, numbered=not names), module, (key,))
                       for key in study.keys]
    return result


def file_name(study, figure, key, numbered):
    """By default a figure that is in the paper has its number there."""
    for name, what in PAPER.items():
        if numbered and what == (figure, key):
            return name
    return f"{figure}_{study.short(key)}"

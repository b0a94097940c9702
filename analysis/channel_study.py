"""channel of a study: turbulence statistics of all cases beside DNS (as Fig. 2 of Lima et al. 2022).

The cases are those with statistics.csv, such as the channel on several meshes.
"""

import style
import tables
from validation import channel as validation_channel
from run_folder import NotInRun, read_table

LOOKS = ((style.BLUE, "-"), (style.VERMILLION, (0, (5, 1.2))), (style.GREEN, (0, (3, 1, 1, 1))),
         (style.ORANGE, (0, (1, 1))), (style.PURPLE, "-"), (style.SKY, (0, (5, 1.2))))
COLUMNS = ("y", "y_plus", "U_plus", "uu", "vv", "ww", "uv", "total")


def read_channels(study):
    """Channels of validation, one per case that has plane statistics over a wall."""
    channels = []
    for case in study.cases:
        path = case.run.path / "statistics.csv" if case.run else None
        table = read_table(path) if path and path.exists() else {}
        if len(table.get("y", ())) < 2 or not (table["U_plus"] > 0).all():
            continue
        height = case.run.domain[1] if case.run.domain else table["y"][-1]
        colour, dashes = LOOKS[len(channels) % len(LOOKS)]
        channels.append(validation_channel.Channel(
            case.name, label(case), colour, dashes, tables.Table({"height": f"{height} m"}, table)))
    if not channels:
        raise NotInRun("needs a case with statistics.csv: a [statistics] section in the base case")
    return channels


def label(case):
    cells = case.run.config.get("fluid", {}).get("cells")
    if case.varied in (None, "fluid.cells") and cells:
        return " x ".join(map(str, cells)) + " cells"
    return case.label


def draw(study):
    channels = read_channels(study)
    figure = validation_channel.draw_channels(channels, validation_channel.read_dns())
    write(study, channels)
    return figure


def write(study, channels):
    """In wall units, lengths over the height of the channel; uv is -<u'v'>."""
    columns = {"case": [[channel.name] * len(channel.curves["y"]) for channel in channels]}
    for name in COLUMNS:
        columns[name] = [channel.curves[name] for channel in channels]
    study.write_rows("channel", columns)

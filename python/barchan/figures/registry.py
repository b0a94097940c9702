"""Every figure, once: its name, what it shows, which files of a run it needs, and where it is drawn.

The command line, the documents and the tests take their lists from here.
"""

import importlib
import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from barchan.errors import BarchanError

OPTIONS = ("time", "start", "end")  # of the command line: --time, --from, --to


@dataclass(frozen=True)
class Entry:
    """`needs`: files of a run folder, of which `|` are alternatives. `on_request`: not drawn unless named.

    `by_key`: of a study, one picture for each key that it varies. `writes`: not a picture but a file of its own kind,
    which write_files(run) makes.
    """

    name: str
    module: str
    about: str
    needs: tuple[str, ...]
    on_request: bool = False
    by_key: bool = False
    writes: bool = False
    file: str = ""  # where the picture is called otherwise by default

    @property
    def draw(self) -> Callable[..., Any]:
        """draw(run, ax=None, ...) -> Figure; of figures without a picture -> Told."""
        return importlib.import_module(f"barchan.{self.module}").draw

    @property
    def write_files(self) -> Callable[..., Any]:
        """write_files(run) -> paths."""
        return importlib.import_module(f"barchan.{self.module}").write_files

    def options(self) -> tuple[str, ...]:
        """Those of OPTIONS that it takes."""
        return tuple(name for name in inspect.signature(self.draw).parameters if name in OPTIONS)


def table(*entries: Entry) -> dict[str, Entry]:
    return {entry.name: entry for entry in entries}


GRAINS, FIELDS, HISTORY, DUNES, MEANS = "grains.h5", "fields.h5", "history.csv", "dune.csv", "statistics.csv"
BED_LOAD = "bedload.csv"
BODIES, PROBES = "bodies.csv", "probes.csv|slice_NAME.h5"

OF_RUN = table(
    Entry("topviews", "figures.topviews", "the grains from above at several times", (GRAINS,)),
    Entry("height_map", "figures.height_map", "surface height at the start and at the end, centreline profile",
          (GRAINS,)),
    Entry("morphology", "figures.morphology", "width, length, height, centroid, horns against time", (DUNES,)),
    Entry("midplane", "figures.midplane", "flow and grains in the vertical plane through the dune", (FIELDS,)),
    Entry("profiles", "figures.profiles", "turbulence statistics over the height, with channel DNS", (MEANS,)),
    Entry("bedload", "figures.bedload", "grains over the height: fraction, velocity, production; surface of the bed",
          (BED_LOAD,)),
    Entry("history", "figures.history", "flow rate, shear, time step and solver against time", (HISTORY,)),
    Entry("encounters", "figures.encounters",
          "dunes that meet: paths, masses, exchange, outcome; writes encounters.csv",
          ("tracks.h5|grains.h5",)),
    Entry("encounter_forces", "figures.encounter_forces",
          "force of the water on two dunes that meet, grains that change sides", (GRAINS,)),
    Entry("report", "report", "one page about the run, with the grains as an animation: report.html", (), writes=True),
    Entry("profiles_over_dune", "figures.profiles_over_dune",
          "mean flow and stresses at stations along a frozen dune", ("flow_average.h5", GRAINS, DUNES)),
    Entry("movie", "figures.movie", "the grains from above through the whole run", (GRAINS,), on_request=True,
          writes=True),
    Entry("morphodynamics", "figures.morphodynamics",
          "slopes, flux over the crest, saltation and creep, avalanches (--from, --to)", (GRAINS, DUNES)),
    Entry("horns", "figures.horns", "lengths of the horns, their grains and where these came from, against time",
          (GRAINS, DUNES)),
    Entry("composition", "figures.composition",
          "share of each kind of grains at surface, crest and horns against time",
          (GRAINS, DUNES)),
    Entry("horn_origins", "figures.horn_origins", "grains of the horns, their paths and origins (--time)",
          (GRAINS, DUNES)),
    Entry("force_map", "figures.force_map", "mean resultant force on the grains about the dune (--from, --to)",
          ("force_map.csv|grains.h5",)),
    Entry("sectors", "figures.sectors", "in words: shares of horn grains by sector, signs of the force; no picture",
          (GRAINS, DUNES), on_request=True),
    Entry("forces_on_bodies", "figures.forces_on_bodies",
          "force of water and grains on each body, along x and upwards (--from, --to)", (BODIES,)),
    Entry("flow_around_body", "figures.flow_around_body",
          "mean flow around each body, separation bubble (--from, --to)", ("flow_average.h5|fields.h5",)),
    Entry("obstacles", "figures.obstacles",
          "a dune that meets a body or a crater, and the outcome; writes obstacles.csv",
          ("tracks.h5|grains.h5",)),
    Entry("scour", "figures.scour", "depth of the bed around each body against time, map of the bed at the end",
          (GRAINS,)),
    Entry("probes", "figures.probes", "the flow at points against time, means along lines (--from, --to), slices",
          (PROBES,)),
)
OF_STUDY = table(
    Entry("topviews", "figures.topviews_study", "the grains from above, a row per time, a column per value",
          (GRAINS,), by_key=True),
    Entry("morphology", "figures.morphology_study", "width, length, centroid against time, a curve per value",
          (DUNES,), by_key=True),
    Entry("laws", "figures.laws",
          "dunes against L, H and u_*, flux against phi c H: fits beside published exponents (--from, --to)", (DUNES,),
          on_request=True),
    Entry("means", "figures.means",
          "in words: what each dune is and does, with its spread (--from, --to); no picture", (DUNES,),
          on_request=True),
    Entry("channel", "figures.channel", "turbulence statistics of all cases, with channel DNS", (MEANS,),
          file="fig2"),
    Entry("force_depth", "figures.force_depth",
          "force of the water on frozen heaps by depth below the surface (--from, --to)", (GRAINS,), on_request=True),
)
# Figures of Lima et al. (2022): of a run; of a study, and the key that it varies there.
PAPER: dict[str, tuple[str, tuple[str, str | None] | None]] = {
    "fig2": ("profiles", ("channel", None)),
    "fig3": ("profiles_over_dune", None),
    "fig4": ("topviews", ("topviews", "grains.sliding_friction")),
    "fig5": ("topviews", ("topviews", "grains.restitution")),
    "fig6": ("topviews", ("topviews", "grains.rolling_friction")),
    "fig7": ("morphology", ("morphology", "grains.sliding_friction")),
    "fig8": ("morphology", ("morphology", "grains.restitution")),
    "fig9": ("morphology", ("morphology", "grains.rolling_friction")),
    "fig10": ("movie", None),
    "fig11": ("horn_origins", None),
    "fig12": ("horn_origins", None),
    "fig13": ("force_map", None),
}
ALIASES = {"channel": "profiles", **{name: of_run for name, (of_run, _) in PAPER.items()}}
STUDY_ALIASES = {"profiles": "channel"}


@dataclass(frozen=True)
class Job:
    """A picture to draw: its file name, its entry, and the key of a study."""

    file: str
    entry: Entry
    key: str | None = None

    def arguments(self) -> dict[str, Any]:
        return {"key": self.key} if self.entry.by_key else {}


def of_run(name: str) -> Entry:
    """The figure of a run with that name or number in the paper."""
    found = OF_RUN.get(ALIASES.get(name, name))
    if found is None:
        raise BarchanError(f'no figure "{name}" of a run; there are {", ".join((*OF_RUN, *ALIASES))}')
    return found


def of_study(name: str) -> tuple[Entry, str | None]:
    """The figure of a study with that name or number in the paper, and the key it belongs to, if to one."""
    figure, key = PAPER.get(name, ("", None))[1] or (STUDY_ALIASES.get(name, name), None)
    if figure not in OF_STUDY:
        raise BarchanError(f'no figure "{name}" of a study; there are {", ".join(OF_STUDY)}')
    return OF_STUDY[figure], key


def in_study(name: str) -> bool:
    return bool(PAPER.get(name, ("", None))[1]) or STUDY_ALIASES.get(name, name) in OF_STUDY


def jobs_of_run(names: list[str]) -> list[Job]:
    """Without names: all but those on request."""
    return [Job(name, of_run(name)) for name in names or (n for n, entry in OF_RUN.items() if not entry.on_request)]


def jobs_of_study(study: Any, names: list[str]) -> list[Job]:
    """The same; figures of a key once for each key of the study."""
    jobs = []
    for name in names or [n for n, entry in OF_STUDY.items() if not entry.on_request]:
        entry, key = of_study(name)
        if not entry.by_key:
            jobs.append(Job(name if names else entry.file or name, entry))
        elif key:
            jobs.append(Job(name, entry, key))
        else:
            jobs += [Job(study_file(study, entry, one, numbered=not names), entry, one) for one in study.keys]
    return jobs


def study_file(study: Any, entry: Entry, key: str, numbered: bool) -> str:
    """By default a figure that is in the paper has its number there."""
    for name, (_, there) in PAPER.items():
        if numbered and there == (entry.name, key):
            return name
    return f"{entry.name}_{study.short(key)}"

"""study.json, the cases of a study; study.csv, their results at the end; ensemble.csv, their spread."""

import csv
import io
import json
import math

from barchan.io import horn_lengths
from barchan.io.writing import write
from barchan.stats import spread

DUNE_COLUMNS = ("t", "W", "L", "H", "Cx", "Cz", "horn_left", "horn_right", "celerity", "n_grains", "n_lost",
                *map(horn_lengths.name, horn_lengths.SIDES))


def last_of_main_dune(folder):
    """The last line of dune.csv that is of the dune with the smallest label; strings."""
    try:
        rows = list(csv.DictReader((folder / "dune.csv").read_text(errors="replace").splitlines()))
        whole = [row for row in rows if all(row.values())]
        main = min(int(row["dune"]) for row in whole)
        of_main = [row for row in whole if int(row["dune"]) == main]
        columns = {name: [float(row[name]) for row in of_main] for name in rows[0]}
        steady = horn_lengths.medians(columns)
        return of_main[-1] | {name: f"{values[-1]:.9g}" for name, values in steady.items()}
    except (OSError, ValueError, KeyError, TypeError):
        return {}


def as_csv(rows):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def write_table(study, failed, status):
    """`status`: of each run, by its name."""
    cases = [{"name": case.run_name, "folder": case.run_name, "case": case.name,
              "realisation": case.realisation, "base": str(case.base), "varied": case.varied, "values": case.values}
             for case in study.cases]
    write(study.out / "study.json",
          json.dumps({"title": study.title, "base": str(study.cases[0].base), "cases": cases}, indent=1) + "\n")
    last = {case.run_name: last_of_main_dune(study.out / case.run_name) for case in study.cases}
    which = ["realisation"] * (study.realisations > 1)
    rows = [["case", *which, *study.keys, "status", *DUNE_COLUMNS]]
    rows += [[case.name, *(getattr(case, name) for name in which), *(case.values.get(key, "") for key in study.keys),
              status[case.run_name], *(last[case.run_name].get(column, "") for column in DUNE_COLUMNS)]
             for case in study.cases]
    write(study.out / "study.csv", as_csv(rows))
    if study.realisations > 1:
        write(study.out / "ensemble.csv", as_csv(ensemble_rows(study, status, last)))


def ensemble_rows(study, status, last):
    """For each case what its finished realisations say: mean, standard deviation, half of the mean's 95 % interval."""
    statistics = ("mean", "sd", "ci95")
    rows = [["case", *study.keys, "realisations",
             *(f"{column}_{name}" for column in DUNE_COLUMNS for name in statistics)]]
    for case in [case for case in study.cases if case.realisation == 1]:
        done = [last[one.run_name] for one in study.cases
                if one.name == case.name and status[one.run_name] == "done"]
        row = [case.name, *(case.values.get(key, "") for key in study.keys), len(done)]
        for column in DUNE_COLUMNS:
            values = [float(one[column]) for one in done if one.get(column)]
            known = spread(values) if len(values) == len(done) > 0 else None
            numbers = (known.mean, known.deviation, known.interval) if known else ()
            row += [f"{number:.6g}" if not math.isnan(number) else "" for number in numbers] or [""] * 3
        rows.append(row)
    return rows

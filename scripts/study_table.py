"""study.json, the cases of a study, and study.csv, their results at the end."""

import csv
import io
import json
import os

DUNE_COLUMNS = ("t", "W", "L", "H", "Cx", "Cz", "horn_left", "horn_right", "celerity", "n_grains", "n_lost")


def replace(path, text):
    beside = path.with_name(path.name + ".tmp")
    beside.write_text(text)
    os.replace(beside, path)


def last_of_main_dune(folder):
    """The last line of dune.csv that is of the dune with the smallest label; strings."""
    try:
        rows = list(csv.DictReader((folder / "dune.csv").read_text(errors="replace").splitlines()))
        whole = [row for row in rows if row.get("n_lost")]
        main = min(int(row["dune"]) for row in whole)
        return [row for row in whole if int(row["dune"]) == main][-1]
    except (OSError, ValueError, KeyError):
        return {}


def write_table(study, failed, status):
    cases = [{"name": case.name, "folder": case.name, "varied": case.varied, "values": case.values}
             for case in study.cases]
    replace(study.out / "study.json",
            json.dumps({"title": study.title, "base": str(study.base), "cases": cases}, indent=1) + "\n")
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(["case", *study.keys, "status", *DUNE_COLUMNS])
    for case in study.cases:
        row = last_of_main_dune(study.out / case.name)
        table.writerow([case.name, *(case.values.get(key, "") for key in study.keys), status[case.name],
                        *(row.get(column, "") for column in DUNE_COLUMNS)])
    replace(study.out / "study.csv", text.getvalue())

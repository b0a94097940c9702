"""What friction, restitution and rolling friction do to a dune, as the paper says in the text on its Figs 4 to 9,
judged from dune.csv of finished runs that differ in one key each."""
import csv
import tomllib

QUANTITIES = ("width", "length", "displacement", "shed")


def main_dune(run):
    """Rows of the main dune in a run's dune.csv, as numbers."""
    with open(run / "dune.csv", encoding="utf-8") as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file) if row["dune"] == "0"]
    if len(rows) < 2:
        raise ValueError(f"no dune in {run}")
    return rows


def seen_at(rows, time):
    """The dune at a time: W, L [m] as means over the second before, displacement of the centroid along the flow [m]
    and grains lost, both since the start."""
    before = [row for row in rows if row["t"] <= time + 1e-6]
    second = [row for row in before if row["t"] >= time - 1 - 1e-6]
    mean = lambda name: sum(row[name] for row in second) / len(second)
    return {"width": mean("W"), "length": mean("L"), "displacement": before[-1]["Cx"] - rows[0]["Cx"],
            "shed": rows[0]["n_grains"] - before[-1]["n_grains"]}


def seen_at_the_same_time(runs):
    """All dunes at the last time that all runs have reached."""
    dunes = [main_dune(run) for run in runs]
    time = min(rows[-1]["t"] for rows in dunes)
    if time < 1.5:
        raise ValueError("a run has not reached 1.5 s: its heap still slumps")
    return [seen_at(rows, time) for rows in dunes]


def sliding_friction(base, low):
    """Below mu = 0.4 the dune is wider and sheds more grains: (claim, less, more)."""
    return [("low mu: wider [m]", base["width"], low["width"]), ("low mu: more shed", base["shed"], low["shed"])]


def rolling_friction(base, high):
    return [("high mu_r: slower [m]", high["displacement"], base["displacement"])]


def restitution(base, bouncy, low_mu, high_mu_r):
    """Its effect is negligible: beside that of either friction on the same quantity."""
    change = lambda other, q: abs(other[q] - base[q])
    return [(f"e changes the {q} less than {key}", change(bouncy, q), change(other, q))
            for q in QUANTITIES for key, other in (("mu", low_mu), ("mu_r", high_mu_r))]


def broken(rules):
    """The claims that do not hold."""
    return [f"{claim}: {less:.4g} < {more:.4g}" for claim, less, more in rules if not less < more]


def changed_keys(run, other):
    """Keys of the physics in which two runs differ. Keys that only one of them has are younger than the other."""
    one, two = (tomllib.loads((folder / "config.toml").read_text()) for folder in (run, other))
    return [f"{section}.{key}" for section in ("domain", "fluid", "grains", "coupling")
            for key, value in one.get(section, {}).items()
            if not isinstance(value, dict) and two.get(section, {}).get(key, value) != value]

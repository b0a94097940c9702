#!/usr/bin/python3
"""Numbers that stand in two places are the same: in pages and in the tables, scripts and pages that they come from.

SAME has sentences, MEASURED tables of pages whose rows are those of a CSV file; results of the validation stand in its
table of all checks. A pattern that is not found any more is a fault, too: mend it, or better, delete the second number.
In the texts every white space is one blank, so a sentence may be broken anywhere."""
import csv
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
N = r"([-+]?\d[\d.]*(?:e-?\d+)?)"  # a number; a full stop behind it is cut off
CASES = r"\| `(?P<case>[\w/]+)` \| (?P<ms>[\d.]+) \((?P<ms_least>[\d.]+) to (?P<ms_most>[\d.]+)\)"
KERNELS = r"\| `(?P<case>pair_forces|list_build|momentum|wale|gather|deposit)`[^|]*\| (?P<ms>[\d.]+) \|"
RATIOS = r"\| (?P<ratio>[\d.]+) \((?P<least>[\d.]+) to (?P<most>[\d.]+)\) \| ?(?=\||$|- )"
COSTS = r"\| `(?P<case>[\w/-]+)` \|(?:[^|]*\|){1,2} (?P<takes_s>[\d.]+ (?:s|min|h|d)) \|"
SECONDS = {"s": 1, "min": 60, "h": 3600, "d": 86400}

# What, and (file, pattern with the numbers in brackets) of each place. perf/estimates.csv: what estimates() counts.
SAME = [
    ("agreement of a card and a CPU", ("docs/cluster.md", rf"positions agree to {N}, forces and velocities to {N}\."),
     ("scripts/first_light_judge.py", rf"STEP, FORCES = {N}, {N} ")),
    ("bed load over Wong & Parker's", ("docs/threshold.md", rf"{N} to {N} up to 0\.2,"),
     ("docs/validation.md", rf"a flat bed carries {N} to {N} of the flux"),
     ("docs/validation.md", rf"Shields 0\.15 to 0\.2 \| [^|]*\| {N} to {N} of it")),
    ("where a flat bed begins to move", ("docs/threshold.md", rf"begin to move at a Shields number of {N} to {N}"),
     ("docs/troubleshooting.md", rf"A flat bed of this program moves from {N} to {N} on")),
    ("Shields number of the paper's flow",
     ("docs/validation.md", rf"threshold \(Soulsby & Whitehouse\) \|[^|]*\| {N};"),
     ("docs/choosing.md", rf"`Shields number` \| {N} \|")),
    ("peaks of the stresses on the paper's meshes",
     ("docs/validation.md", rf"peaks of u'u', v'v' \|[^|]*\| \+{N},"),
     ("docs/validation.md", rf"peaks of single stresses miss by up to {N} %")),
    ("step over the Rayleigh time, smallest grain",
     ("docs/theory-grains.md", rf"for the mean grain and {N} % for the smallest"),
     ("docs/choosing.md", rf"and that of the shipped dunes, is {N} % of it"),
     ("configs/barchan-10k.toml", rf"\({N} % for the smallest grain")),
    ("turbulence in the box of the flat bed", ("docs/validation.md", rf"for at least {N} s at {N} m/s"),
     ("configs/validation/flat-bed.toml", rf"turbulence lives in it for {N} s at {N} m/s")),
    ("bytes of a cell, of the flow alone", ("docs/performance.md", rf"takes {N} bytes in a coupled step and {N} in a"),
     ("perf/scaling.py", rf"\(\({N} if case\.has_grains else {N}\)")),
    ("bytes of a grain in water", ("docs/performance.md", rf"bytes dry and {N} in water"),
     ("perf/scaling.py", rf"\* case\.cells \+ {N} \* case\.grains")),
    ("a moving grain step over one at rest", ("src/app/estimate.cpp", rf"kMovingOverResting = {N};"),
     ("docs/dev/performance.md", rf"moves the grains takes {N} times that at rest")),
    ("iterations with moving grains", ("src/app/estimate.cpp", rf"kIterationsOfMoving = {N};"),
     ("docs/dev/performance.md", rf"equation then takes {N} direct solves")),
    ("speed of the fastest grains", ("src/app/estimate.cpp", rf"std::max\({N} \* the_case"),
     ("docs/dev/performance.md", rf"go at {N} of the bulk velocity")),
    ("latency of a message", ("perf/scaling.py", rf"latency: float = {N}e-6"),
     ("docs/dev/scaling.md", rf"A message costs a latency \({N} us\)")),
    ("memory of a core", ("perf/scaling.py", rf'"CPU", memory={N}e9'),
     ("docs/dev/scaling.md", rf"less than {N} GB a core")),
    ("1e7 grains on 1,000 cores", ("docs/dev/scaling.md", rf"\| 1000 \| [^|]*\| [\d,]+ \({N} %\)"),
     ("docs/dev/scaling.md", rf"1e7 grains on cores: at about 1,000 cores\*\* \({N} % there\)")),
    ("1e9 cells on 1,000 cores", ("docs/dev/scaling.md", rf"\| 1000 \| (?:[^|]*\| ){{2}}[\d.]+ \({N} %\)"),
     ("docs/dev/scaling.md", rf"1e9 cells on cores: beyond 1,000 cores\*\* \({N} % there\)")),
    ("estimates within a factor of 1.5", ("docs/performance.md", rf"For {N} of the {N} cases measured"),
     ("perf/estimates.csv", "ratio")),
]

# Page, rows there, table, what stands before the name of a case in the table, how far off (of the number), fewest rows.
MEASURED = [
    ("docs/performance.md", CASES, "perf/measured.csv", "case", ("",), 0, 9),
    ("docs/dev/performance.md", KERNELS, "perf/measured.csv", "case", ("kernel/",), 0, 6),
    ("docs/performance.md", RATIOS, "perf/peers.csv", "ratio", ("",), 0, 8),
    ("docs/examples.md", COSTS, "perf/estimates.csv", "case", ("", "validation/"), 0.2, 10),
]
# Quantity in docs/validation/channel_summary.csv, and the row of docs/validation.md with its deviations.
CHANNEL = {"u_star": "$u_*$", "uu peak": "peak of u'u'", "vv peak": "peak of v'v'", "ww peak": "peak of w'w'",
           "-uv peak": "peak of -u'v'", "uu peak y+": "place of the u'u' peak", "vv peak y+": "place of the v'v' peak",
           "ww peak y+": "place of the w'w' peak", "-uv peak y+": "place of the -u'v' peak"}
CHECKS = "docs/checks.csv"
CHANNEL_COLUMNS = [f"{name} off (%)" for name in ("mesh1", "mesh3", "across", "along")]


def text_of(name):
    return " ".join((ROOT / name).read_text(encoding="utf-8").split())


def numbers_in(words):
    found = (number.rstrip(".") for number in re.findall(N, words))
    return [float(number) for number in found if number.count(".") < 2]  # not of versions


def lines_of(name):
    with open(ROOT / name, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def estimates():
    """How many of perf/estimates.csv are within a factor of 1.5, and how many there are."""
    ratios = [float(line["ratio"]) for line in lines_of("perf/estimates.csv")]
    return [sum(1 / 1.5 <= ratio <= 1.5 for ratio in ratios), len(ratios)]


def numbers_at(place):
    if place[0].endswith(".csv"):
        return estimates()
    found = re.search(place[1], text_of(place[0]))
    return found and [float(number.rstrip(".")) for number in found.groups() if number]


def wrong_sentences():
    for what, *places in SAME:
        found = [numbers_at(place) for place in places]
        for place, numbers in zip(places, found):
            if not numbers:
                yield f"{what}: nothing in {place[0]} is like {place[1]}"
        if all(found) and any(numbers != found[0] for numbers in found):
            yield f"{what}: " + " but ".join(f"{numbers} in {place[0]}" for place, numbers in zip(places, found))


def number(text):
    """With its unit of time in seconds."""
    value, *unit = text.split()
    return float(value) * (SECONDS[unit[0]] if unit else 1)


def wrong_rows(page, pattern, table, key, before, tolerance, fewest):
    lines = {line[key]: line for line in lines_of(table) if not line.get("changed")}
    n = 0
    for match in re.finditer(pattern, text_of(page)):
        line = next((lines[start + match[key]] for start in before if start + match[key] in lines), None)
        if line is None:
            if not tolerance:
                yield f"{page}: {match[key]} is not in {table}"
            continue
        n += 1
        for name in match.groupdict().keys() - {"case"}:
            there, here = number(line[name]), number(match[name])
            if abs(here - there) > tolerance * there:
                yield f"{page}: {match[key]} has {name} {here:g}, {table} {there:g}"
    if n < fewest:
        yield f"{page}: only {n} rows of {table}, not {fewest}"


def rows(page, start):
    return [line for line in (ROOT / page).read_text(encoding="utf-8").splitlines() if line.startswith("| " + start)]


def wrong_channel():
    lines = {line["quantity"]: line for line in lines_of("docs/validation/channel_summary.csv")}
    for quantity, start in CHANNEL.items():
        expected = [float(lines[quantity][name]) for name in CHANNEL_COLUMNS]
        found = rows("docs/validation.md", start + " |")
        if not found or numbers_in(found[0].split("|", 3)[3]) != expected:
            yield f"docs/validation.md: the row '{start}' is not {expected}"


def words_in(text):
    return set(re.findall(r"[a-z']{4,}", text.lower()))


def wrong_summary():
    """Numbers among the results of docs/validation.md, rounded or not, that the table of all checks does not have in
    its rows that share most words with the claim. Of changes of a last digit five in six are noticed."""
    checks = [(words_in(" ".join(line[name] for name in ("section", "claim", "source", "expected"))),
               {abs(value) for value in numbers_in(" ".join(line.values()))}) for line in lines_of(CHECKS)]
    results, heading = 0, ""
    for line in (ROOT / "docs/validation.md").read_text(encoding="utf-8").splitlines():
        heading = line if line.startswith("#") else heading
        if not line.startswith("| ") or line.count("|") != 5:
            continue
        _, claim, _, result, *_ = line.split("|")
        shared = [(len(words & words_in(claim + heading)), values) for words, values in checks]
        least = max(1, max(n for n, _ in shared) - 1)
        there = {value for n, values in shared if n >= least for value in values}
        results += 1
        for text in re.findall(r"\d[\d.]*(?:e-?\d+)?", result):
            said, digits = float(text.rstrip(".")), len(text.rstrip(".").partition(".")[2])
            if said not in there and ("e" in text or all(round(value, digits) != said for value in there)):
                yield f"docs/validation.md: {text} of '{result.strip()}' is not in {CHECKS} at '{claim.strip()}'"
    if results < 50:
        yield f"docs/validation.md: only {results} rows of results"


def wrong_scaling():
    script = ROOT / "perf/scaling.py"
    said = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True).stdout
    if said not in (ROOT / "docs/dev/scaling.md").read_text(encoding="utf-8"):
        yield "docs/dev/scaling.md: its table is not that of perf/scaling.py (--page docs/dev/scaling.md writes it)"


def wrong_measurements():
    """Tables of pages that python/validation computes from saved results."""
    sys.path.insert(0, str(ROOT / "python"))
    from validation import laminar_bed, tables, threshold
    folder = tables.ROOT / "docs/validation"
    page = text_of("docs/threshold.md")
    for line in threshold.summary(folder):
        load, flux = line.split(" | ")[2:4]
        if f"{load} ({flux.split()[0]})" not in page:
            yield f"docs/threshold.md has no '{load} ({flux.split()[0]})': {line}"
    page = text_of("docs/validation.md")
    for line in laminar_bed.summary(folder):
        case, _, _, height, shields, flux, *_ = line.split(" | ")
        found = re.search(rf"\| {case}(?:, torque)? \| {height} \| {shields} \|[^|]*\|[^|]*\| {N} \+- {N}", page)
        if not found or any(abs(float(a) - b) > 0.06e-3 for a, b in zip(found.groups(), numbers_in(flux))):
            yield f"docs/validation.md has no row of '{line}'"


def main():
    os.environ.setdefault("MPLBACKEND", "agg")
    wrong = [*wrong_sentences(), *wrong_channel(), *wrong_summary(), *wrong_scaling(), *wrong_measurements()]
    for one in MEASURED:
        wrong += wrong_rows(*one)
    print("\n".join(wrong))
    print(f"numbers: {len(SAME)} sentences, {len(MEASURED) + 4} tables, {len(wrong)} faults")
    return 1 if wrong else 0


sys.exit(main())

#!/usr/bin/python3
"""The paper's rules on friction, restitution and rolling friction, judged from finished runs of one case that differ
in one key each (docs/validation.md, "Dunes"; to 2 s some three minutes each on one core):
  ./barchan run configs/barchan-10k.toml --set time.end=2 --out runs/base
  ... --set grains.sliding_friction=0.2 --out runs/mu, ... --set grains.restitution=0.9 --out runs/e,
  ... --set grains.rolling_friction=0.3 --out runs/mu-r
BARCHAN_RULE_BASE, BARCHAN_RULE_MU, BARCHAN_RULE_E and BARCHAN_RULE_MU_R name the folders; skipped without them."""
import os
import pathlib
import sys

import dune_rules_judge as judge

KEYS = {"MU": "grains.sliding_friction", "E": "grains.restitution", "MU_R": "grains.rolling_friction"}


def main():
    runs = {name: pathlib.Path(os.environ.get(f"BARCHAN_RULE_{name}", "")) for name in ("BASE", *KEYS)}
    if any(folder == pathlib.Path() for folder in runs.values()):
        print("BARCHAN_RULE_BASE, _MU, _E and _MU_R name finished runs, and are not all set")
        return 77
    problems = [f"{runs[name]} differs from the base case in {changed}, not in {key}" for name, key in KEYS.items()
                if (changed := judge.changed_keys(runs["BASE"], runs[name])) != [key]]
    seen = dict(zip(runs, judge.seen_at_the_same_time(runs.values())))
    for name, dune in seen.items():
        print(f"[ measured ] {name}: " + ", ".join(f"{quantity} {value:.4g}" for quantity, value in dune.items()))
    rules = [*judge.sliding_friction(seen["BASE"], seen["MU"]), *judge.rolling_friction(seen["BASE"], seen["MU_R"]),
             *judge.restitution(seen["BASE"], seen["E"], seen["MU"], seen["MU_R"])]
    problems += judge.broken(rules)
    print("\n".join(problems) or f"{len(rules)} rules hold")
    return 1 if problems else 0


sys.exit(main())

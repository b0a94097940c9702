#!/usr/bin/python3
"""The judge of the paper's rules on friction and restitution, on runs whose dunes are made up."""
import faults
from dune_rules_judge import broken, restitution, rolling_friction, seen_at_the_same_time, sliding_friction

BASE = {"width": 0.020, "length": 0.010, "displacement": 0.004, "shed": 300}
HEADER = "t,dune,n_grains,W,L,Cx\n"


def write_run(run, end):
    """dune.csv to `end` [s] of a dune that is BASE at 2 s and moves and sheds steadily; a second one must not count."""
    run.mkdir()
    lines = [f"{t},0,{9000 - 0.5 * t * BASE['shed']},{1 if t < 1 else BASE['width']},{BASE['length']},"
             f"{0.02 + 0.5 * t * BASE['displacement']}\n{t},1,120,0.5,0.5,{0.2 * t}\n"
             for t in (0.05 * n for n in range(round(20 * end) + 1))]
    (run / "dune.csv").write_text(HEADER + "".join(lines))
    return run


def expect(count, rules):
    if len(broken(rules)) != count:
        faults.fail(f"{len(broken(rules))} rules do not hold, expected {count}: {broken(rules)}")


def expect_refused(*runs):
    try:
        seen_at_the_same_time(runs)
    except (ValueError, OSError):
        return
    faults.fail(f"{runs} are judged")


def main(work):
    long, whole, early = (write_run(work / str(end), end) for end in (8, 2, 1))
    for seen in seen_at_the_same_time([long, whole]):  # at the last time that both have reached
        if any(abs(seen[name] - value) > 1e-6 * value for name, value in BASE.items()):
            faults.fail(f"{seen} is not {BASE}")
    expect_refused(whole, early)
    expect_refused(work / "nowhere")
    (early / "dune.csv").write_text(HEADER)
    expect_refused(early)
    low = {**BASE, "width": 0.022, "shed": 400}
    expect(0, sliding_friction(BASE, low))
    expect(2, sliding_friction(low, BASE))
    expect(1, sliding_friction(BASE, {**low, "width": 0.019}))
    expect(0, rolling_friction(BASE, {**BASE, "displacement": 0.002}))
    expect(1, rolling_friction({**BASE, "displacement": 0.002}, BASE))
    low, high = ({"width": w, "length": l, "displacement": d, "shed": n}
                 for w, l, d, n in ((0.022, 0.009, 0.006, 500), (0.018, 0.012, 0.002, 100)))
    bouncy = {"width": 0.0201, "length": 0.0098, "displacement": 0.0042, "shed": 250}
    expect(0, restitution(BASE, bouncy, low, high))
    expect(2, restitution(BASE, {**bouncy, "displacement": 0.0065}, low, high))  # more than either changes it
    expect(1, restitution(BASE, {**bouncy, "length": 0.0115}, low, high))  # more than mu, less than mu_r


if __name__ == "__main__":
    faults.in_a_new_folder(main)

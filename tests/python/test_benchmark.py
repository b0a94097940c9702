"""The benchmark: scores against made-up references, errors of tables, whole folders, the page, measurements."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

from benchmark import cases, column, folders, main, page, scores, scour
from validation import SAVED


def curve(at, value, error):
    return folders.Curve(*(np.array(one, float) for one in (at, value, error)))


def test_score_is_the_distance_in_errors():
    reference = curve([0, 1, 2, 4], [1, 2, 3, 5], [0.5, 0.5, 0.5, 0.1])
    same = scores.score(reference, curve([0, 4], [1, 5], [0, 0]))  # a straight line through all
    assert same.distance == pytest.approx(0) and same.reached == 4 and same.word == "within"
    above = scores.score(reference, curve([0, 2], [1.5, 3.5], [0, 0]))
    assert above.distance == pytest.approx(1) and above.bias == pytest.approx(1)
    assert (above.reached, above.points) == (3, 4)
    below = scores.score(reference, curve([4, 5], [4.7, 9], [0, 0]))
    assert below.distance == pytest.approx(3) and below.bias == pytest.approx(-3) and below.word == "missed"


def test_score_of_what_is_not_reached_is_no_number():
    found = scores.score(curve([0, 1], [1, 1], [1, 1]), curve([5, 6], [1, 1], [0, 0]))
    assert np.isnan(found.distance) and found.reached == 0
    assert np.isnan(scores.total({"a": found})) and scores.total({"a": found, "b": scores.Score(2, 2, 1, 1)}) == 2


def test_single_number_and_quantity_without_reference():
    references = {"a": curve([np.nan], [3], [0.5]), "b": curve([np.nan], [np.nan], [np.nan])}
    found = scores.scores(references, {"a": curve([np.nan], [4], [0]), "b": curve([np.nan], [7], [0])})
    assert list(found) == ["a"] and found["a"].distance == pytest.approx(2)


def test_a_score_says_what_it_is_made_of():
    references = {"a": curve([np.nan], [3], [0.5]), "c": curve([0, 1], [1, 1], [1, 1])}
    found = scores.scores(references, {"a": curve([np.nan], [3.5], [0])})
    assert found["a"].word == "within" and found["c"].word == "not given"
    assert scores.share(found) == "1 of 2 quantities, 1 of 3 points" and scores.total(found) == pytest.approx(1)


def test_a_curve_may_end_a_little_before_the_last_point():
    reference = curve([0, 1, 2], [0, 0, 0], [1, 1, 1])
    assert scores.score(reference, curve([0.01, 1.99], [1, 1], [0, 0])).reached == 3
    assert scores.score(reference, curve([0.05, 1.95], [1, 1], [0, 0])).reached == 1


@pytest.mark.parametrize("text, said", [
    ("quantity,at,value\na,1,2\n", "results.csv:1: needs the columns spread"),
    ("# x\nquantity,at,value,spread\na,1,2\n", "results.csv:3: has 3 fields, not 4"),
    ("quantity,at,value,spread\nloose_front,1,two,\n", "results.csv:2: 'two' is not a number"),
    ("quantity,at,value,spread\nloose_front,1,,\n", "results.csv:2: needs a value"),
    ("quantity,at,value,spread\nlose_front,1,2,\n", "'lose_front' is not a quantity of column; there are loose_front"),
    ("quantity,at,value,spread\nloose_front,,2,\n", "loose_front needs `at` in each line: t V/H"),
    ("quantity,at,value,spread\nloose_front,1,2,\nloose_front,1,3,\n", "loose_front has two values at one place"),
    ("quantity,at,value,spread\nloose_front,1,2,-1\n", "loose_front has a negative spread"),
    ("", "has no values")])
def test_bad_results_are_told(tmp_path, capsys, text, said):
    file = tmp_path / "results.csv"
    file.write_text(text)
    assert main(["column", "--score", str(file)]) == 2
    assert said in capsys.readouterr().err


def test_results_of_another_program_are_scored(tmp_path, capsys):
    file, reference = tmp_path / "results.csv", folders.find("column").reference["loose_front"]
    rows = [f"loose_front,{at},{value + 2 * error}," for at, value, error in
            zip(reference.at, reference.value, reference.error)]
    file.write_text("\n".join([folders.RESULT_COLUMNS, *rows]) + "\n")
    assert main(["column", "--score", str(file)]) == 0
    assert "loose_front              2.00   +2.00" in capsys.readouterr().out


def test_unknown_case_and_options_are_told(capsys):
    assert main(["columns", "--no-runs"]) == 2
    assert "there is no benchmark case 'columns'; there are one-grain, " in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["--score", "x.csv"])


@pytest.mark.parametrize("name", folders.names())
def test_folder_is_whole(name):
    case = folders.find(name)
    statement = (case.path / "statement.md").read_text()
    assert not [word for word in ("toml", "Barchan", "./", "grains.", "fluid.") if word in statement]
    known = case.reference
    for quantity, one in known.items():
        assert f"`{quantity}`" in statement
        assert np.isnan(one.value).all() or (one.error > 0).all() and one.source
    assert isinstance(json.loads((case.path / "input.json").read_text()), dict)
    for study in cases.MEASURES[name].STUDIES:
        assert (folders.ROOT / f"configs/{study}.toml").exists()
    for program in case.programs:
        assert scores.scores(known, case.result(program)[1])


def test_page_is_made_from_the_folders():
    assert page.PAGE.read_text() == page.text(), "run ./barchan benchmark --keep"


@pytest.mark.parametrize("name", ["one-grain", "flat-bed"])
def test_results_from_the_validation_are_those_of_its_tables(name):
    curves, _ = cases.measure(name, "nowhere", SAVED)[folders.OWN]
    kept = folders.read_results(folders.find(name).result_file(), folders.find(name))
    for quantity, one in curves.items():
        assert kept[quantity].value == pytest.approx(one.value, rel=1e-3)


def test_runs_are_averaged_over_what_all_reached():
    mean = cases.together([{"a": ([0, 1, 2], [0, 1, 2]), "b": ([np.nan], [3])},
                           {"a": ([0, 1], [2, 3]), "b": ([np.nan], [5])}])
    assert mean["a"].at == pytest.approx([0, 1]) and mean["a"].value == pytest.approx([1, 2])
    assert mean["a"].error == pytest.approx([2**0.5, 2**0.5]) and mean["b"].value == pytest.approx([4])


def lattice(lengths, d):
    """Grains of a cubic lattice in a box from the origin."""
    axes = [(np.arange(round(length / d)) + 0.5) * d for length in lengths]
    x = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return SimpleNamespace(x=x, d=np.full(len(x), d))


def test_angles_about_downstream_do_not_become_upstream():
    assert abs((scour.mean_angle([350, 10]) + 180) % 360 - 180) < 1e-9
    assert scour.mean_angle([100, 260]) == pytest.approx(180)


def test_front_and_heights_of_a_column():
    d, wall = 1e-3, 5e-3
    grains = lattice((0.02, 0.010, 0.004), d)
    grains.x[:, 0] += wall
    scales = SimpleNamespace(d=d, wall=wall, width=0.004)
    depth = np.pi / 6 / 0.6 * 0.010  # of the last bin; the next is empty
    assert column.front(grains, scales) == pytest.approx(0.019 + 0.002 * (1 - d / depth))
    at, high = column.heights(grains, scales, 30)
    assert high[:10] == pytest.approx(np.full(10, 0.010)) and high[10:] == pytest.approx(np.zeros(5))
    assert at[:2] == pytest.approx([1e-3, 3e-3])


def test_level_of_a_bed_leaves_out_grains_in_flight():
    d = 1e-3
    grains = lattice((0.02, 0.008, 0.004), d)
    above = grains.x[:5] + [0, 0.009, 0]
    grains = SimpleNamespace(x=np.concatenate([grains.x, above]), d=np.full(len(grains.x) + 5, d))
    everything = np.ones(len(grains.d), bool)
    assert scour.level(grains, everything, 0.02 * 0.004, d) == pytest.approx(0.008, abs=d)


def made_up_run(frames, times, config, **more):
    """A run with these grains at these times."""
    return SimpleNamespace(frame=lambda number: frames[number], config=config, path=SimpleNamespace(name="loose"),
                           need_grains=lambda: SimpleNamespace(times=np.array(times)), **more)


def test_depth_of_a_hole_under_a_pipe():
    d, fluid = 2e-4, {"density": 1000.0, "kinematic_viscosity": 1e-6, "mean_velocity": 0.2}
    flat = lattice((0.03, 0.004, 0.0012), d)
    away = (abs(flat.x[:, 0] - 0.015) > 0.001) | (flat.x[:, 1] < 0.0025)
    dug = SimpleNamespace(x=flat.x[away], d=flat.d[away])
    run = made_up_run([flat, dug], [0.0, 1.0], {
        "body": [{"axis": "z", "centre": [0.015, 0.0006], "radius": 1.5e-3}], "fluid": fluid,
        "grains": {"density": 2500.0, "gravity": [0, -9.81, 0]}, "domain": {"size": [0.03, 0.0144, 0.0012]}})
    at, depth = scour.measure_run(run)["pipe_depth"]
    assert depth == pytest.approx([0, 1.6 / 3], abs=0.5 * d / 3e-3)  # from 4 to 2.4 mm
    water = 0.0144 - 0.004
    stress = 0.073 * (2 * water * 0.2 / 1e-6)**-0.25 / 2 * 1000 * 0.2**2
    time = 9e-6 / np.sqrt(1.5 * 9.81 * d**3) * (stress / (1500 * 9.81 * d))**(-5 / 3) / 50
    assert at == pytest.approx([0, 1 / time], rel=0.02)


def test_pressure_and_front_of_a_column_are_dimensionless():
    d, wall = 225e-6, 1e-3
    grains = lattice((column.LENGTH * d, 30 * d, 8 * d), d)
    grains.x[:, 0] += wall
    config = {"body": [{"centre": [wall / 2, 0], "size": [wall, 0]}], "domain": {"size": [0.04, 0.012, 8 * d]},
              "fluid": {"density": 1010.0, "kinematic_viscosity": 1.2e-5},
              "grains": {"density": 2500.0, "gravity": [0, -9.81, 0]}}
    scales = column.Scales(made_up_run([grains], [0.0], config))
    assert scales.height == pytest.approx(30 * d)
    assert scales.weight == pytest.approx(1490 * 9.81 * np.pi / 6 * 30 * d)
    assert scales.time == pytest.approx(30 * d / (1490 * 9.81 * d**2 / (18 * 1010 * 1.2e-5)))
    times = np.repeat([0.0, 0.01], 3)
    probes = {"base": {"t": times, "p": np.array([0, 0, 0, 5.0, 6.0, 7.0])},
              "far": {"t": np.array([0.0, 0.01]), "p": np.array([0.0, 2.0])}}
    run = made_up_run([grains, grains], [0.0, 0.01], config, probe_columns=probes)
    found = column.measure_run(run)
    assert list(found) == ["loose_front", "loose_pressure"]
    assert found["loose_pressure"][1] == pytest.approx([2 / scales.weight])  # the mean of 0 and 4 Pa
    assert found["loose_front"][0] == pytest.approx([0, 0.01 / scales.time])

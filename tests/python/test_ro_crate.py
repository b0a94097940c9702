"""ro-crate-metadata.json of run folders, by the rules of RO-Crate 1.1: of a run, a restart, a failure, two ranks."""

import datetime
import json
import os
import shutil
import subprocess

import pytest
from fake_runs import ROOT

PROGRAM = os.environ.get("BARCHAN_PROGRAM", "")
CRATE = "ro-crate-metadata.json"
pytestmark = pytest.mark.skipif(not PROGRAM, reason="needs the program, whose path BARCHAN_PROGRAM has")


def run(out, *options, status=0, ranks=1):
    command = [PROGRAM, "run", ROOT / "tests/support/small_dune.toml", "--out", out, "--quiet", *options]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "--allow-run-as-root", "-np", str(ranks), *command]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert done.returncode == status, done.stderr


def end(seconds):
    return "--set", f"time.end={seconds}"


def when(text):
    return datetime.datetime.fromisoformat(text)


def entities(folder):
    """{id: entity} of a crate that follows the rules."""
    crate = json.loads((folder / CRATE).read_text())
    assert crate["@context"] == "https://w3id.org/ro/crate/1.1/context" and set(crate) == {"@context", "@graph"}
    there = {entity["@id"]: entity for entity in crate["@graph"]}
    assert len(there) == len(crate["@graph"])  # no id twice
    assert all(isinstance(entity["@type"], str) for entity in there.values())
    descriptor, root = there[CRATE], there["./"]
    assert descriptor == {"@id": CRATE, "@type": "CreativeWork", "about": {"@id": "./"},
                          "conformsTo": {"@id": "https://w3id.org/ro/crate/1.1"}}
    assert root["@type"] == "Dataset" and root["name"] and root["description"]
    assert abs(when(root["datePublished"]) - datetime.datetime.now(datetime.timezone.utc)) < datetime.timedelta(hours=1)
    files = {id for id, entity in there.items() if entity["@type"] == "File"}
    assert {part["@id"] for part in root["hasPart"]} == files
    for name in files:
        assert (folder / name).is_file() and "/" in there[name]["encodingFormat"] and there[name]["description"]
    references = [value for entity in there.values() for values in entity.values()
                  for value in (values if isinstance(values, list) else [values]) if isinstance(value, dict)]
    assert all(set(one) == {"@id"} for one in references)  # flattened
    assert all(one["@id"] in there or one["@id"].startswith(("http://schema.org/", "https://w3id.org/"))
               for one in references)
    return there


def actions(there):
    return [entity for entity in there.values() if entity["@type"] == "CreateAction"]


def status_of(action):
    return action["actionStatus"]["@id"].removeprefix("http://schema.org/").removesuffix("ActionStatus")


@pytest.fixture(scope="module")
def base(tmp_path_factory):
    folder = tmp_path_factory.mktemp("crate") / "run"
    run(folder, *end(0.002), "--set", 'case.notes="of a test"')
    return folder


def test_a_run_is_described(base):
    there = entities(base)
    assert (there["./"]["name"], there["./"]["description"]) == ("Small coupled case", "of a test")
    summary = json.loads((base / "run.json").read_text())
    program = there["#barchan"]
    assert program["@type"] == "SoftwareApplication"
    assert (program["softwareVersion"], program["identifier"]) == (summary["version"], summary["git_hash"])
    action, = actions(there)
    assert action["instrument"] == {"@id": "#barchan"} and {"@id": "config.toml"} in action["object"]
    assert {"@id": "grains.h5"} in action["result"] and {"@id": "config.toml"} not in action["result"]
    assert when(action["startTime"]) < when(action["endTime"]) and status_of(action) == "Completed"
    left_out = {path.name for path in base.iterdir()} - set(there)
    assert left_out == set()  # every file of a run has a meaning


def test_a_restart_adds_an_action(base, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(base, folder)
    run(folder, *end(0.003), "--resume", ranks=2)
    there = entities(folder)
    first, second = actions(there)
    assert first["endTime"] == actions(entities(base))[0]["endTime"] < second["startTime"]
    assert [status_of(first), status_of(second)] == ["Completed", "Completed"]
    assert not (folder / f"{CRATE}.tmp").exists()
    run(folder, *end(0.002), "--overwrite")
    assert len(actions(entities(folder))) == 1


@pytest.mark.parametrize("content, left", [
    ("", 0), ("[]", 0), ("{", 0), ('{"@graph": 3}', 0), ('{"@graph": [1, {"@type": ["CreateAction"]}]}', 0),
    ('{"@graph": [{"@type": "CreateAction"}]}', 0), (5000 * "[", 0),
    ('{"@graph": [{"@type": "CreateAction", "startTime": "2026-01-01T00:00:00Z", "agent": {"@id": "#me"}}]}', 1)])
def test_what_others_left_in_the_file_costs_no_restart(base, tmp_path, content, left):
    folder = tmp_path / "run"
    shutil.copytree(base, folder)
    (folder / CRATE).write_text(content)
    run(folder, *end(0.00225), "--resume")
    found = actions(entities(folder))
    assert len(found) == left + 1
    assert [status_of(action) for action in found[:left]] == left * ["Failed"]  # without an end: it was killed


def test_a_failed_and_a_stopped_run(tmp_path):
    run(tmp_path / "failed", *end(0.02), "--set", "grains.max_overlap=1e-9", status=1)
    there = entities(tmp_path / "failed")
    action, = actions(there)
    message = json.loads((tmp_path / "failed/run.json").read_text())["message"]
    assert status_of(action) == "Failed" and action["error"] == message and "endTime" in action
    assert "failure_grains.h5" in there
    run(tmp_path / "stopped", *end(10), "--set", "time.wall_clock_limit=0.3", status=3)
    action, = actions(entities(tmp_path / "stopped"))
    assert status_of(action) == "Completed" and action["description"] == "the wall-clock limit was reached"


def test_docs_name_every_file_of_the_table():
    """docs/files.md and the table of the program."""
    text = (ROOT / "src/run/run_folder.cpp").read_text()
    names = [line.split('"')[1] for line in text.split("kResultFiles[] = {")[1].split("};")[0].splitlines()
             if line.startswith('    {"')]
    names.append(CRATE)
    assert len(names) > 15
    page = (ROOT / "docs/files.md").read_text().split("\n## Run folder\n")[1].split("\n## ")[0]
    missing = [name for name in names if f"`{name}`" not in page
               and not (name.endswith(".xdmf") and f"`{name[:-5]}.h5`" in page and "`.xdmf`" in page)]
    assert not missing

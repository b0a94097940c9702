"""Tables of a run as pandas has them: types, units, index; what is not there is told with what writes it."""
import subprocess
import sys
from pathlib import Path

import pandas
import pytest
from fake_runs import fake

import barchan

LINES = {
    "statistics.csv": "y,y_plus,U,U_plus,uu\n0.001,1.5,0.1,7,1e-4\n0.002,3,0.2,14,2e-4\n",
    "bedload.csv": "y,solid_fraction,bed_surface,load\n5e-05,0.6,3e-4,0.1\n1e-4,0.5,3e-4,0.1\n",
    "heaps.csv": "t,dune,heap,n_grains,volume\n0,-1,0,22,9e-11\n0,0,0,900,3.8e-9\n0.5,0,1,10,4e-11\n",
    "encounters.csv": "upstream,downstream,class,t_contact,new_dunes\n1,0,merging,0.24,\n0,2,exchange,nan,3 4\n",
    "obstacles.csv": "dune,obstacle,kind,class,t_contact\n0,007,body,bypass,1.5\n",
    "force_map.csv": "r_min,r_max,phi_min,phi_max,n,F_x,F_y,F_z,t_start,t_end\n0,5e-4,0,10,40,1e-9,0,0,1,2\n",
}


@pytest.fixture
def run(tmp_path):
    for name, text in LINES.items():
        (tmp_path / name).write_text(text)
    (tmp_path / "columns.json").write_text((fake() / "columns.json").read_text())
    (tmp_path / "config.toml").write_text("[case]\ntitle = \"made up\"\n")
    (tmp_path / "log.txt").write_text("step 1\n")
    for step in (1200, 8):
        (tmp_path / f"restart_{step:010}.h5").touch()
    (tmp_path / "restart_mine.h5").touch()
    return barchan.Run(tmp_path)


def test_tables_have_their_types_units_and_index(run):
    assert run.statistics.loc[0.002].U == 0.2 and run.statistics.attrs["units"]["uu"] == "m2 s-2"
    assert run.bed_load.loc[5e-05].bed_surface == 3e-4 and run.bed_load.attrs["units"]["load"] == "kg m-2"
    assert run.heaps.loc[(0, 1, 0.5)].n_grains == 10 and run.heaps.attrs["units"]["volume"] == "m3"
    met = run.encounters
    assert met["class"].tolist() == ["merging", "exchange"] and met.new_dunes.tolist() == ["", "3 4"]
    assert met.t_contact[0] == 0.24 and pandas.isna(met.t_contact[1]) and met.attrs["units"]["t_contact"] == "s"
    assert run.obstacles.obstacle[0] == "007"  # a name
    assert run.force_map.attrs["units"]["phi_min"] == "degree"


def test_restarts_come_in_order_of_their_steps(run):
    assert list(run.restarts) == [8, 1200] and run.restarts[8].name == "restart_0000000008.h5"
    assert run.log == "step 1\n"


@pytest.mark.parametrize(("name", "source"), [("statistics", "[statistics]"), ("encounters", "plot RUN encounters"),
                                              ("force_map", "statistics.grain_forces")])
def test_a_table_that_is_not_there_says_what_writes_it(tmp_path, name, source):
    (tmp_path / "config.toml").write_text("[case]\ntitle = \"made up\"\n")
    run = barchan.Run(tmp_path)
    with pytest.raises(barchan.MissingData, match=rf"needs {name}.csv: .*{source.replace('[', '.').replace(']', '.')}"):
        getattr(run, name)
    assert run.log == "" and run.restarts == {}


def test_a_broken_table_is_a_sentence(run):
    (run.path / "encounters.csv").write_text("")
    with pytest.raises(barchan.BarchanError, match="encounters.csv cannot be read"):
        _ = run.encounters


def test_completion_shows_what_is_for_users(run):
    assert {"dunes", "fields", "figure", "statistics", "restarts", "title"} <= set(dir(run))
    assert not {"need_grains", "dune_columns", "frame_file"} & set(dir(run))


def test_columns_of_these_tables_are_those_that_are_written():
    from barchan.dune import encounters, obstacles

    assert set(encounters.table([])) == set(encounters.ABOUT)
    assert set(obstacles.table([])) == set(obstacles.ABOUT)


def test_a_python_without_the_packages_says_a_sentence(tmp_path):
    package = str(Path(barchan.__file__).parents[1])
    code = f"import sys; sys.path.insert(0, {package!r}); import barchan"
    done = subprocess.run([sys.executable, "-S", "-c", code], capture_output=True, text=True, cwd=tmp_path)
    assert "has no numpy, h5py, matplotlib: use /usr/bin/python3" in done.stderr.splitlines()[-1]

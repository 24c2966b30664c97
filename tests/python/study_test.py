"""Studies: planned in Python, run once, read as columns."""
import json

import numpy
import pytest

import spall


def description(card):
    return {
        "name": "sweep",
        "card": card,
        "vary": {"T": ["2 MPa", "4 MPa"]},
        "specimen": [{"name": "prism", "size": "0.4x0.2x0.2 m", "elements": 1400, "seeds": [1]}],
        "test": [{"kind": "elastic"}, {"kind": "tension", "rate": 0.2, "stop_at": 0.9}],
    }


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    folder = tmp_path_factory.mktemp("study")
    heard = []
    table = spall.run_study(description(spall.example_card()), folder / "out", threads=1, progress=heard.append)
    return table, folder, heard


def test_the_plan_lists_its_tasks(card):
    plan = spall.plan_study(description(card))
    assert len(plan) == len(plan.tasks) == 4 and plan.parameters == ["T"] and plan.name == "sweep"
    assert {task["card.T"] for task in plan.tasks} == {2e6, 4e6}
    assert all(task["seconds"] > 0 and len(task["key"]) == 64 for task in plan.tasks)


def test_rows_are_the_commands(done, command, tmp_path):
    table, folder, _ = done
    spall.example_card().write(tmp_path / "card.toml")
    (tmp_path / "study.toml").write_text("""
name = "sweep"
card = "card.toml"
[vary]
T = ["2 MPa", "4 MPa"]
[[specimen]]
name = "prism"
size = "0.4x0.2x0.2 m"
elements = 1400
seeds = [1]
[[test]]
kind = "elastic"
[[test]]
kind = "tension"
rate = 0.2
stop_at = 0.9
""")
    command("study", tmp_path / "study.toml", "-o", folder / "out", "--threads", 1, "--quiet")  # finds all results
    told = json.loads((folder / "out" / "result.json").read_text())
    assert told["summary"] == table.summary and len(told["rows"]) == len(table)


def test_columns_are_numpy(done):
    table = done[0]
    pulled = table.columns(test="tension")
    assert pulled["card.T"].tolist() == [2e6, 4e6] and pulled["peak_stress"].dtype == numpy.float64
    assert pulled["peak_stress"][1] > 1.5 * pulled["peak_stress"][0]
    every = table.columns()
    assert len(set(map(len, every.values()))) == 1 and every["seed"].dtype.kind == "i"
    assert numpy.isnan(every["peak_stress"][every["test"] == "elastic"]).all()
    assert table.columns(test="none") == {}


def test_pandas_gets_the_rows_where_it_is_there(done):
    pandas = pytest.importorskip("pandas")
    assert isinstance(done[0].to_pandas(), pandas.DataFrame)


def test_the_same_call_computes_nothing_twice(done):
    table, folder, heard = done
    assert heard and heard[-1].stage == "study"
    plan = spall.plan_study(description(spall.example_card()))
    assert plan.status(folder / "out") == {"done": 4, "failed": 0, "running": 0, "missing": 0, "core_seconds_left": 0}
    before = {p: p.stat().st_mtime_ns for p in (folder / "out" / "tasks").iterdir()}
    again = spall.run_study(plan, folder / "out", threads=1)
    assert again.rows == table.rows and {p: p.stat().st_mtime_ns for p in before} == before


def test_some_tasks_by_their_numbers(card, tmp_path):
    table = spall.run_study(description(card), tmp_path / "out", tasks="2", threads=1)
    assert [row["task"] for row in table.rows] == [2]
    with pytest.raises(spall.InputError):
        spall.run_study(description(card), tmp_path / "out", tasks="9")


def test_a_failed_task_is_an_error_unless_it_is_allowed(card, tmp_path):
    bad = description(card)
    bad["specimen"][0]["size"], bad["test"] = "0.2x0.2x0.2 m", [{"kind": "spalling"}]  # too short a bar
    plan = spall.plan_study(bad)
    with pytest.raises(spall.RunError, match="of 2 tasks failed, first task 1"):
        spall.run_study(plan, tmp_path / "out", threads=1)
    table = spall.run_study(plan, tmp_path / "out", threads=1, allow_failures=True)
    assert len(table) == 0 and len(table.failed) == 2

"""Type stubs: they name what there is, with the arguments that it takes, and mypy finds no fault in the package."""
import ast
import importlib.util
import inspect
import os
import pathlib
import re
import subprocess
import sys

import pytest

import spall
from spall import _spall

STUB = pathlib.Path(spall.__file__).with_name("_spall.pyi")
ALWAYS = {"__doc__", "__module__", "__weakref__", "__dict__", "__init__", "__new__", "__repr__", "__str__", "__reduce__",
          "__reduce_ex__", "__class__", "__dir__"}


def declared():
    """{name: node} of the stub's classes and functions, and of the classes' members."""
    tree = ast.parse(STUB.read_text())
    names = {}
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            names[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            names[node.target.id] = node
        elif isinstance(node, ast.ClassDef):
            names[node.name] = node
            for member in node.body:
                if isinstance(member, ast.FunctionDef):
                    names.setdefault(f"{node.name}.{member.name}", member)
                elif isinstance(member, ast.AnnAssign):
                    names[f"{node.name}.{member.target.id}"] = member
    return names


def test_stub_and_module_have_the_same_names():
    there = {name for name in vars(_spall) if not name.startswith("_")} | {"__version__"}
    for name, value in vars(_spall).items():
        if inspect.isclass(value):
            there |= {f"{name}.{member}" for member in vars(value)
                      if member not in ALWAYS and not member.startswith("_pybind11")}
    written = {name for name in declared() if name.rpartition(".")[2] not in ALWAYS and not name.startswith("_Number")}
    assert written == there


def test_stub_and_module_take_the_same_arguments():
    for name, node in declared().items():
        if not isinstance(node, ast.FunctionDef) or node.decorator_list or node.name.startswith("__"):
            continue
        holder, _, member = name.rpartition(".")
        thing = getattr(getattr(_spall, holder) if holder else _spall, member)
        signature = re.match(rf"{member}\((.*)\) -> ", thing.__doc__)[1]
        taken = re.findall(r"(?:^|, )(\*{0,2}\w+)(?:: |$|, )", re.sub(r"\[[^\]]*\]+", "", signature))
        taken = [argument for argument in taken if argument != "self" and not argument.startswith("*")]
        given = [argument.arg for argument in node.args.args if argument.arg != "self"]
        assert given == taken, name


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
def test_mypy_finds_no_fault(tmp_path):
    user = tmp_path / "user.py"
    user.write_text("""
import spall
from typing import List

specimen = spall.make_specimen("0.4x0.2x0.2 m", 1400, seed=1)
card: spall.Card = spall.example_card().replace(T="3 MPa")
card.cohesion = "36 MPa"
strength: float = card.tensile_strength
result: spall.TestResult = spall.tension(specimen, card, rate=0.1, ends="free", progress=lambda p: print(p.stage))
peak: float = result.curve["stress"].max()
frames = spall.run_impact("case.toml", frame=lambda picture: print(picture["time"]))
rows: List[object] = list(spall.run_study("study.toml", "out").rows)
""")
    folder = pathlib.Path(spall.__file__).parent
    told = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, str(folder), str(user)],
                          capture_output=True, text=True, cwd=tmp_path)
    assert told.returncode == 0, told.stdout + told.stderr


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
def test_mypy_refuses_what_is_wrong(tmp_path):
    user = tmp_path / "user.py"
    user.write_text("import spall\nspall.tension(spall.read_specimen('a'), spall.example_card(), ends='loose')\n")
    told = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, str(user)],
                          capture_output=True, text=True, cwd=tmp_path)
    assert told.returncode == 1 and "ends" in told.stdout, told.stdout + told.stderr

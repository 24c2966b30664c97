"""The package: what it exports, documents and installs."""
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import spall


def test_every_public_name_is_there_and_documented():
    for name in spall.__all__:
        value = getattr(spall, name)
        if name != "__version__":
            assert inspect.getdoc(value), name
    assert set(spall.__all__) <= set(dir(spall))


def test_public_members_are_documented():
    for name in spall.__all__:
        value = getattr(spall, name)
        if not inspect.isclass(value) or issubclass(value, BaseException):
            continue
        for member, thing in vars(value).items():
            if member.startswith("_") or member in ("name", "title", "wall_seconds"):
                continue
            assert inspect.getdoc(thing), f"{name}.{member}"


def test_version_is_the_projects(source, command):
    project = re.search(r"project\(spall VERSION ([\d.]+)", (source / "CMakeLists.txt").read_text())[1]
    assert spall.__version__ == project and project in command("--version")


def test_pyproject_says_what_cmake_says(source):
    tomllib = pytest.importorskip("tomllib")
    described = tomllib.loads((source / "pyproject.toml").read_text())
    assert described["project"]["name"] == "spall"
    assert described["project"]["version"] == spall.__version__
    assert described["build-system"]["build-backend"] == "scikit_build_core.build"
    settings = described["tool"]["scikit-build"]
    assert settings["install"]["components"] == ["python"]
    cmake = (source / "CMakeLists.txt").read_text()
    for option in settings["cmake"]["define"]:
        assert f"option({option} " in cmake
    for target in settings["cmake"].get("targets", settings.get("build", {}).get("targets", [])):
        assert target in (source / "python" / "CMakeLists.txt").read_text()


def test_an_installed_package_works_without_the_build_folder(tmp_path):
    build = pathlib.Path(spall.__file__).parents[2]
    subprocess.run([shutil.which("cmake") or "cmake", "--install", build, "--prefix", tmp_path, "--component", "python"],
                   check=True, capture_output=True)
    (folder,) = tmp_path.glob("lib/python*/site-packages")
    names = sorted(path.name for path in (folder / "spall").iterdir())
    assert "py.typed" in names and "_spall.pyi" in names and "laboratory.py" in names
    told = subprocess.run(
        [sys.executable, "-c", "import spall; print(spall.__file__, spall.si('1 mm', 'length'))"], check=True,
        capture_output=True, text=True, cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(folder)}).stdout
    assert str(folder) in told and "0.001" in told

"""What the tests share: the source tree, the command, a specimen and a card. Small on purpose: all of it is seconds."""
import os
import pathlib
import subprocess

import pytest

import spall


@pytest.fixture(scope="session")
def source():
    return pathlib.Path(os.environ["SPALL_SOURCE"])


@pytest.fixture(scope="session")
def command():
    """Runs the spall command and gives what it wrote to standard output."""

    def run(*arguments):
        return subprocess.run([os.environ["SPALL_BINARY"], *map(str, arguments)], check=True, capture_output=True,
                              text=True).stdout

    return run


@pytest.fixture(scope="session")
def specimen():
    return spall.make_specimen("0.4x0.2x0.2 m", 1400, seed=1, threads=1)


@pytest.fixture
def card():
    return spall.example_card()

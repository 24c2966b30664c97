"""The field files that runs leave (VTKHDF), as numpy arrays."""
from __future__ import annotations

import json
import os
from typing import Any, Dict, Iterator, List

import numpy

from . import _spall
from ._errors import InputError
from ._run import Path

Array = "numpy.ndarray[Any, Any]"


class Grid:
    """An unstructured grid of points, cells and named data.

    points: (P, 3) [m]. connectivity, offsets: cell k has the points connectivity[offsets[k]:offsets[k + 1]].
    types: (C,) VTK's numbers of the cells. point_data, cell_data: dicts of (P,) or (P, 3), (C,) or (C, 3), SI units.
    """

    def __init__(self, datasets: "Dict[str, numpy.ndarray[Any, Any]]") -> None:
        self.points = datasets["VTKHDF/Points"]
        self.connectivity = datasets["VTKHDF/Connectivity"]
        self.offsets = datasets["VTKHDF/Offsets"]
        self.types = datasets["VTKHDF/Types"]
        self.point_data = self._named(datasets, "VTKHDF/PointData/")
        self.cell_data = self._named(datasets, "VTKHDF/CellData/")

    @staticmethod
    def _named(
        datasets: "Dict[str, numpy.ndarray[Any, Any]]", prefix: str
    ) -> "Dict[str, numpy.ndarray[Any, Any]]":
        return {name[len(prefix):]: values for name, values in datasets.items() if name.startswith(prefix)}

    def __repr__(self) -> str:
        return (f"<spall.Grid: {len(self.points)} points ({', '.join(self.point_data)}), {len(self.types)} cells "
                f"({', '.join(self.cell_data)})>")


def read_fields(file: Path) -> Grid:
    """A VTKHDF file that Spall wrote: fields.h5 and links.h5 of a test, a frame of an impact. Raises InputError."""
    datasets = _spall.read_hdf5(os.fspath(file))
    if "VTKHDF/Points" not in datasets:
        raise InputError(f"{os.fspath(file)}: holds no fields; give a VTKHDF file, as fields.h5", os.fspath(file),
                         "holds no fields", "give a VTKHDF file, as fields.h5")
    return Grid(datasets)


class Frames:
    """The pictures of one kind that an impact left: frames[k] reads the k-th; times [s] of all. Files are read when asked for."""

    def __init__(self, folder: Path, kind: str = "elements") -> None:
        self.folder = os.fspath(folder)
        self.kind = kind
        index = os.path.join(self.folder, kind + ".hdf.series")
        try:
            with open(index, encoding="utf-8") as text:
                listed = json.load(text)["files"]
        except FileNotFoundError:
            raise InputError(f"{index}: no such file; give the folder frames of an impact, and a kind that it has",
                             index, "no such file", "give the folder frames of an impact, and a kind that it has") from None
        self.files: List[str] = [os.path.join(self.folder, entry["name"]) for entry in listed]
        self.times = numpy.array([float(entry["time"]) for entry in listed])

    def __len__(self) -> int:
        return len(self.files)

    def __getitem__(self, number: int) -> Grid:
        return read_fields(self.files[number])

    def __iter__(self) -> Iterator[Grid]:
        return (read_fields(file) for file in self.files)

    def __repr__(self) -> str:
        return f"<spall.Frames: {len(self)} of {self.kind} in {self.folder}>"


def read_frames(folder: Path, kind: str = "elements") -> Frames:
    """The pictures in the folder `frames` of an impact. kind: elements, links, finite_elements or impactor.

    elements: points with radius, damage, displacement, velocity, fragment. links: cells with state and strain.
    Raises InputError.
    """
    return Frames(folder, kind)

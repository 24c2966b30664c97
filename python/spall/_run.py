"""Specimens made, tests run, cards fitted, impacts, studies: the compiled module's long calls with their options."""
from __future__ import annotations

import contextlib
import os
import re
import tempfile
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy

from . import _spall
from ._errors import InputError, RunError
from ._progress import ProgressOption, following
from ._spall import Calibration, Card, Case, Impact, Plan, Scene, Specimen, TestResult
from ._toml import Description

Path = Union[str, "os.PathLike[str]"]
Lengths = Union[str, Sequence[Union[str, float]], "numpy.ndarray[Any, Any]"]


def make_specimen(
    size: Lengths,
    elements: int,
    *,
    seed: int = 1,
    shape: str = "box",
    grading: str = "uniform",
    size_ratio: float = 2.0,
    solid_fraction: float = 0.42,
    threads: Optional[int] = None,
    progress: ProgressOption = None,
) -> Specimen:
    """Pack elements into a shape and link them (mean interior coordination 12).

    size: sides of a box, as "0.5x0.25x0.25 m" or three numbers in m; diameter and length of a cylinder.
    elements: how many. seed: of the disorder; the same seed gives the same specimen, on any number of threads.
    shape: "box", or "cylinder" with its axis along z. grading: of the radii: "uniform", "lognormal", "equal".
    size_ratio: largest over smallest radius. solid_fraction: volume of the elements over that of the specimen.

    Raises InputError (bounds; too few elements to stand for the material), RunError, KeyboardInterrupt.
    """
    with following(progress) as call:
        return _spall.make_specimen(size, elements, seed, shape, grading, size_ratio, solid_fraction, threads or 0, call)


def run_test(
    name: str,
    specimen: Specimen,
    card: Card,
    *,
    threads: Optional[int] = None,
    progress: ProgressOption = None,
    checkpoint: Optional[Path] = None,
    resume: bool = False,
    **options: Any,
) -> TestResult:
    """Run the virtual test of that name; spall.tension(...) and the others of spall.laboratory are the same by name.

    options: those of the test (spall.catalogue() lists them, help(spall.tension) explains them), quantities as text
    with a unit or as numbers in SI units; None is as if left out.
    checkpoint: file that keeps the state every minute and when the test is stopped; removed when it is over.
    resume: go on from the checkpoint, if it is there, with the same bits.

    Raises InputError, RunError (it diverged), KeyboardInterrupt.
    """
    with following(progress) as call:
        return _spall.run_test(name, specimen, card, options, threads or 0, call, checkpoint, resume)


@contextlib.contextmanager
def _described(source: Any, folder: Optional[Path], name: str) -> Iterator[Tuple[Optional[Path], str, str]]:
    """(file, text, name) for the compiled readers, of a path or of a dict; its errors name no line of a dict."""
    if not isinstance(source, Mapping):
        if folder is not None:
            raise InputError("folder: stands beside a file; paths in a file are relative to its own folder", "folder",
                             "stands beside a file", "paths in a file are relative to its own folder")
        yield source, "", ""
        return
    description = Description(source)
    if not description.text.strip():
        raise InputError(f"{name}: the dict is empty", name, "the dict is empty", "")
    where = os.path.join(os.fspath(folder), name) if folder is not None else name
    try:
        yield None, description.text, where
    except InputError as error:
        shown = re.compile(re.escape(where) + r":\d+")
        raise InputError(shown.sub(name, error.message), shown.sub(name, error.where), shown.sub(name, error.what),
                         error.allowed) from None


def read_case(case: Union[Path, Mapping[str, Any]], *, folder: Optional[Path] = None) -> Case:
    """Read and check a calibration case: a case.toml, or a dict with the same keys (docs/cases.md).

    folder: what paths in a dict are relative to (default: the working folder). In a dict a Card or a Specimen may
    stand for a file of one. Raises InputError.
    """
    with _described(case, folder, "case") as (file, text, name):
        return _spall.read_case(file, text, name)


def calibrate(
    case: Union[Path, Mapping[str, Any], Case],
    *,
    folder: Optional[Path] = None,
    journal: Optional[Path] = None,
    resume: bool = False,
    threads: Optional[int] = None,
    progress: ProgressOption = None,
) -> Calibration:
    """Fit a material card to the targets and curves of a case: a file, a dict, or what read_case gave.

    journal: file that keeps every virtual test that is finished. resume: take those that are there, and come to the
    same bits. Tests on several specimens run side by side on `threads`.

    A fit that ends without meeting its targets raises nothing: look at Calibration.complete, targets and warnings.
    Raises InputError, RunError, KeyboardInterrupt (the journal then has all that was finished).
    """
    read = case if isinstance(case, Case) else read_case(case, folder=folder)
    with following(progress) as call:
        return _spall.calibrate(read, os.fspath(journal) if journal is not None else "", resume, threads or 0, call)


def read_scene(
    scene: Union[Path, Mapping[str, Any]], *, card: Union[None, Card, Path] = None, folder: Optional[Path] = None
) -> Scene:
    """Read and check an impact: a case file, or a dict with the same keys (docs/cases.md, impact cases).

    card: stands in for the card that the case names. folder: what paths in a dict are relative to. Raises InputError.
    """
    with tempfile.TemporaryDirectory(prefix="spall-") as scratch, _described(scene, folder, "scene") as described:
        file, text, name = described
        if isinstance(card, Card):
            kept = os.path.join(scratch, "card.toml")
            card.write(kept)
            return _spall.read_scene(file, text, name, kept)
        return _spall.read_scene(file, text, name, card)


def run_impact(
    scene: Union[Path, Mapping[str, Any], Scene],
    *,
    card: Union[None, Card, Path] = None,
    folder: Optional[Path] = None,
    threads: Optional[int] = None,
    progress: ProgressOption = None,
    frame: Optional[Callable[[Dict[str, Any]], Any]] = None,
    frames: Optional[Path] = None,
    checkpoint: Optional[Path] = None,
    resume: bool = False,
) -> Impact:
    """Let an impactor strike a structure: a case file, a dict, or what read_scene gave.

    frame: called with each picture of the state (Scene.frames + 1 of them), a dict of arrays of their own: number,
    time [s], position, displacement, velocity (N, 3) [m, m, m/s], radius, damage (N,), links (L, 2), link_state (L,)
    (0 whole, 1 softening, 2 broken), impactor_position [m]; of the coupled model also node_position and
    node_displacement (n, 3) [m]. The run waits for it.
    frames: folder for the same pictures as VTKHDF files, which ParaView opens and read_frames reads.
    checkpoint, resume: file that keeps the state every two minutes and when the run is stopped; go on from it.

    Raises InputError, RunError (it diverged), KeyboardInterrupt.
    """
    if isinstance(scene, Scene):
        if card is not None:
            raise InputError("card: stands beside a scene that was read; give it to read_scene", "card",
                             "stands beside a scene that was read", "give it to read_scene")
        read = scene
    else:
        read = read_scene(scene, card=card, folder=folder)
    with following(progress) as call:
        return _spall.run_impact(read, threads or 0, call, frame, frames, checkpoint, resume)


class StudyTable:
    """The finished rows of a study.

    rows: list of dicts, one a specimen, setting and test: task, specimen, seed, size_x [m], ..., elements, card,
    card.KEY of what varies (SI), test, kind, and what the test measured.
    failed: list of (task, message). result: dict with the keys of the command line's result.json (summary, ...).
    """

    def __init__(self, rows: List[Dict[str, Any]], failed: List[Tuple[int, str]], result: Dict[str, Any]) -> None:
        self.rows = rows
        self.failed = failed
        self.result = result

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        return f"<spall.StudyTable: {len(self.rows)} rows, {len(self.failed)} failed>"

    @property
    def summary(self) -> Dict[str, Any]:
        """By quantity: mean, std, min, max, spread_rel."""
        return dict(self.result["summary"])

    def columns(self, **where: Any) -> "Dict[str, numpy.ndarray[Any, Any]]":
        """The rows as numpy columns of one length; columns(test="tension") takes the rows that have these values.

        Numbers become float64 or int64, with NaN where a row has none; text becomes str.
        """
        rows = [row for row in self.rows if all(row.get(key) == value for key, value in where.items())]
        names: List[str] = []
        for row in rows:
            names.extend(key for key in row if key not in names)
        columns = {}
        for name in names:
            values = [row.get(name) for row in rows]
            if any(isinstance(value, str) for value in values):
                columns[name] = numpy.array(["" if value is None else str(value) for value in values])
            elif any(value is None for value in values):
                columns[name] = numpy.array([numpy.nan if value is None else float(value) for value in values])
            else:
                columns[name] = numpy.array(values)
        return columns

    def to_pandas(self) -> Any:
        """The rows as a pandas DataFrame (pandas must be installed)."""
        import pandas  # type: ignore[import]

        return pandas.DataFrame(self.rows)


def plan_study(study: Union[Path, Mapping[str, Any]], *, folder: Optional[Path] = None) -> Plan:
    """Read a study and expand it into its tasks: a study.toml, or a dict with the same keys (docs/studies.md).

    In a dict a Card or a Specimen may stand for a file of one. folder: what paths in a dict are relative to.
    Raises InputError.
    """
    with _described(study, folder, "study") as (file, text, name):
        return _spall.plan_study(file, text, name)


def run_study(
    study: Union[Path, Mapping[str, Any], Plan],
    output: Path,
    *,
    folder: Optional[Path] = None,
    tasks: str = "",
    threads: Optional[int] = None,
    memory: float = 0.0,
    retry_failed: bool = False,
    allow_failures: bool = False,
    progress: ProgressOption = None,
) -> StudyTable:
    """Run the tasks of a study that have no result in the folder `output` yet, side by side, and read all rows.

    tasks: some of them by their numbers, as "1-10,12". memory: for all at a time [bytes]; 0: nine tenths of what is
    available. retry_failed: run those again that failed before. A run that was stopped goes on with the same call.

    Raises InputError, RunError (tasks failed, unless allow_failures), KeyboardInterrupt.
    """
    plan = study if isinstance(study, Plan) else plan_study(study, folder=folder)
    with following(progress) as call:
        _spall.run_study(plan, os.fspath(output), tasks, threads or 0, memory, retry_failed, call)
    table = read_study(plan, output)
    if table.failed and not allow_failures:
        number, message = table.failed[0]
        raise RunError(f"{len(table.failed)} of {len(plan)} tasks failed, first task {number}: {message}; "
                       "retry_failed=True runs them again, allow_failures=True takes the others")
    return table


def read_study(
    study: Union[Path, Mapping[str, Any], Plan], output: Path, *, folder: Optional[Path] = None
) -> StudyTable:
    """The rows of a study whose results are in the folder `output`. Raises InputError."""
    plan = study if isinstance(study, Plan) else plan_study(study, folder=folder)
    return StudyTable(*_spall.read_study(plan, os.fspath(output)))

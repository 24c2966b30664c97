"""Spall: calibration and virtual testing of concrete modelled by discrete elements.

    import spall
    specimen = spall.make_specimen("0.4x0.2x0.2 m", 1400, seed=1)
    card = spall.example_card()
    result = spall.tension(specimen, card, rate=0.1, progress=True)
    result.peak_stress, result.curve["stress"], result.fields["damage"]

Units are SI inside; a quantity may be given as text with its unit ("24 GPa", "6 degree"). Arrays are numpy; those
that come from a specimen or a result are read-only views without a copy. Long calls let other threads run, take
progress=True or a callable, and stop cleanly on an interrupt. The guide is docs/python.md.
"""
from . import laboratory
from ._errors import InputError, RunError
from ._fields import Frames, Grid, read_fields, read_frames
from ._progress import Bar
from ._run import (
    StudyTable,
    calibrate,
    make_specimen,
    plan_study,
    read_case,
    read_scene,
    read_study,
    run_impact,
    run_study,
    run_test,
)
from ._spall import (
    Calibration,
    Card,
    Case,
    Impact,
    Plan,
    Progress,
    Scene,
    Specimen,
    TestResult,
    __version__,
    catalogue,
    example_card,
    read_card,
    read_hdf5,
    read_specimen,
    si,
    specimen_from_arrays,
    stop_runs,
)
from .laboratory import *  # noqa: F401,F403

__all__ = [
    "Bar", "Calibration", "Card", "Case", "Frames", "Grid", "Impact", "InputError", "Plan", "Progress", "RunError",
    "Scene", "Specimen", "StudyTable", "TestResult", "__version__", "calibrate", "catalogue", "example_card",
    "laboratory", "make_specimen", "plan_study", "read_card", "read_case", "read_fields", "read_frames", "read_hdf5",
    "read_scene", "read_specimen", "read_study", "run_impact", "run_study", "run_test", "si", "specimen_from_arrays",
    "stop_runs",
]
__all__ += laboratory.__all__

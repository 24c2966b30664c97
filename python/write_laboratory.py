"""Writes spall/laboratory.py: a function for each virtual test, its options as keyword arguments.

    write_laboratory.py FOLDER_OF_THE_COMPILED_MODULE FILE_TO_WRITE

The catalogue of tests is the one place that says what there is; this makes Python see it, with signatures,
docstrings and types.
"""
import importlib.util
import pathlib
import sys
import textwrap

HEAD = '''"""The virtual laboratory: one function a test.

Written from the catalogue of tests by python/write_laboratory.py when the module is built; change the catalogue, not
this file.
"""
from __future__ import annotations

from typing import Literal, Optional, Union

from ._progress import ProgressOption
from ._run import Path, run_test
from ._spall import Card, Specimen, TestResult

__all__ = [{names}]

Quantity = Union[str, float]
'''

COMMON = [
    ("threads", "Optional[int]", "Threads of the computation (default: as many as OpenMP gives). The bits do not depend on it."),
    ("progress", "ProgressOption", "True: a bar; or a callable that takes a spall.Progress."),
]
OF_STEPS = [
    ("checkpoint", "Optional[Path]", "File that keeps the state every minute and when the test is stopped; removed at the end."),
    ("resume", "bool", "Go on from the checkpoint, if it is there."),
]


def type_of(option):
    kind = option["kind"]
    if kind == "flag":
        return "Optional[bool]"
    if kind == "choice":
        return "Optional[Literal[{}]]".format(", ".join(f'"{choice}"' for choice in option["choices"]))
    return "Optional[Quantity]" if kind == "quantity" else "Optional[float]"


def words_of(option):
    help_text = option["help"].rstrip(".")
    if option["kind"] == "quantity":
        unit = option["unit"]
        how = f'as "{option["example"]}"' + ("" if unit == "-" else f", or a number in {unit}")
        return f"{help_text}, {how} (default: {option['default']})."
    if option["kind"] == "choice":
        return f"{help_text}: {', '.join(option['choices'])} (default: {option['default']})."
    return f"{help_text} (default: {option['default']})."


def entry(name, text):
    wrapped = textwrap.fill(text, width=104, initial_indent=" " * 8, subsequent_indent=" " * 8)
    return f"    {name}:\n{wrapped}\n"


def function_of(test):
    name = test["name"]
    common = COMMON + (OF_STEPS if test["steps"] else [])
    lines = [f"def {name}(", "    specimen: Specimen,", "    card: Card,", "    *,"]
    for option in test["options"]:
        lines.append(f"    {option['key']}: {type_of(option)} = None,")
    for key, kind, _ in common:
        lines.append(f"    {key}: {kind} = {'False' if kind == 'bool' else 'None'},")
    lines.append(") -> TestResult:")
    doc = test["summary"].rstrip(".") + ".\n\n    Options (left out or None: the default):\n\n"
    for option in test["options"]:
        doc += entry(option["key"], words_of(option))
    for key, _, words in common:
        doc += entry(key, words)
    measured = ", ".join(f"{m['key']} ({m['words']}, {m['unit']})" for m in test["measured"])
    doc += "\n" + textwrap.fill(f"Measures {measured}.", 104, initial_indent="    ", subsequent_indent="    ") + "\n"
    doc += "\n" + textwrap.fill(
        "Raises InputError (an option out of bounds, a specimen that the test cannot be done on), RunError (it diverged, "
        "a file could not be written), KeyboardInterrupt.", 104, initial_indent="    ", subsequent_indent="    ") + "\n"
    lines.append(f'    """{doc}    """')
    options = ", ".join(f"{o['key']}={o['key']}" for o in test["options"])
    rest = ", ".join(f"{key}={key}" for key, _, _ in common)
    call = f'    return run_test("{name}", specimen, card, {rest}, {options})'
    lines.append(call)
    return "\n".join(lines) + "\n"


def main(folder, file):
    found = sorted(pathlib.Path(folder).glob("_spall*.so"))
    if not found:
        sys.exit(f"{folder}: there is no compiled module _spall")
    spec = importlib.util.spec_from_file_location("_spall", found[0])
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    tests = module.catalogue()
    text = HEAD.format(names=", ".join(f'"{test["name"]}"' for test in tests))
    for test in tests:
        text += "\n\n" + function_of(test)
    pathlib.Path(file).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])

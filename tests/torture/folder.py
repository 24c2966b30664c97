"""What must hold of a run's folder: whole files after any stop, and the undisturbed run's bits at the end."""
import csv
import json
import os
import re
import struct
import subprocess

LEFT_OVER = re.compile(r"^\.(.*\.\d+\.part|spall-probe\.\d+|probe-\d+)$")
# What a clock says, and the command that was typed, differ from run to run.
CLOCK = {"wall_seconds", "step_loop_seconds", "overlap_solve_seconds", "checkpoint_seconds", "start", "end",
         "command_line", "seconds", "threads"}


def files_in(folder):
    found = {}
    for where, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(where, name)
            found[os.path.relpath(path, folder)] = path
    return found


def stamps(folder):
    """What tells whether anything was written."""
    return {name: os.stat(path).st_mtime_ns for name, path in files_in(folder).items()}


def age(folder):
    """Makes a finished folder's files old, so that newer ones show."""
    for path in files_in(folder).values():
        os.utime(path, (1, 1))


def fault_of_rerun(folder):
    """After a stopped run over an aged folder: the earlier result beside anything newer; None if there is none."""
    result = os.path.join(folder, "result.json")
    if not os.path.exists(result) or os.stat(result).st_mtime > 1:
        return None
    newer = [name for name, path in sorted(files_in(folder).items())
             if os.stat(path).st_mtime > 1 and not LEFT_OVER.match(os.path.basename(name))]
    return f"result.json of the earlier run beside newer {newer}" if newer else None


def left_overs(folder):
    return sorted(name for name in files_in(folder) if LEFT_OVER.match(os.path.basename(name)))


def hdf5_fault(path):
    """The end of the file, as its first block says, against its size."""
    data = open(path, "rb").read(64)
    if data[:8] != b"\x89HDF\r\n\x1a\n":
        return "is no HDF5 file"
    end = struct.unpack_from("<Q", data, 40 if data[8] < 2 else 28)[0]
    return None if end == os.path.getsize(path) else f"is truncated: {os.path.getsize(path)} bytes, not {end}"


def fault_of(path, spall):
    """What is wrong with a file, in words; None if nothing is."""
    name = os.path.basename(path)
    try:
        if name.endswith((".json", ".series", ".failed")):
            json.load(open(path))
        elif name.endswith(".csv"):
            text = open(path).read()
            if not text.endswith("\n"):
                return "does not end with a line's end"
            widths = {len(row) for row in csv.reader(text.splitlines())}
            if len(widths) != 1:
                return f"has rows of {sorted(widths)} columns"
        elif name.endswith(".toml"):
            found = subprocess.run([spall, "card", "check", path, "--quiet"], capture_output=True, text=True)
            if found.returncode != 0:
                return found.stderr.strip()
        elif name.endswith((".h5", ".hdf")):
            return hdf5_fault(path)
        elif name.endswith(".html"):
            if not open(path).read().rstrip().endswith("</html>"):
                return "ends before </html>"
    except (ValueError, UnicodeDecodeError) as error:
        return str(error)
    return None


def faults(folder, spall):
    """One line for each file that is not whole. A process that was killed may leave what it was writing aside."""
    found = []
    for name, path in sorted(files_in(folder).items()):
        if LEFT_OVER.match(os.path.basename(name)):
            continue
        fault = fault_of(path, spall)
        if fault:
            found.append(f"{name} {fault}")
    return found


def without_clock(value):
    if isinstance(value, dict):
        return {key: without_clock(held) for key, held in value.items() if key not in CLOCK}
    if isinstance(value, list):
        return [without_clock(held) for held in value]
    return value


def is_compared(name):
    # run.json tells when and how; the page shows times; a fit's journal and a study's times and specimens are no results.
    return not (name in ("run.json", "report.html", "checkpoint.h5", ".claims") or name.startswith(("times/", "checkpoints/")))


def differences(folder, reference):
    """One line for each file that is not as the undisturbed run left it."""
    here = {name: path for name, path in files_in(folder).items() if is_compared(name)}
    there = {name: path for name, path in files_in(reference).items() if is_compared(name)}
    found = [f"{name} is not there" for name in sorted(set(there) - set(here))]
    found += [f"{name} is too many" for name in sorted(set(here) - set(there))]
    for name in sorted(set(here) & set(there)):
        a, b = open(here[name], "rb").read(), open(there[name], "rb").read()
        same = a == b
        if not same and name.endswith("result.json"):
            same = without_clock(json.loads(a)) == without_clock(json.loads(b))
        if not same:
            found.append(f"{name} differs")
    return found

"""Long calls: progress, interrupts, threads. A run stops within a second of the signal and leaves nothing half written."""
import concurrent.futures
import io
import pathlib
import signal
import subprocess
import sys
import threading
import time

import pytest

import spall

LONG = {"rate": 1e-4, "threads": 1}  # minutes


def interrupted(body, ready, tmp_path, after=0.3):
    """Runs a script that prints "ready" once a run is under way, sends SIGINT, and gives (exit status, stderr, seconds)."""
    script = "import sys, pathlib, signal, spall\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n" + body
    child = subprocess.Popen([sys.executable, "-c", script], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                             text=True)
    try:
        assert child.stdout.readline().strip() == ready
        time.sleep(after)
        sent = time.monotonic()
        child.send_signal(signal.SIGINT)
        _, error = child.communicate(timeout=30)
        return child.returncode, error, time.monotonic() - sent
    finally:
        child.kill()


def files_in(folder):
    return sorted(str(p.relative_to(folder)) for p in pathlib.Path(folder).rglob("*") if p.is_file())


TELL = """
told = []
def tell(progress):
    if not told and progress.done > 0:
        told.append(1); print("ready", flush=True)
"""


def test_an_interrupt_stops_a_test_and_keeps_its_state(specimen, card, tmp_path):
    specimen.write(tmp_path / "s.h5")
    body = TELL + """
try:
    spall.tension(spall.read_specimen("s.h5"), spall.example_card(), rate=1e-4, threads=1, checkpoint="state.h5", progress=tell)
except KeyboardInterrupt as stop:
    print("\\n".join(getattr(stop, "__notes__", [])), file=sys.stderr)
    sys.exit(17)
"""
    status, error, seconds = interrupted(body, "ready", tmp_path)
    assert status == 17 and seconds < 2, (status, error, seconds)
    assert "stopped by a signal" in error or sys.version_info < (3, 11)
    assert files_in(tmp_path) == ["s.h5", "state.h5"]
    spall.read_hdf5(tmp_path / "state.h5")  # whole
    # It goes on from there: the first thing heard is not the start.
    heard = []

    def stop_soon(progress):
        heard.append(progress.done)
        raise StopIteration

    with pytest.raises(StopIteration):
        spall.tension(specimen, card, rate=1e-4, threads=1, checkpoint=tmp_path / "state.h5", resume=True,
                      progress=stop_soon)
    assert heard[0] > 0


def test_an_interrupt_stops_a_script_with_the_usual_traceback(specimen, tmp_path):
    specimen.write(tmp_path / "s.h5")
    body = TELL + 'spall.compression(spall.read_specimen("s.h5"), spall.example_card(), rate=1e-4, threads=1, progress=tell)\n'
    status, error, seconds = interrupted(body, "ready", tmp_path)
    assert status == -signal.SIGINT and "KeyboardInterrupt" in error and seconds < 2, (status, error, seconds)
    assert files_in(tmp_path) == ["s.h5"]


def test_an_interrupt_stops_a_calibration_and_the_journal_is_whole(tmp_path):
    body = """
case = {"targets": {"E": "30 GPa", "ft": "3 MPa"}, "fixed": {"zeta": 5, "Co": "8 MPa"},
        "specimen": {"size": "0.4x0.2x0.2 m", "elements": 1400, "fit_seeds": [1], "check_seeds": []}}
def tell(progress):
    if progress.stage == "tension": print("ready", flush=True)
spall.calibrate(case, threads=1, journal="journal.h5", progress=tell)
"""
    status, error, seconds = interrupted(body, "ready", tmp_path, after=0.1)
    assert status == -signal.SIGINT and seconds < 2, (status, error, seconds)
    assert files_in(tmp_path) == ["journal.h5"]
    spall.read_hdf5(tmp_path / "journal.h5")


def test_an_interrupt_stops_packing(tmp_path):
    body = TELL + 'spall.make_specimen("0.6x0.6x0.6 m", 80000, threads=1, progress=tell).write("s.h5")\n'
    status, _, seconds = interrupted(body, "ready", tmp_path)
    assert status == -signal.SIGINT and seconds < 4 and files_in(tmp_path) == []


def test_progress_is_told_and_goes_forward(specimen, card):
    heard, thread = [], threading.get_ident()

    def hear(progress):
        assert threading.get_ident() == thread
        heard.append((progress.stage, progress.done, progress.total, progress.unit))
        assert repr(progress).startswith(f"Progress(stage='{progress.stage}', done=")

    spall.tension(specimen, card, threads=1, rate=0.03, stop_at=0.9, progress=hear)
    assert len(heard) > 2
    for before, now in zip(heard, heard[1:]):
        assert now[0] != before[0] or now[1] >= before[1]
    assert all(0 <= done and unit for _, done, _, unit in heard)


def test_what_a_progress_callback_raises_comes_through(specimen, card):
    class Enough(Exception):
        pass

    def enough(progress):
        raise Enough(progress.stage)

    start = time.monotonic()
    with pytest.raises(Enough):
        spall.tension(specimen, card, progress=enough, **LONG)
    assert time.monotonic() - start < 5
    # Nothing of the stop is left behind: the next run is not stopped.
    assert spall.elastic(specimen, card, threads=1).E > 0


def test_progress_must_be_callable(specimen, card):
    with pytest.raises(TypeError, match="progress must be"):
        spall.tension(specimen, card, progress=3)


def test_a_bar_shows_on_a_terminal_and_goes_away():
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    class At:
        stage, total, unit, detail = "tension", 100.0, "steps", "0.5 MPa"

        def __init__(self, done):
            self.done = done

    terminal = Terminal()
    bar = spall.Bar(terminal)
    for done in (0.0, 50.0, 100.0):
        bar(At(done))
    shown = terminal.getvalue()
    assert "\r" in shown and "100% 100/100 steps" in shown and "0.5 MPa" in shown and "\n" not in shown
    bar.close()
    assert terminal.getvalue().endswith("\r\033[K")
    plain = io.StringIO()
    bar = spall.Bar(plain)
    bar(At(0.0)), bar(At(1.0))
    assert plain.getvalue().count("\n") == 1  # a log gets a line now and then


def test_a_notebook_gets_one_output_that_is_rewritten(monkeypatch):
    shown = []

    class Handle:
        def update(self, content, raw):
            shown.append(content["text/plain"])

    def display(content, raw, display_id):
        shown.append(content["text/plain"])
        return Handle()

    class Shell:
        kernel = object()

    ipython, part = type(sys)("IPython"), type(sys)("IPython.display")
    ipython.get_ipython, part.display = Shell, display
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    monkeypatch.setitem(sys.modules, "IPython.display", part)
    bar = spall.Bar()

    class At:
        stage, done, total, unit, detail = "packing", 1.0, 2.0, "sweeps", ""

    bar(At), setattr(At, "done", 2.0), bar(At), bar.close()
    assert len(shown) == 2 and "100%" in shown[1]


def test_two_threads_run_tests_at_the_same_time_with_the_same_bits(specimen, card):
    alone = spall.tension(specimen, card, threads=1, rate=0.1, stop_at=0.9).state_sha256
    beside = {}

    def hear(name):
        def call(progress):
            beside.setdefault(name, []).append(time.monotonic())

        return call

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = [pool.submit(spall.tension, specimen, card, threads=1, rate=0.1, stop_at=0.9, progress=hear(k))
                for k in range(2)]
        found = [run.result() for run in runs]
    assert [one.state_sha256 for one in found] == [alone, alone]
    assert max(times[0] for times in beside.values()) < min(times[-1] for times in beside.values())


def test_other_threads_run_python_during_a_run(specimen, card):
    counted, over = [0], threading.Event()

    def count():
        while not over.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    spall.tension(specimen, card, threads=1, rate=0.1, stop_at=0.9)
    grown = counted[0] - before
    over.set()
    thread.join()
    assert grown > 20


def test_a_stop_of_one_run_leaves_others_alone(specimen, card):
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        other = pool.submit(spall.tension, specimen, card, threads=1, rate=0.1, stop_at=0.9)

        def enough(progress):
            raise ZeroDivisionError

        with pytest.raises(ZeroDivisionError):
            spall.tension(specimen, card, progress=enough, **LONG)
        assert other.result().steps > 0


def test_stop_runs_stops_them_all(specimen, card):
    started = threading.Event()
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        run = pool.submit(spall.tension, specimen, card, progress=lambda progress: started.set(), **LONG)
        assert started.wait(30)
        assert spall.stop_runs() == 1
        with pytest.raises(KeyboardInterrupt):
            run.result(timeout=10)
    assert spall.stop_runs() == 0

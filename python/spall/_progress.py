"""Progress of long calls: a bar on a terminal or in a notebook, or whatever a callable makes of it."""
from __future__ import annotations

import shutil
import sys
import time
from typing import Any, Callable, Optional, TextIO, Union

from ._spall import Progress

ProgressOption = Union[None, bool, Callable[[Progress], Any]]


def _duration(seconds: float) -> str:
    whole = round(seconds)
    if whole >= 3600:
        return f"{whole // 3600} h {whole % 3600 // 60} min"
    if whole >= 60:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole} s"


def _in_notebook() -> bool:
    """Whether an IPython kernel shows the output: a notebook, not a terminal."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None and hasattr(ipython, "get_ipython") else None
    return shell is not None and getattr(shell, "kernel", None) is not None


class Bar:
    """Shows progress: rewrites one line of a terminal, updates one output of a notebook, or prints a line now and then."""

    def __init__(self, stream: Optional[TextIO] = None) -> None:
        self._stream = stream or sys.stderr
        self._terminal = self._stream.isatty()
        self._handle: Any = None
        self._notebook = stream is None and _in_notebook()
        self._stage: Optional[str] = None
        self._start = 0.0
        self._done_at_start = 0.0
        self._shown = float("-inf")
        self._line_open = False

    def line(self, progress: Progress, rate: float, width: int) -> str:
        """One line of text for where things stand."""
        if progress.total > 0:
            part = min(max(progress.done / progress.total, 0.0), 1.0)
            filled = round(20 * part)
            text = (f"{progress.stage} [{'=' * filled}{' ' * (20 - filled)}] {int(100 * part):3d}% "
                    f"{progress.done:.6g}/{progress.total:.6g} {progress.unit}")
        else:
            text = f"{progress.stage} {progress.done:.6g} {progress.unit}"
        if rate > 0:
            text += f", {rate:.3g}/s"
            if progress.total > progress.done:
                text += f", {_duration((progress.total - progress.done) / rate)} left"
        if progress.detail:
            text += f", {progress.detail}"
        return text[:width]

    def __call__(self, progress: Progress) -> None:
        now = time.monotonic()
        new_stage = progress.stage != self._stage or progress.done < self._done_at_start
        if new_stage:
            self._stage, self._start, self._done_at_start = progress.stage, now, progress.done
        often = self._terminal or self._notebook
        finished = progress.total > 0 and progress.done >= progress.total
        if now - self._shown < (0.1 if often else 5.0) and not (often and (new_stage or finished)):
            return
        self._shown = now
        elapsed = now - self._start
        rate = (progress.done - self._done_at_start) / elapsed if elapsed > 0 else 0.0
        if self._notebook:
            self._show_in_notebook(self.line(progress, rate, 200))
        elif self._terminal:
            width = max(shutil.get_terminal_size().columns - 1, 20)
            self._stream.write("\r\033[K" + self.line(progress, rate, width))
            self._line_open = True
        else:
            self._stream.write(self.line(progress, rate, 200) + "\n")
        self._stream.flush()

    def _show_in_notebook(self, text: str) -> None:
        from IPython.display import display  # type: ignore[import]

        content = {"text/plain": text}
        if self._handle is None:
            self._handle = display(content, raw=True, display_id=True)
        else:
            self._handle.update(content, raw=True)

    def close(self) -> None:
        """Takes the line away."""
        if self._line_open:
            self._stream.write("\r\033[K")
            self._stream.flush()
        self._line_open = False


class following:
    """with following(progress) as call: the callable for the compiled module, or None."""

    def __init__(self, progress: ProgressOption) -> None:
        self._bar = Bar() if progress is True else None
        if progress is not None and not isinstance(progress, bool) and not callable(progress):
            raise TypeError("progress must be None, True, False or a callable")
        self._call = None if progress is None or isinstance(progress, bool) else progress

    def __enter__(self) -> Optional[Callable[[Progress], Any]]:
        return self._bar if self._bar is not None else self._call

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()

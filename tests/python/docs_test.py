"""Every ```python block of the documents runs: the blocks of a page in their order, with one namespace, in a folder of its own
that has the project's data in it."""
import os
import pathlib
import re

import pytest

SOURCE = pathlib.Path(os.environ["SPALL_SOURCE"])
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def blocks_of(page):
    text = page.read_text(encoding="utf-8")
    return [(text.count("\n", 0, found.start(1)), found[1]) for found in BLOCK.finditer(text)]


PAGES = [page for page in sorted([*SOURCE.glob("*.md"), *SOURCE.glob("docs/**/*.md")]) if blocks_of(page)]


def test_the_guide_is_among_them():
    assert SOURCE / "docs" / "python.md" in PAGES


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_blocks_run(page, tmp_path, monkeypatch):
    (tmp_path / "data").symlink_to(SOURCE / "data")
    monkeypatch.chdir(tmp_path)
    namespace = {"__name__": "__main__"}
    for line, block in blocks_of(page):
        # Empty lines in front, so that a traceback names the line of the document.
        exec(compile("\n" * line + block, str(page), "exec"), namespace)

"""docs/tutorial*.md run as they are written: the marked shell blocks of each in order, in one folder, with the files that it prints.

Marks, on the line above a block: "tested" blocks print what the page says (numbers within 2 %, the last digits being the
machine's); "tested short" ones press a mat of 8 mm in place of the page's, so that they only must succeed.
"""

import os
import pathlib
import re
import subprocess

from program import PROGRAM, SOURCE, check, finish, scratch

BLOCK = re.compile(r"(?:<!-- (tested|tested short) -->\n)?```(\w+)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e-?\d+)?(?![\w])")


def shell(text):
    """Result of a block, with this strandlab first in the path."""
    environment = os.environ | {"PATH": f"bin:{os.environ['PATH']}"}
    return subprocess.run(["bash", "-euo", "pipefail", "-c", text], capture_output=True, text=True, timeout=250, check=False,
                          env=environment)


def alike(shown, printed):
    """The same words, and numbers within 2 % or one of the last digit."""
    if NUMBER.sub("#", shown).split() != NUMBER.sub("#", printed).split():
        return False
    pairs = zip(NUMBER.findall(shown), NUMBER.findall(printed))
    return all(abs(float(a) - float(b)) <= max(0.02 * abs(float(a)), 1.01 * 10.0 ** -len(a.partition(".")[2])) for a, b in pairs)


def expect(page, lines, output, block):
    """Each line that the page shows is printed; a line ... stands for others."""
    for line in filter(lambda line: line != "...", lines):
        check(any(alike(line, other) for other in output), f"{page} shows \"{line}\", which is not printed by\n{block}")


def follow(page):
    """Does what the page says, in this folder."""
    blocks = BLOCK.findall((SOURCE / "docs" / page).read_text(encoding="utf-8"))
    pathlib.Path("bin").mkdir()
    pathlib.Path("bin/strandlab").symlink_to(PROGRAM)
    case, ran = pathlib.Path("aspen.toml"), 0
    output, block = None, ""
    for mark, language, name, text in blocks:
        if name:
            if page == "tutorial.md":  # its files are in the tree too
                check((SOURCE / "docs" / "tutorial" / name).read_text(encoding="utf-8") == text, f"docs/tutorial/{name} is what the page prints")
            pathlib.Path(name).write_text(text, encoding="utf-8")
        elif language == "sh":
            output, block = None, text
            if mark:
                as_shown = case.read_text(encoding="utf-8") if case.exists() else ""
                if mark == "tested short":
                    case.write_text(as_shown.replace("length_mm = 60 ", "length_mm = 8 "), encoding="utf-8")
                result = shell(text)
                ran += 1
                check(result.returncode == 0, f"{page}, exit code {result.returncode} of\n{text}{result.stderr}")
                if mark == "tested":
                    output = (result.stdout + result.stderr).splitlines()
                elif case.exists():
                    case.write_text(as_shown, encoding="utf-8")
        elif language == "text" and output is not None:
            expect(page, text.splitlines(), output, block)
    check(ran >= 2, f"only {ran} blocks of {page} were run")


for page in sorted((SOURCE / "docs").glob("tutorial*.md")):
    with scratch():
        follow(page.name)
finish()

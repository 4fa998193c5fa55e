"""docs/warnings.md and the sources say the same: each message of the page stands in a source, and each warning that a
source gives in one of the usual ways (WARNING, REMARK) is on the page."""

import re

from program import SOURCE, check, finish

LITERAL = r'"(?:[^"\\]|\\.)*"'
HEADING = re.compile(r"^#### `(.*)`$", re.MULTILINE)
# What begins a warning: said while a run goes on, kept of a press or test, found of its numbers, or a picture that is missing.
WARNING = re.compile(r"(?:\bwarn\(|\bwarnings?(?:->|\.)push_back\(|\bw\.push_back\(|\bkWarning,|\bwarning =)"
                     r"\s*(?:fmt::format\(\s*)?(" + LITERAL + r"(?:\s*" + LITERAL + ")*)")
# Remarks on a hot press cycle are pushed to a plain list, in these files.
REMARKING = ("src/strandlab/hotpress/answers.cpp", "src/strandlab/run/hotpress.cpp")
REMARK = re.compile(r"\blist\.push_back\(\s*(?:fmt::format\(\s*)?(" + LITERAL + r"(?:\s*" + LITERAL + ")*)")
PLACEHOLDER = r"\{[^{}]*\}"


def without_quote_characters(source):
    """A '"' opens no literal."""
    return re.sub(r"""'\\?"'""", "' '", source)


def unquoted(literals):
    """Text of adjacent literals."""
    return re.sub(r"\\(.)", r"\1", "".join(text[1:-1] for text in re.findall(LITERAL, literals)))


def pieces(text, placeholder):
    """The parts of a message that are the same each time, of which the shortest words say nothing."""
    parts = [part.strip() for part in re.split(placeholder, text)]
    return [part for part in parts if len(part) > 3]


def covers(heading, warning):
    """All that the heading quotes is in the warning."""
    return all(piece.lower() in warning.lower() for piece in pieces(heading, "…"))


def main():
    sources = {file: without_quote_characters(file.read_text(encoding="utf-8"))
               for folder in ("src", "apps") for file in sorted((SOURCE / folder).rglob("*.cpp"))}
    printed = "\n".join(unquoted(found) for text in sources.values() for found in re.findall(LITERAL + r"(?:\s*" + LITERAL + ")*", text))
    headings = HEADING.findall((SOURCE / "docs" / "warnings.md").read_text(encoding="utf-8"))
    check(len(headings) > 50, f"docs/warnings.md: only {len(headings)} messages found in it")
    for heading in headings:
        check(pieces(heading, "…"), f"docs/warnings.md: nothing to search for in \"{heading}\"")
        for piece in pieces(heading, "…"):
            check(piece in printed, f"docs/warnings.md: no source prints \"{piece}\" of \"{heading}\"")
    warnings = [unquoted(found) for text in sources.values() for found in WARNING.findall(text)]
    warnings += [unquoted(found) for file in REMARKING for found in REMARK.findall(sources[SOURCE / file])]
    check(len(warnings) > 20, f"only {len(warnings)} warnings found in the sources")
    for warning in warnings:
        says_something = sum(map(len, pieces(warning, PLACEHOLDER))) > 12  # else it passes on another
        check(not says_something or any(covers(heading, warning) for heading in headings),
              f"docs/warnings.md lacks the warning \"{warning}\"")


def glossary():
    """What the report's page tells on hover is what docs/glossary.md says."""
    source = (SOURCE / "src" / "strandlab" / "report" / "glossary.cpp").read_text(encoding="utf-8")
    page = (SOURCE / "docs" / "glossary.md").read_text(encoding="utf-8")
    begin = source.index("list{")
    texts = [unquoted(found) for found in re.findall(LITERAL + r"(?:\s*" + LITERAL + ")*", source[begin:source.index("return list", begin)])]
    check(len(texts) > 20 and len(texts) % 2 == 0, f"words with their meanings in report/glossary.cpp: {len(texts)} texts")
    for word, means in zip(texts[::2], texts[1::2]):
        check(word in page and means.rstrip(".") in page, f"docs/glossary.md does not say of {word}: {means}")


main()
glossary()
finish()

"""Writes the manual page and the completions of bash, zsh and fish from what the program says of itself: describe.py PROGRAM FOLDER."""

import pathlib
import re
import subprocess
import sys

PROGRAM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])


def said(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=True).stdout


class Command:
    """`strandlab NAME...`, its options as (flags, argument, meaning), and the commands below it."""

    def __init__(self, *names):
        self.names = names
        text = said(*names, "--help")
        self.meaning = text.splitlines()[0]
        self.usage = next(line.removeprefix("Usage: ") for line in text.splitlines() if line.startswith("Usage: "))
        sections = {}
        for line in text.splitlines()[2:]:
            if title := re.fullmatch(r"([A-Z]\w+):", line):
                entries = sections.setdefault(title[1], [])
            elif line.startswith(" " * 12):
                entries[-1][1] += " " + line.strip()  # the meaning, where what stands before is long
            elif line.startswith("  "):
                head, _, meaning = line[2:].partition("  ")
                entries.append([head.strip(), meaning.strip()])
        self.options = []
        for head, meaning in sections.get("Options", []):
            flags, _, argument = head.partition(" ")
            self.options.append((flags.split(","), argument, meaning.strip()))
        self.positionals = sections.get("Positionals", [])
        self.below = [Command(*names, head) for head, _ in sections.get("Subcommands", [])]

    def all(self):
        yield self
        for command in self.below:
            yield from command.all()

    @property
    def path(self):
        return " ".join(("strandlab", *self.names))


def keys():
    """Keys of a case that --set takes."""
    section, found = "", []
    for line in said("init", "--reference").splitlines():
        if title := re.fullmatch(r"## \[(.+)\]", line):
            section = title[1]
        if key := re.match(r"\| `(\w+)` \|", line):
            for name in ("surface", "core") if section == "kinds.NAME" else ("",):
                found.append(f"{section.replace('NAME', name)}.{key[1]}")
    return [key for key in found if "NAME" not in key and ".." not in key]


def roff(text):
    return re.sub(r"(?m)^([.'])", r"\\&\1", text.replace("\\", "\\e").replace("-", "\\-"))


def manual(program, version):
    text = [f'.TH STRANDLAB 1 "" "strandlab {version}" "Strandlab"', ".SH NAME", f"strandlab \\- {roff(program.meaning)}", ".SH SYNOPSIS",
            ".B strandlab", "COMMAND [OPTIONS]", ".SH COMMANDS"]
    for command in program.all():
        if command.below:
            continue
        text += [f".SS {roff(command.usage)}", roff(command.meaning) + "."]
        for head, meaning in command.positionals:
            text += [".TP", f".I {roff(head)}", roff(meaning)]
        for flags, argument, meaning in command.options:
            if "--help" not in flags:
                text += [".TP", f".B {roff(', '.join(flags))} {roff(argument)}", roff(meaning)]
    text += [".SH EXIT STATUS", "0 when all went well, 2 for input that cannot be used, 3 for a simulation that cannot go on.", ".SH ENVIRONMENT",
             ".TP", ".B STRANDLAB_ISA", "Build of the kernels to use: generic, avx2 or avx512.", ".TP", ".B STRANDLAB_SHARE",
             "Folder of report.html, the page to fill, in place of the one built into the program."]
    return "\n".join(text) + "\n"


def words(command):
    return " ".join([*(flag for flags, _, _ in command.options for flag in flags), *(below.names[-1] for below in command.below)])


def bash(program, all_keys):
    cases = "\n".join(f'    "{" ".join(command.names)}") words="{words(command)}" ;;' for command in program.all())
    nested = " ".join(command.names[0] for command in program.below if command.below)
    return f"""# Completion of strandlab for bash.
_strandlab() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command=${{COMP_WORDS[1]}} words=
  COMPREPLY=()
  if [ "$before" = --set ]; then
    compopt -o nospace
    mapfile -t COMPREPLY < <(compgen -S = -W "{' '.join(all_keys)}" -- "$current")
    return
  fi
  [ "$COMP_CWORD" -eq 1 ] && command=
  case " {nested} " in *" $command "*) [ -n "$command" ] && [ "$COMP_CWORD" -gt 2 ] && command="$command ${{COMP_WORDS[2]}}" ;; esac
  case $command in
{cases}
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  [[ $current == -* ]] || [ "$COMP_CWORD" -eq 1 ] || mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -f -- "$current")
}}
complete -o filenames -F _strandlab strandlab
"""


def zsh(program, all_keys):
    plain = str.maketrans({"'": "", ":": ";"})  # they end a word or its name here
    commands = "\n".join(f"    '{below.names[0]}:{below.meaning.translate(plain)}'" for below in program.below)
    cases = "\n".join(f"    {command.names[0]}) compadd -- {words(command)} ;;" for command in program.below)
    return f"""#compdef strandlab
# Completion of strandlab for zsh.
local -a commands
if (( CURRENT == 2 )); then
  commands=(
{commands}
  )
  _describe command commands
elif [[ ${{words[CURRENT-1]}} == --set ]]; then
  compadd -S = -- {' '.join(all_keys)}
else
  case ${{words[2]}} in
{cases}
  esac
  _files
fi
"""


def fish(program, all_keys):
    def quoted(text):
        return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"

    lines = ["# Completion of strandlab for fish."]
    for below in program.below:
        lines.append(f"complete -c strandlab -n __fish_use_subcommand -f -a {below.names[0]} -d {quoted(below.meaning)}")
        seen = f"-n '__fish_seen_subcommand_from {below.names[0]}'"
        for flags, argument, meaning in below.options:
            names = " ".join(f"-l {flag[2:]}" if flag.startswith("--") else f"-s {flag[1:]}" for flag in flags)
            takes = " -x -a " + quoted(" ".join(f"{key}=" for key in all_keys)) if "--set" in flags else " -r" if argument else ""
            lines.append(f"complete -c strandlab {seen} {names}{takes} -d {quoted(meaning)}")
        for nested in below.below:
            lines.append(f"complete -c strandlab {seen} -f -a {nested.names[-1]} -d {quoted(nested.meaning)}")
    return "\n".join(lines) + "\n"


program, all_keys = Command(), keys()
version = said("--version").split()[1]
FOLDER.mkdir(parents=True, exist_ok=True)
for name, text in (("strandlab.1", manual(program, version)), ("strandlab.bash", bash(program, all_keys)), ("_strandlab", zsh(program, all_keys)),
                   ("strandlab.fish", fish(program, all_keys))):
    (FOLDER / name).write_text(text, encoding="utf-8")

"""Cases: everything a user decides about a panel, by key."""

from __future__ import annotations

import json
import os
from typing import Any, Iterable, Mapping

from . import _core as core


def _toml(value: Any) -> str:
    """A value as TOML. Numbers of NumPy and paths count as what they stand for."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False).replace("\x7f", "\\u007F")
    if isinstance(value, Iterable):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    raise TypeError(f"a key takes a number, a text, true or false, or a list of them, not {type(value).__name__}")


class Section:
    """Keys of a case under one name: case.press.speed_m_s, case.kinds.core.angle_deg or case.kinds["core"].angle_deg."""

    _case: Case
    _path: str

    def __init__(self, case: Case, path: str) -> None:
        object.__setattr__(self, "_case", case)
        object.__setattr__(self, "_path", path)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(*error.args) from None

    def __getitem__(self, name: str) -> Any:
        return self._case._at(f"{self._path}.{name}")

    def __setattr__(self, name: str, value: Any) -> None:
        self._case[f"{self._path}.{name}"] = value

    __setitem__ = __setattr__

    def __dir__(self) -> list[str]:
        return self._case._below(self._path)

    def __repr__(self) -> str:
        return "\n".join(f"{path} = {self._case[path]!r}" for path in self._case.keys() if path.startswith(self._path + "."))


class Case:
    """A case, as a case file has it. Every change is checked together with all other keys, and refused by InputError.

    Case() is the default OSB panel. Keys are read and set by path or as attributes, several at once by update():

        case["press.speed_m_s"] = 8
        case.kinds.core.angle_deg = 45
        case.update({"kinds.core.length_mm": 40, "kinds.core.length_sd_mm": 5})
    """

    _core: core.Case

    def __init__(self, keys: Mapping[str, Any] | None = None, *, _core_case: core.Case | None = None) -> None:
        object.__setattr__(self, "_core", core.Case() if _core_case is None else _core_case)
        if keys:
            self.update(keys)

    @staticmethod
    def ready(name: str) -> Case:
        """One of ready_cases(): "osb", "plywood"... as `strandlab init NAME` prints it."""
        return Case(_core_case=core.ready_case(name))

    @staticmethod
    def read(file: str | os.PathLike[str]) -> Case:
        """A case file. File names in it count from its folder."""
        return Case(_core_case=core.read_case(os.fspath(file)))

    @staticmethod
    def from_toml(text: str) -> Case:
        """The text of a case file. File names in it count from the working directory."""
        return Case(_core_case=core.case_from_text(text))

    @property
    def name(self) -> str:
        """What messages call it."""
        return self._core.name

    @name.setter
    def name(self, name: str) -> None:
        self._core.name = name

    def to_toml(self) -> str:
        """All keys, as the case.toml of a run folder."""
        return self._core.to_toml()

    def copy(self) -> Case:
        return Case(_core_case=core.Case(self._core))

    def keys(self) -> list[str]:
        """Paths of all keys that the case has."""
        return self._core.paths()

    def help(self, path: str) -> str:
        """What a key means, its unit and what is allowed."""
        return self._core.help(path)

    def update(self, keys: Mapping[str, Any]) -> None:
        """Sets several keys at once: all of them, or none where they are refused."""
        assignments = [f"{path}={_toml(value)}" for path, value in keys.items()]
        object.__setattr__(self, "_core", self._core.changed(assignments))

    def changed(self, keys: Mapping[str, Any]) -> Case:
        """A copy with some keys changed."""
        copy = self.copy()
        copy.update(keys)
        return copy

    def _below(self, path: str) -> list[str]:
        start = path + "." if path else ""
        names = [key[len(start):].split(".")[0] for key in self.keys() if key.startswith(start)]
        return list(dict.fromkeys(names))

    def _at(self, path: str) -> Any:
        if self._below(path):
            return Section(self, path)
        return self._core.get(path)

    def __getitem__(self, path: str) -> Any:
        return self._at(path)

    def __setitem__(self, path: str, value: Any) -> None:
        self.update({path: value})

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self._at(name)
        except KeyError as error:
            raise AttributeError(*error.args) from None

    def __setattr__(self, name: str, value: Any) -> None:
        if name == "name":
            object.__setattr__(self, name, value)
        else:
            raise AttributeError(f"a case has no {name} to set; keys are set as case.press.speed_m_s = 8")

    def __dir__(self) -> list[str]:
        return [*object.__dir__(self), *self._below("")]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Case) and self.to_toml() == other.to_toml()

    __hash__ = None  # type: ignore[assignment]  # a case changes

    def __copy__(self) -> Case:
        return self.copy()

    def __deepcopy__(self, memo: Any) -> Case:
        return self.copy()

    def __getstate__(self) -> dict[str, str]:
        return {"name": self.name, "toml": self.to_toml()}

    def __setstate__(self, state: dict[str, str]) -> None:
        object.__setattr__(self, "_core", core.case_from_text(state["toml"]))
        self.name = state["name"]

    def __repr__(self) -> str:
        return f"<strandlab.Case {self.name}: {len(self.keys())} keys; print(case.to_toml()) shows them>"

    def _repr_html_(self) -> str:
        import html
        rows = "".join(f"<tr><td><code>{html.escape(path)}</code></td><td>{html.escape(str(self[path]))}</td>"
                       f"<td>{html.escape(self.help(path))}</td></tr>" for path in self.keys())
        return (f"<details><summary>case {html.escape(self.name)}</summary><table><tr><th>key</th><th>value</th><th>meaning</th></tr>"
                f"{rows}</table></details>")


def ready_cases() -> dict[str, str]:
    """Names of the cases that are there to start from, and what each is."""
    return {name: core.ready_case_title(name).splitlines()[0] for name in core.ready_cases()}

# SPDX-License-Identifier: Apache-2.0
"""Reads the results of filament-conformance and of filament-accuracy: results.json in the folder of their --out.

    report = reports.load_conformance("out/conformance")
    assert not report.failed, report.failed[0].reasons
    accuracy = reports.load_accuracy("out/accuracy")
    accuracy.effect("shadows").value("hard").own_error

A file of another shape raises CorruptError, which names the file and the place.
"""
import dataclasses
import json
import os
import pathlib
import typing

from ._core import CorruptError, NotFoundError, UnreadableError

__all__ = ["AccuracyEffect", "AccuracyReport", "AccuracyValue", "ConformanceCase", "ConformanceComparison",
           "ConformanceReport", "load_accuracy", "load_conformance"]

MAX_BYTES = 256 << 20
_MISSING = object()


class _Named(typing.Protocol):
    @property
    def name(self) -> str: ...


_T = typing.TypeVar("_T", bound=_Named)


@dataclasses.dataclass(frozen=True)
class ConformanceComparison:
    """A case drawn in another way than the reference: another API, or another number of workers."""
    configuration: str
    passed: bool
    differing: int  # pixels
    max_difference: float
    fault: str  # why the image must be wrong; empty if it can


@dataclasses.dataclass(frozen=True)
class ConformanceCase:
    """One scene, with one set of features."""
    name: str
    status: str  # "passed", "failed" or "skipped"
    reasons: typing.Tuple[str, ...]
    hash: str
    comparisons: typing.Tuple[ConformanceComparison, ...]


@dataclasses.dataclass(frozen=True)
class ConformanceReport:
    """What filament-conformance found."""
    build: str
    reference: str
    devices: typing.Dict[str, str]  # by backend
    cases: typing.Tuple[ConformanceCase, ...]

    @property
    def failed(self) -> typing.Tuple[ConformanceCase, ...]:
        """The cases that failed."""
        return tuple(case for case in self.cases if case.status == "failed")

    def case(self, name: str) -> ConformanceCase:
        """The case of that name; NotFoundError without one."""
        return _named(self.cases, name, "case")


@dataclasses.dataclass(frozen=True)
class AccuracyValue:
    """One value of a choice: its errors, and its time on each backend."""
    value: str
    set: typing.Tuple[str, ...]  # options, as "name=value"
    error: float  # of the whole frame
    own_error: float  # in the scene that shows the effect; relative RMS
    own_flip: float
    total_error: float
    milliseconds: typing.Dict[str, float]  # by backend; empty if nothing was timed

    @property
    def name(self) -> str:
        """The value."""
        return self.value


@dataclasses.dataclass(frozen=True)
class AccuracyEffect:
    """One choice of quality, with the errors of its values."""
    name: str
    title: str
    standard: str  # the default value
    best: str
    values: typing.Tuple[AccuracyValue, ...]

    def value(self, name: str) -> AccuracyValue:
        """The value of that name; NotFoundError without one."""
        return _named(self.values, name, "value")


@dataclasses.dataclass(frozen=True)
class AccuracyReport:
    """What filament-accuracy measured."""
    machine: str
    commit: str
    size: typing.Tuple[int, int]
    effects: typing.Tuple[AccuracyEffect, ...]

    def effect(self, name: str) -> AccuracyEffect:
        """The effect of that name; NotFoundError without one."""
        return _named(self.effects, name, "effect")


def load_conformance(path: typing.Union[str, "os.PathLike[str]"]) -> ConformanceReport:
    """Reads results.json of filament-conformance, or that of its output folder."""
    root = _read(path)
    devices = root.get("devices", dict, {})
    return ConformanceReport(build=root.get("build", str), reference=root.get("reference", str),
                             devices={name: devices.get(name, str) for name in devices.names()} if devices else {},
                             cases=tuple(_case(case) for case in root.items("cases")))


def load_accuracy(path: typing.Union[str, "os.PathLike[str]"]) -> AccuracyReport:
    """Reads results.json of filament-accuracy, or that of its output folder."""
    root = _read(path)
    if root.get("program", str) != "filament-accuracy" or root.get("version", int) != 1:
        raise CorruptError(f"{root.where}: not a file of filament-accuracy, version 1")
    size = root.get("size", list)
    if len(size) != 2 or not all(type(side) is int and side >= 0 for side in size):
        raise CorruptError(f"{root.where}: size: not two whole numbers")
    return AccuracyReport(machine=root.get("machine", str), commit=root.get("commit", str), size=(size[0], size[1]),
                          effects=tuple(_effect(effect) for effect in root.items("effects")))


def _case(node: "_Node") -> ConformanceCase:
    return ConformanceCase(name=node.get("name", str), status=node.get("status", str),
                           reasons=node.texts("reasons"), hash=node.get("hash", str, ""),
                           comparisons=tuple(_comparison(one) for one in node.items("comparisons", [])))


def _comparison(node: "_Node") -> ConformanceComparison:
    return ConformanceComparison(configuration=node.get("configuration", str), passed=node.get("passed", bool),
                                 differing=node.get("differing", int), max_difference=node.number("maxDifference"),
                                 fault=node.get("fault", str, ""))


def _effect(node: "_Node") -> AccuracyEffect:
    return AccuracyEffect(name=node.get("name", str), title=node.get("title", str), standard=node.get("standard", str),
                          best=node.get("best", str), values=tuple(_value(value) for value in node.items("values")))


def _value(node: "_Node") -> AccuracyValue:
    times = node.get("milliseconds", dict, {})
    return AccuracyValue(value=node.get("value", str), set=node.texts("set"), error=node.number("error"),
                         own_error=node.number("ownError"), own_flip=node.number("ownFlip"),
                         total_error=node.number("totalError"),
                         milliseconds={name: times.number(name) for name in times.names()} if times else {})


def _named(items: "typing.Sequence[_T]", name: str, what: str) -> "_T":
    for item in items:
        if item.name == name:
            return item
    raise NotFoundError(f"the report has no {what} '{name}'; it has {', '.join(item.name for item in items) or 'none'}")


class _Node:
    """An object of a JSON file, and where it is."""

    def __init__(self, value: typing.Any, where: str) -> None:
        self.where = where
        if not isinstance(value, dict):
            raise CorruptError(f"{where}: not an object")
        self._value = value

    def names(self) -> typing.List[str]:
        return list(self._value)

    def get(self, name: str, kind: type, otherwise: typing.Any = _MISSING) -> typing.Any:
        value = self._value.get(name, otherwise)
        if value is _MISSING:
            raise CorruptError(f"{self.where}: '{name}' is missing")
        if value is otherwise:
            return value
        # bool is an int in Python and none in JSON
        if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
            raise CorruptError(f"{self.where}: '{name}' is no {kind.__name__}")
        return _Node(value, f"{self.where}: {name}") if kind is dict else value

    def number(self, name: str) -> float:
        value = self._value.get(name, _MISSING)
        if value is None:  # how JSON has what is not finite
            return float("nan")
        if isinstance(value, bool) or not isinstance(value, (int, float)) or abs(value) > 1e300:
            raise CorruptError(f"{self.where}: '{name}' is {'missing' if value is _MISSING else 'no number'}")
        return float(value)

    def items(self, name: str, otherwise: typing.Any = _MISSING) -> "typing.List[_Node]":
        return [_Node(one, f"{self.where}: {name}[{i}]") for i, one in enumerate(self.get(name, list, otherwise))]

    def texts(self, name: str) -> typing.Tuple[str, ...]:
        """A list of texts; none if it is missing."""
        values = self.get(name, list, [])
        if not all(isinstance(value, str) for value in values):
            raise CorruptError(f"{self.where}: '{name}' is not a list of texts")
        return tuple(values)


def _read(file: typing.Union[str, "os.PathLike[str]"]) -> _Node:
    path = pathlib.Path(file)
    try:
        if path.is_dir():
            path = path / "results.json"
        if path.stat().st_size > MAX_BYTES:
            raise CorruptError(f"{path}: larger than {MAX_BYTES >> 20} MiB, which no report is")
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise NotFoundError(f"there is no file '{path}'; run the program that writes it first") from None
    except OSError as error:
        raise UnreadableError(f"cannot read '{path}': {error.strerror}") from None
    except ValueError as error:
        raise CorruptError(f"{path}: {error}") from None
    try:
        return _Node(json.loads(text), str(path))
    except (ValueError, RecursionError) as error:
        raise CorruptError(f"{path}: no JSON ({error})") from None

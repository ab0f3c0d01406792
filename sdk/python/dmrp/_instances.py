# SPDX-License-Identifier: MIT
"""The entry of a Python file: its descriptors and the functions of its instances, as the contract has them."""

from __future__ import annotations

import ctypes
import os
from types import ModuleType
from typing import Any, Callable

import numpy as np

from dmrp import _abi, plugin
from dmrp.guest import PluginMistake, place_of
from dmrp.views import AGENT, PERSON, Fleet, Observation, Problem, Sensors, Trace, World, path_of

_C = _abi.constants
_OK, _NO_SOLUTION, _ERROR = _C["DMRP_OK"], _C["DMRP_NO_SOLUTION"], _C["DMRP_ERROR"]
_KINDS: dict[type[plugin.Plugin], str] = {
    plugin.GlobalPlanner: "GLOBAL_PLANNER",
    plugin.LocalController: "LOCAL_CONTROLLER",
    plugin.CentralController: "LOCAL_CONTROLLER",
    plugin.PedestrianModel: "PEDESTRIAN_MODEL",
    plugin.Metric: "METRIC",
}


def _base(kind: type[plugin.Plugin]) -> type[plugin.Plugin]:
    return next(base for base in _KINDS if issubclass(kind, base))


def _numbers(answer: Any, shape: tuple[int, ...], what: str) -> Any:
    """An answer as doubles of this shape; otherwise an exception that says what it is."""
    array = np.asarray(answer)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{what} returned {array.dtype} in place of numbers")
    if array.shape != shape:
        expected = " x ".join(map(str, shape))
        raise ValueError(f"{what} returned an array of shape {array.shape}; {expected} numbers are expected")
    return array.astype(np.float64)


class Descriptor:
    """A class as a descriptor; it keeps what the descriptor points to."""

    def __init__(self, kind: Any, file: str) -> None:
        self.kind = kind
        self.kept: list[Any] = []
        self.place = place_of(kind, file)
        if not isinstance(kind.id, str) or not kind.id:
            raise PluginMistake(f"{self.place}: class {kind.__name__} has no id, as in id = \"org.example.mine\"")
        self.parameters: dict[str, plugin.Parameter] = {}
        for base in reversed(kind.__mro__):
            for key, declared in vars(base).items():
                if isinstance(declared, plugin.Parameter):
                    self.parameters[key] = declared
        self.c = self._made()

    def _text(self, text: str) -> int:
        buffer = ctypes.create_string_buffer(str(text).encode())
        self.kept.append(buffer)
        return ctypes.addressof(buffer)

    def _texts(self, texts: Any) -> int:
        array = (ctypes.c_void_p * max(1, len(texts)))(*[self._text(text) for text in texts])
        self.kept.append(array)
        return ctypes.addressof(array)

    def _keep(self, made: Any) -> int:
        self.kept.append(made)
        return ctypes.addressof(made)

    def _made(self) -> Any:
        kind = self.kind
        doc = (kind.__doc__ or "").strip().split("\n")[0]
        # Python's packages map much more memory than they use
        flags = _C["DMRP_FLAG_RESIDENT_MEMORY"]
        if issubclass(kind, plugin.CentralController):
            flags |= _C["DMRP_FLAG_CENTRAL"]
        if getattr(kind, "drives_backwards", False):
            flags |= _C["DMRP_FLAG_BACKWARDS"]
        if getattr(kind, "uncoordinated", False):
            flags |= _C["DMRP_FLAG_UNCOORDINATED"]
        if kind.starts_processes:
            flags |= _C["DMRP_FLAG_PROCESSES"]
        uses = list(kind.uses)
        return _abi.new(
            "dmrp_descriptor", kind=_C["DMRP_KIND_" + _KINDS[_base(kind)]], id=self._text(kind.id),
            name=self._text(kind.name or kind.__name__), version=self._text(kind.version),
            vendor=self._text(kind.vendor), summary=self._text(kind.summary or doc), source=self._text(kind.source),
            needed=self._texts([]), uses=self._texts(uses), uses_count=len(uses), params=self._parameters(),
            param_count=len(self.parameters), param_stride=_abi.dtypes["dmrp_param_spec"].itemsize, flags=flags,
            traits=self._traits(),
        )  # fmt: skip

    def _parameters(self) -> int:
        specs = (_abi.structs["dmrp_param_spec"] * max(1, len(self.parameters)))()
        for spec, (key, declared) in zip(specs, self.parameters.items()):
            spec.key, spec.type = self._text(key), _C["DMRP_PARAM_" + declared.kind]
            spec.unit, spec.doc = self._text(declared.unit), self._text(declared.help)
            spec.minimum, spec.maximum = declared.low, declared.high
            if declared.kind in ("BOOL", "INT"):
                spec.integer = int(declared.default)
            elif declared.kind == "DOUBLE":
                spec.number = declared.default
            elif declared.kind == "DOUBLE_ARRAY":
                spec.count = len(declared.default)
                spec.numbers = self._keep((ctypes.c_double * max(1, spec.count))(*declared.default))
            elif declared.kind == "STRING_ARRAY":
                spec.count, spec.texts = len(declared.default), self._texts(declared.default)
            else:
                spec.text = self._text(declared.default)
            spec.choices, spec.choice_count = self._texts(declared.choices), len(declared.choices)
        return self._keep(specs)

    def _traits(self) -> int | None:
        kind = self.kind
        if issubclass(kind, plugin.GlobalPlanner):
            return self._keep(_abi.new("dmrp_planner_traits", connectivity=kind.connectivity))
        if issubclass(kind, (plugin.LocalController, plugin.CentralController)):
            bits = 0
            for name in kind.kinematics:
                if f"DMRP_KINEMATICS_{str(name).upper()}" not in _C:
                    raise PluginMistake(f"{self.place}: class {kind.__name__} has the unknown kinematics {name!r}")
                bits |= 1 << _C[f"DMRP_KINEMATICS_{name.upper()}"]
            return self._keep(_abi.new("dmrp_controller_traits", kinematics=bits))
        if not issubclass(kind, plugin.Metric):
            return None
        specs = (_abi.structs["dmrp_metric_value_spec"] * max(1, len(kind.values)))()
        for spec, value in zip(specs, kind.values):
            if not isinstance(value, plugin.Value):
                raise PluginMistake(f"{self.place}: class {kind.__name__} has values that are not made by value()")
            spec.name, spec.unit, spec.description = self._text(value.name), self._text(value.unit), self._text(value.help)
            spec.direction, spec.subjects = value.direction, value.subjects
            spec.minimum, spec.maximum = value.low, value.high
        return self._keep(
            _abi.new(
                "dmrp_metric_traits", channels=_C["DMRP_CHANNEL_PEOPLE"] if kind.people else 0,
                values=self._keep(specs), value_count=len(kind.values),
                value_stride=_abi.dtypes["dmrp_metric_value_spec"].itemsize,
            )  # fmt: skip
        )


def _value_of(value: Any) -> Any:
    """A parameter's value."""
    kinds = {_C["DMRP_PARAM_" + name]: name for name in
             ("BOOL", "INT", "DOUBLE", "DOUBLE_ARRAY", "STRING_ARRAY")}  # fmt: skip
    kind = kinds.get(value.type)
    if kind == "BOOL":
        return bool(value.integer)
    if kind == "INT":
        return int(value.integer)
    if kind == "DOUBLE":
        return float(value.number)
    if kind == "DOUBLE_ARRAY":
        return _abi.array(value.numbers, value.count, np.float64).tolist()
    if kind == "STRING_ARRAY":
        return [_abi.text(int(at)) for at in _abi.array(value.texts, value.count, np.uint64)]
    return _abi.text(value.text)


class Instance:
    """An object of a class, by the functions of its kind."""

    Command = _abi.structs["dmrp_command"]

    def __init__(self, entry: Entry, descriptor: Descriptor, host: int, params: int) -> None:
        self.entry, self.descriptor, self.host = entry, descriptor, host
        table = _abi.at("dmrp_host", host)
        self._log = _abi.function("dmrp_host", "log", table)
        self.should_stop = _abi.function("dmrp_host", "should_stop", table)
        self.sensors = Sensors(host, [])
        self.trace: Any = None
        values = _abi.at("dmrp_params", params)
        self.object = descriptor.kind()
        for i in range(values.count):
            value = _abi.at("dmrp_param_value", values.values + i * values.stride)
            setattr(self.object, _abi.text(value.key), _value_of(value))
        self.object._log = lambda message: self._log(host, _C["DMRP_LOG_INFO"], str(message).encode())
        self.object.load()

    def start(self, start: int) -> int:
        given = _abi.at("dmrp_start", start)
        self.world = World(given.world)
        if isinstance(self.object, plugin.LocalController):
            self.object.robot = int(given.robot)
        self.sensors = Sensors(self.host, list(self.descriptor.kind.uses))
        self.object.start(self.world, int(given.seed))
        return _OK  # type: ignore[no-any-return]

    def set_path(self, update: int) -> int:
        given = _abi.at("dmrp_path_update", update)
        path = path_of(given.path)
        if isinstance(self.object, plugin.CentralController):
            self.object.set_path(int(given.robot), path)
        else:
            self.object.set_path(path)
        return _OK  # type: ignore[no-any-return]

    def step(self, observation: int, command: int) -> int:
        answer = self.object.step(Observation(observation, self.sensors))
        if answer is None:
            return _NO_SOLUTION  # type: ignore[no-any-return]
        out = self.Command.from_address(command)
        try:
            out.v_x, out.v_y, out.omega = answer  # floats, as most give them
        except (TypeError, ValueError):
            out.v_x, out.v_y, out.omega = _numbers(answer, (3,), "step()")
        return _OK  # type: ignore[no-any-return]

    def step_all(self, fleet: int) -> int:
        given = _abi.at("dmrp_fleet", fleet)
        answer = _numbers(self.object.step(Fleet(fleet, self.sensors)), (given.count, 3), "step()")
        for i, row in enumerate(answer.tolist()):
            out = _abi.at("dmrp_command", given.commands + i * given.command_stride)
            if any(number != number for number in row):
                out.status = _NO_SOLUTION
            else:
                out.v_x, out.v_y, out.omega = row
        return _OK  # type: ignore[no-any-return]

    def plan(self, problem: int, sink: int) -> int:
        asked = Problem(problem, lambda: bool(self.should_stop(self.host)))
        paths = self.object.plan(asked)
        if paths is None:
            return _NO_SOLUTION  # type: ignore[no-any-return]
        if len(paths) != len(asked.robots):
            raise ValueError(f"plan() returned {len(paths)} paths for {len(asked.robots)} robots")
        give = _abi.function("dmrp_plan_sink", "path", _abi.at("dmrp_plan_sink", sink))
        for robot, cells in enumerate(paths):
            rows = np.asarray(cells)
            if rows.ndim != 2 or rows.shape[1] != 2 or len(rows) == 0 or rows.dtype.kind not in "iu":
                raise ValueError(f"plan() returned a path of robot {robot} that is no rows of two whole numbers")
            waypoints = self._waypoints(asked, robot, rows)
            path = _abi.new("dmrp_path", count=len(rows), stride=waypoints.itemsize, waypoints=waypoints.ctypes.data)
            status = give(sink, robot, ctypes.addressof(path))
            if status != _OK:
                raise ValueError(f"plan() returned a path of robot {robot} that the host refuses")
        return _OK  # type: ignore[no-any-return]

    @staticmethod
    def _waypoints(asked: Problem, robot: int, cells: Any) -> Any:
        out = np.zeros(len(cells), _abi.dtypes["dmrp_waypoint"])
        centers = asked.grid.center_of(cells)
        out["x"], out["y"], out["theta"] = centers[:, 0], centers[:, 1], np.nan
        out["t_ns"] = asked.effective_from_ns + asked.step_duration_ns * np.arange(len(cells))
        first = int(asked.robots["first_goal_index"][robot])
        goals, at = asked.goals[robot], 0
        for i, cell in enumerate(cells):
            out["goal_index"][i] = first + at
            while at + 1 < len(goals) and tuple(cell) == tuple(goals[at]):
                at += 1
        return out

    def move_people(self, crowd: int, motions: int) -> int:
        given, out = _abi.at("dmrp_crowd", crowd), _abi.at("dmrp_motions", motions)
        people = _abi.array(given.people, given.person_count, PERSON, given.person_stride)
        robots = _abi.array(given.robots, given.robot_count, AGENT, given.robot_stride)
        answer = _numbers(self.object.step(people, robots, given.dt_ns * 1e-9), (given.person_count, 2), "step()")
        if given.person_count:
            buffer = (ctypes.c_char * (given.person_count * out.stride)).from_address(out.motions)
            np.ndarray((given.person_count, 2), np.float64, buffer, 0, (out.stride, 8))[:] = answer
        return _OK  # type: ignore[no-any-return]

    def begin(self, trial: int) -> int:
        self.trace = Trace(self.world)
        self.trace.begin(trial)
        return _OK  # type: ignore[no-any-return]

    def observe(self, sample: int) -> int:
        self.trace.add(sample)
        return _OK  # type: ignore[no-any-return]

    def finish(self, end: int, sink: int) -> int:
        self.trace.finish(end)
        answer = self.object.measure(self.trace)
        self.trace = None
        if not isinstance(answer, dict):
            raise TypeError(f"measure() returned {type(answer).__name__} in place of a dict of values by name")
        give = _abi.function("dmrp_metric_sink", "value", _abi.at("dmrp_metric_sink", sink))
        for name, value in answer.items():
            parts = value if isinstance(value, dict) else {"system": value}
            for subject, numbers in parts.items():
                for index, number in enumerate([numbers] if subject == "system" else numbers):
                    text = ctypes.create_string_buffer(str(name).encode())
                    kind = _C.get(f"DMRP_SUBJECT_{str(subject).upper()}")
                    if kind is None:
                        raise ValueError(f"measure() returned {name!r} for the unknown subject {subject!r}")
                    result = _abi.new(
                        "dmrp_metric_result", subject_kind=kind, name=ctypes.addressof(text), subject=index,
                        coordinate=np.nan, value=float(number),
                    )  # fmt: skip
                    if give(sink, ctypes.addressof(result)) != _OK:
                        raise ValueError(f"measure() returned {name!r}, which is not declared so, twice or infinite")
        return _OK  # type: ignore[no-any-return]


_TABLES: dict[type, tuple[str, dict[str, str]]] = {
    plugin.LocalController: ("dmrp_local_controller", {"set_path": "set_path", "step": "step"}),
    plugin.CentralController: ("dmrp_local_controller", {"set_path": "set_path", "step_all": "step_all"}),
    plugin.GlobalPlanner: ("dmrp_global_planner", {"plan": "plan"}),
    plugin.PedestrianModel: ("dmrp_pedestrian_model", {"step": "move_people"}),
    plugin.Metric: ("dmrp_metric", {"begin": "begin", "observe": "observe", "finish": "finish"}),
}


class Entry:
    """dmrp_entry of a file: init and create on its classes."""

    def __init__(self, module: ModuleType, guest: Any) -> None:
        self.guest = guest
        kinds = [
            kind for name, kind in vars(module).items()
            if isinstance(kind, type) and issubclass(kind, plugin.Plugin) and kind.__module__ == module.__name__
            and issubclass(kind, tuple(_KINDS)) and not name.startswith("_")
        ]  # fmt: skip
        if not kinds:
            raise PluginMistake("holds no plugin: no class of dmrp.plugin.LocalController, CentralController, "
                                "GlobalPlanner, PedestrianModel or Metric")  # fmt: skip
        self.descriptors = [Descriptor(kind, guest.file) for kind in dict.fromkeys(kinds)]
        self.instances: dict[int, Instance] = {}
        self.created = 0
        self.kept: list[Any] = []
        self.tables = {base: self._table(*described) for base, described in _TABLES.items()}
        self.start = self._callback("dmrp_plugin", "start", "start")
        destroy = _abi.functions["dmrp_plugin", "destroy"](self.destroy)
        self.kept.append(destroy)
        self.destroy_address = _abi.address_of(destroy)
        self.c = _abi.new(
            "dmrp_entry", abi_minor=_C["DMRP_ABI_MINOR"], min_host_minor=_C["DMRP_ABI_MINOR"],
            abi_draft=_C["DMRP_ABI_DRAFT"],
        )  # fmt: skip
        for name, function in (
            ("init", lambda entry, host: _OK), ("deinit", lambda entry: None),
            ("plugin_count", lambda entry: len(self.descriptors)),
            ("descriptor", lambda entry, index: ctypes.addressof(self.descriptors[index].c)), ("create", self.create),
        ):  # fmt: skip
            callback = _abi.functions["dmrp_entry", name](function)
            self.kept.append(callback)
            setattr(self.c, name, _abi.address_of(callback))
        self.address = ctypes.addressof(self.c)

    def _table(self, struct: str, methods: dict[str, str]) -> Any:
        fields = {field: self._callback(struct, field, method) for field, method in methods.items()}
        return _abi.new(struct, **fields)

    def _place(self, instance: Instance, method: str) -> str:
        """The function of the class that a function of the contract calls."""
        asked = {"step_all": "step", "move_people": "step", "finish": "measure"}.get(method, method)
        code = getattr(getattr(instance.object, asked, None), "__code__", None)
        own = code is not None and os.path.dirname(code.co_filename) == os.path.dirname(self.guest.file)
        return f"{os.path.basename(code.co_filename)}:{code.co_firstlineno}: " if code is not None and own else ""

    def _callback(self, struct: str, field: str, method: str) -> int:
        function = getattr(Instance, method)

        def call(instance: int, *arguments: Any) -> int:
            known = self.instances[instance]
            try:
                return function(known, *arguments)  # type: ignore[no-any-return]
            except BaseException as error:  # nothing may leave a callback
                return self.fail(known.host, error, self._place(known, method))

        callback = _abi.functions[struct, field](call)
        self.kept.append(callback)
        return _abi.address_of(callback)

    def fail(self, host: int, error: BaseException, place: str = "") -> int:
        try:
            set_error: Callable[[int, bytes], None] = _abi.function("dmrp_host", "set_error", _abi.at("dmrp_host", host))
            set_error(host, self.guest.describe(error, place).encode("utf-8", "replace"))
        except BaseException:
            pass
        if isinstance(error, MemoryError):
            return _C["DMRP_OUT_OF_MEMORY"]  # type: ignore[no-any-return]
        if isinstance(error, plugin.Unsupported):
            return _C["DMRP_UNSUPPORTED"]  # type: ignore[no-any-return]
        return _C["DMRP_TIMEOUT"] if isinstance(error, plugin.TimeOut) else _ERROR  # type: ignore[no-any-return]

    def create(self, entry: int, host: int, id: bytes, params: int, out: int) -> int:
        try:
            name = id.decode()
            descriptor = next(one for one in self.descriptors if one.kind.id == name)
            instance = Instance(self, descriptor, host, params)
            self.created += 1
            self.instances[self.created] = instance
            made = _abi.at("dmrp_plugin", out)
            made.self = self.created
            made.table = ctypes.addressof(self.tables[_base(descriptor.kind)])
            made.start, made.destroy = self.start, self.destroy_address
            return _OK  # type: ignore[no-any-return]
        except BaseException as error:
            return self.fail(host, error)

    def destroy(self, instance: int) -> None:
        self.instances.pop(instance, None)

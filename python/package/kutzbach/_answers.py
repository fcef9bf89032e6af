"""What is asked of a mechanism, and the answers that are plain data."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, KeysView, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

from . import _kutzbach
from ._ask import Value, asked, missing, names, table, value_text
from ._mechanism import Mechanism, compiled, framed

if TYPE_CHECKING:
    import networkx

Depth = Literal["rank", "verdict", "motions", "everything"]


class Answer:
    """An answer whose whole is plain data, equal to the JSON of the command line."""

    def __init__(self, text: str) -> None:
        self._text = text

    @cached_property
    def _data(self) -> dict[str, Any]:
        data: dict[str, Any] = json.loads(self._text)
        return data

    def to_dict(self) -> dict[str, Any]:
        """Everything, as plain data; each call makes it anew."""
        data: dict[str, Any] = json.loads(self._text)
        return data

    def __getitem__(self, field: str) -> Any:
        """One field of :meth:`to_dict`; ``KeyError`` where there is none."""
        try:
            return self._data[field]
        except KeyError:
            raise missing("field", field, self._data) from None

    def keys(self) -> KeysView[str]:
        """Names of the fields."""
        return self._data.keys()

    def __contains__(self, field: object) -> bool:
        return field in self._data

    def __iter__(self) -> Iterator[Any]:
        """Names of the fields."""
        return iter(self._data)


@dataclass(frozen=True)
class Idle:
    """Links that move while the rest of a branch stands still."""

    links: tuple[str, ...]
    freedom: int
    rod: bool
    """Whether it is a rod between balls that spins about itself."""


@dataclass(frozen=True)
class Branch:
    """A way of moving through the pose."""

    name: str
    dimension: int
    instantaneous: int | None
    redundant: int | None
    locked: tuple[str, ...]
    idle: tuple[Idle, ...]


def _branch(told: Mapping[str, Any]) -> Branch:
    return Branch(
        name=told["name"],
        dimension=told["dimension"],
        instantaneous=told["instantaneous"],
        redundant=told["redundant"],
        locked=tuple(told["locked"]),
        idle=tuple(
            Idle(tuple(own["links"]), own["freedom"], own.get("rod", False)) for own in told["idle"]
        ),
    )


class Analysis(Answer):
    """How a mechanism can move at a pose, and why. What is not decided, or was not asked, is ``None``, never zero."""

    def __init__(
        self,
        mechanism: Mechanism,
        depth: Depth,
        text: str,
        facts: str,
        analysed: _kutzbach.Analysed | None,
        configuration: str | None,
        question: str,
    ) -> None:
        super().__init__(text)
        self.mechanism = mechanism
        """What was asked about."""
        self.depth = depth
        """How much was asked."""
        self._facts: dict[str, Any] = json.loads(facts)
        self._analysed = analysed
        self._configuration = configuration
        self._question = question

    def __getstate__(self) -> dict[str, Any]:
        # The compiled part stays where it was made.
        return {**self.__dict__, "_analysed": None}

    @property
    def _is_whole(self) -> bool:
        return self.depth == "everything"

    @property
    def status(self) -> str:
        """``"analysed"``, or ``"unassembled"`` where no closed pose was found."""
        return str(self._facts["status"])

    @property
    def verdict(self) -> str | None:
        """``"mobile"``, ``"rigid"``, ``"undecided"`` or ``"unassembled"``."""
        return self._word("verdict")

    @property
    def freedom(self) -> int | None:
        """Finite degrees of freedom."""
        return self._count("finite")

    @property
    def instantaneous(self) -> int | None:
        """Instantaneous degrees of freedom at the pose."""
        return self._count("instantaneous")

    @property
    def kutzbach(self) -> int | None:
        """Kutzbach's count."""
        return self._count("kutzbach")

    @property
    def generic(self) -> int | None:
        """The count at random geometry of the same topology."""
        return self._count("generic")

    @property
    def redundant(self) -> int | None:
        """Redundant constraints at the pose."""
        return self._count("redundant")

    @property
    def margin(self) -> float | None:
        """How many times its tolerance the weakest rank is away from being another one; ``None`` where none is near."""
        margin = self._facts["margin"]
        return None if margin is None else float(margin)

    @property
    def pose(self) -> str | None:
        """``"regular"`` or ``"singular"``."""
        return self._word("pose")

    @property
    def kind(self) -> str | None:
        """In which way it is singular, such as ``"bifurcation"``."""
        return self._word("kind")

    @property
    def mobility_class(self) -> str | None:
        """Why it moves: ``"trivial"``, ``"exceptional"`` or ``"paradoxical"``."""
        return self._word("class")

    @property
    def reason(self) -> str | None:
        """Why there is no answer, or why it is open."""
        return self._word("reason")

    @property
    def branch_count(self) -> int | None:
        """How many branches pass through the pose; from depth ``"motions"`` on."""
        return self._count("branches")

    @property
    def locked(self) -> tuple[str, ...] | None:
        """Joints that rest on every branch; from depth ``"motions"`` on."""
        locked = self._facts["locked"]
        return None if locked is None else tuple(locked)

    @property
    def joint_freedoms(self) -> dict[str, int]:
        """How many freedoms each joint has."""
        return {joint.name: joint.freedom for joint in self.mechanism.joints}

    @cached_property
    def branches(self) -> tuple[Branch, ...] | None:
        """The branches; none for an isolated assembly. At depth ``"everything"``."""
        told = self._data.get("branches") if self._is_whole else None
        return None if told is None else tuple(_branch(own) for own in told)

    @property
    def useful(self) -> int | None:
        """Degrees of freedom that are not idle. At depth ``"everything"``."""
        return self._of_freedoms("useful")

    @property
    def idle(self) -> int | None:
        """Idle degrees of freedom: links that move while all others rest. At depth ``"everything"``."""
        return self._of_freedoms("idle")

    @property
    def certificate(self) -> str | None:
        """What the verdict rests on. At depth ``"everything"``."""
        told = self._data["mobility"]["certificate"] if self._is_whole else None
        return None if told is None else str(told["text"])

    @property
    def why(self) -> tuple[str, ...]:
        """Why the verdict is open, if it is. At depth ``"everything"``."""
        return tuple(self._data["mobility"]["why"]) if self._is_whole else ()

    def text(self, width: int = 100, verbose: bool = False) -> str:
        """The report for a person, at depth ``"everything"``; a line at any other."""
        if not self._is_whole:
            return repr(self)
        if self._analysed is None:
            # It came out of another process: the same question has the same answer.
            self._analysed = compiled(self.mechanism).analyse(self._question)
        return self._analysed.text(width, verbose)

    def to_networkx(self) -> networkx.MultiGraph[str]:
        """Links as nodes and joints as edges, with ``freedom``, ``locked``, ``closes_loop``; at depth ``"everything"`` ``ranges`` too."""
        from ._graph import graph

        links, ground = self.mechanism.links, self.mechanism.ground
        if self._is_whole:
            return graph(links, ground, self._data["joints"])
        locked = self.locked
        joints = [
            {
                "name": joint.name,
                "links": joint.links,
                "kind": joint.kind,
                "freedom": joint.freedom,
                "locked": None if locked is None else joint.name in locked,
                "closes_loop": joint.closes_loop,
            }
            for joint in self.mechanism.joints
        ]
        return graph(links, ground, joints)

    def __str__(self) -> str:
        return self.text()

    def __repr__(self) -> str:
        verdict = self.verdict or self.status
        counts = f"freedom {self.freedom}, instantaneous {self.instantaneous}"
        return f"<Analysis of {self.mechanism.name!r}: {verdict}, {counts}>"

    def _repr_html_(self) -> str:
        return framed(self.mechanism.page(self._configuration))

    def _word(self, field: str) -> str | None:
        word = self._facts[field]
        return None if word is None else str(word)

    def _count(self, field: str) -> int | None:
        count = self._facts[field]
        return None if count is None else int(count)

    def _of_freedoms(self, field: str) -> int | None:
        told = self._data.get("freedoms") if self._is_whole else None
        return None if told is None else int(told[field])


def analyse(
    mechanism: Mechanism,
    depth: Depth = "everything",
    *,
    configuration: str | None = None,
    closure_tolerance: float | None = None,
    exact: float | None = None,
    inputs: Sequence[str] = (),
    between: Iterable[tuple[str, str]] = (),
    evidence: bool = False,
) -> Analysis:
    """How a mechanism can move, and why.

    `depth` is ``"rank"``, ``"verdict"``, ``"motions"`` or ``"everything"``, each dearer than the one before. At ``"everything"``
    :meth:`Analysis.to_dict` is the JSON of ``kutzbach report``; below it, what a row of a sweep says. `configuration` is one of the
    file's. `exact` is the work for exact proofs in seconds of a usual machine (0.2 if not given; the same on every machine). `inputs`,
    `between` and `evidence` ask what ``kutzbach report`` asks by options of these names; they need the depth ``"everything"``.

    >>> import kutzbach
    >>> arm = kutzbach.load('''
    ... <robot name="arm">
    ...   <link name="base"/> <link name="upper"/>
    ...   <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
    ... </robot>''')
    >>> kutzbach.analyse(arm, "verdict")
    <Analysis of 'arm': mobile, freedom 1, instantaneous 1>
    """
    reading = compiled(mechanism)
    pairs = [list(own) for own in between]
    question = asked(
        depth=depth,
        configuration=configuration,
        closure_tolerance=closure_tolerance,
        exact=exact,
        inputs=names(inputs),
        between=pairs,
        evidence=evidence,
    )
    if depth != "everything":
        if len(inputs) or pairs or evidence:
            raise ValueError('`inputs`, `between` and `evidence` need depth="everything"')
        facts = reading.facts(question)
        return Analysis(mechanism, depth, facts, facts, None, configuration, question)
    analysed = reading.analyse(question)
    return Analysis(mechanism, depth, analysed.json(), analysed.facts(), analysed, configuration, question)


class Configurations(Answer):
    """Every way in which a mechanism closes."""

    @property
    def proven(self) -> bool:
        """Whether it is proven that there is no other."""
        return bool(self._data["complete"] == "proven")

    @property
    def held(self) -> dict[str, float]:
        """Joints that are held, and where (rad, m)."""
        return dict(self._data["held"])

    @property
    def joints(self) -> list[dict[str, float]]:
        """The values of all joints, for each configuration."""
        return [dict(solution["joints"]) for solution in self._data["solutions"]]

    def __len__(self) -> int:
        return len(self._data["solutions"])

    def __iter__(self) -> Iterator[dict[str, float]]:
        """The values of all joints, configuration by configuration."""
        return iter(self.joints)

    def __repr__(self) -> str:
        known = "proven" if self.proven else "not known to be all"
        return f"<Configurations of {self._data['mechanism']!r}: {len(self)}, {known}>"


def assemble(
    mechanism: Mechanism,
    *,
    hold: Mapping[str, Value] | None = None,
    budget: float | None = None,
) -> Configurations:
    """Finds every configuration in which a mechanism closes, with proof that there is no other: ``kutzbach assemble``.

    `hold` are joints and the values that they are held at (rad, m); a set of inputs where they are drawn if not given; ``{}`` holds
    none. `budget` is the work in seconds of a usual machine (10 if not given).
    """
    held = None if hold is None else [[joint, value_text(value)] for joint, value in table("hold", hold).items()]
    return Configurations(compiled(mechanism).assemble(asked(hold=held, budget=budget)))


class Proof(Answer):
    """What the closure equations prove as polynomials."""

    @property
    def dimension(self) -> int | None:
        """Complex dimension of all solutions; ``None`` where there is none, or it was not decided."""
        dimension = self._data["dimension"]
        return None if dimension is None else int(dimension)

    @property
    def outcome(self) -> str:
        """``"done"``, ``"in part"`` or ``"stopped"``."""
        return str(self._data["outcome"]["word"])

    def __repr__(self) -> str:
        name = self._data["mechanism"]
        return f"<Proof about {name!r}: {self.outcome}, dimension {self.dimension}>"


def exact(
    mechanism: Mechanism, *, configuration: str | None = None, budget: float | None = None
) -> Proof:
    """What polynomials prove of all poses of a mechanism: ``kutzbach exact``.

    `budget` is the work in seconds of a usual machine (30 if not given), the same on every machine.
    """
    return Proof(compiled(mechanism).exact(asked(configuration=configuration, budget=budget)))


class Simulation(Answer):
    """What the physics engine says of a prediction, and of the scene that the file calls for."""

    @property
    def outcome(self) -> str:
        """``"confirmed"``, ``"contradicted"`` or ``"inconclusive"``."""
        return str(self._data["verification"]["finding"]["outcome"])

    def __repr__(self) -> str:
        return f"<Simulation of {self._data['mechanism']!r}: {self.outcome}>"


def simulate(
    mechanism: Mechanism,
    *,
    branch: str | None = None,
    drive: str | None = None,
    seed: int | None = None,
    budget: float | None = None,
    duration: float | None = None,
    configuration: str | None = None,
    closure_tolerance: float | None = None,
) -> Simulation:
    """Puts the predicted motion to the test of a physics engine, and runs the file's scene: ``kutzbach simulate``.

    `duration` are the simulated seconds of the scene (2 if not given); `budget` is the work on the verification in seconds of a usual
    machine (30 if not given), counted in steps.
    """
    question = asked(
        branch=branch,
        drive=drive,
        seed=seed,
        budget=budget,
        duration=duration,
        configuration=configuration,
        closure_tolerance=closure_tolerance,
    )
    return Simulation(compiled(mechanism).simulate(question))


def explain(word: str) -> str | None:
    """What a word of a report means; ``None`` for a word without a definition."""
    return _kutzbach.explain(word)

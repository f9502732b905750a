# SPDX-License-Identifier: GPL-3.0-or-later
"""The records of results.  What each holds is the program's to say: the stub beside is made from it."""

from typing import Any

from clatter.records import Values
from clatter.words import by_arguments, in_python


class ImpactErrors(Values):
    """The error of each number of an impact: a bound by the discrete model, an estimate by the continuous one, None where it
    is not known."""

    __slots__ = ()


class Impact(Values):
    """One impact, SI units, world frame (x right, z up).

    n, start, duration, end ("a", "b", "both" ...), inclination_deg, contact_angle_deg, approach_speed, restitution,
    impulse_normal, impulse_tangential, impulse_ratio, impulse (3), mode, peak_force, peak_time, velocity_after (3),
    angular_velocity_after (3), energy_before, energy_after, energy_loss, error_estimate (the errors of these), amplification,
    predictable; in space also touches, corners, place (3) and attitude (4).  start counts from the first touch, peak_time from
    the impact's start.
    """

    __slots__ = ()
    _simulated = frozenset({"indentation", "work_damping", "work_friction", "work_released", "submerged", "local_slip", "energy_stored",
                            "ledger_gap"})
    _in_space = frozenset({"touches", "corners", "place", "attitude"})

    def _absent(self, name: str) -> str:
        whole = name.removesuffix("_error")
        if whole in self._simulated:
            return f"no '{name}' in an impact of the discrete model; those of simulate() have it"
        if whole in self._in_space:
            return f"no '{name}' in an impact of a body that keeps to its plane; those of bodies in space have it"
        return super()._absent(name)

    @classmethod
    def _converted(cls, name: str, value: Any) -> Any:
        return ImpactErrors(value) if name == "error_estimate" else super()._converted(name, value)

    def __repr__(self) -> str:
        return f"Impact {self['n']}: end {self['end']} at " + ", ".join(
            [f"{self['start']:.6g} s",
             *([] if self.get("contact_angle_deg") is None else [f"{self['contact_angle_deg']:.6g}°"]),
             f"P = {self['impulse_normal']:.6g} N·s"])


class SimulatedImpact(Impact):
    """An impact of the continuous model, which has peaks, and also touches, corners, attitude (4), indentation, work_damping,
    work_friction, work_released, submerged, local_slip, energy_stored and ledger_gap."""

    __slots__ = ()


class Accuracy(Values):
    """Relative error asked for and achieved."""

    __slots__ = ()


class Cost(Values):
    """What a run took: evaluations of forces and of the functions whose roots are sought."""

    __slots__ = ()


class Tail(Values):
    """The infinitely many impacts after the last one, summed up."""

    __slots__ = ()


class Answer(Values):
    """The worst blow of a report; what there is no number for, without a part, a probe or peaks, is None."""

    __slots__ = ()
    _names = frozenset({"probe", "impact", "delta_v", "peak_force", "peak_g", "width", "pulse_duration", "depth", "verdict", "margin", "decided_by",
                        "response_g", "attitude", "ranked_by", "least", "largest", "drops", "failing"})

    def __missing__(self, name: str) -> Any:
        return None if name in self._names else super().__missing__(name)

    @classmethod
    def _converted(cls, name: str, value: Any) -> Any:
        if name == "notes" and isinstance(value, list):
            return [by_arguments(in_python(note)) for note in value]
        return super()._converted(name, value)


class Check(Values):
    """A check of a claim, and what came out."""

    __slots__ = ()


class Rung(Values):
    """A model that could run a scene, with its error and cost."""

    __slots__ = ()


class Choice(Values):
    """The model of a plan that serves, with its command."""

    __slots__ = ()


class Equation(Values):
    """An equation of an explanation: its symbols, its numbers, and what comes out."""

    __slots__ = ()


class Step(Values):
    """A step of an explanation: what happens, and its equations."""

    __slots__ = ()
    equations: list[Equation]

    @classmethod
    def _converted(cls, name: str, value: Any) -> Any:
        return [Equation(one) for one in value] if name == "equations" else super()._converted(name, value)

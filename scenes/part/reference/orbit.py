"""The orbit of the part: flight, impact of a corner, flight, as long as there is nothing else."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part.reference.flight import Flight, places
from juggleproof.scenes.part.reference.impact import impact
from juggleproof.scenes.part.reference.roots import first_crossing
from juggleproof.scenes.part.reference.setting import Model, Setting, State
from juggleproof.scenes.part.reference.stops import Chatter, Simultaneous, Stopped

TOGETHER = "1e-12"  # metres: corners so close to the table strike together
MOST_IMPACTS, WITHIN = 20, "1e-6"  # more impacts in so many seconds are chatter


class Event(NamedTuple):
    """An impact: when, of which corner (an index of CORNERS), in which mode, and the states before
    and after it.
    """

    time: Any
    corner: int
    mode: str
    before: State
    after: State


def reference_orbit(
    setting: Setting,
    start: State,
    until: Any,
    digits: int = 50,
    *,
    together: Any = TOGETHER,
    most: int = MOST_IMPACTS,
    within: Any = WITHIN,
) -> list[Event]:
    """The impacts from a state in flight until a time; what it cannot follow raises, with the
    impacts until then in `events`.

    Dropped by 0.2 m under g = 10, with its centre above the corner, a part strikes after 0.2 s and,
    with e = 1/2, again after 0.2 s:

    >>> from math import atan
    >>> from juggleproof.scenes.part.reference import dropped, setting
    >>> block = setting(3, 4, e="1/2", mu="1/2", g=10)
    >>> tilted = dropped(block, theta=atan(3 / 4), height="0.2")
    >>> events = reference_orbit(block, tilted, until="0.41")
    >>> [(f"{float(event.time):.12f}", event.corner) for event in events]
    [('0.200000000000', 2), ('0.400000000000', 2)]
    """
    model = Model(setting, digits)
    begun, last = model.lifted(start), model.lift(until)
    _refuse_what_does_not_fly(model, begun, last)
    events: list[Event] = []
    try:
        for event in _impacts(model, begun, last, model.lift(together)):
            events.append(event)
            if len(events) > most and event.time - events[-1 - most].time < model.lift(within):
                raise Chatter(
                    f"more than {most} impacts within {within} s before t = {float(event.time):.9f}"
                )
    except Stopped as stopped:
        stopped.events = tuple(events)
        raise
    return events


def _refuse_what_does_not_fly(model: Model, start: State, last: Any) -> None:
    if last < start.t:
        raise SceneError(f"the orbit would end at t = {last}, before it begins at t = {start.t}")
    for corner, (gap, rate) in enumerate(Flight(model, start).gaps(start.t)):
        if not (gap > 0 or (gap == 0 and rate > 0)):
            raise SceneError(
                f"corner {corner} is not above the table at the start: its gap is"
                f" {float(gap):.3g} m"
            )


def _impacts(model: Model, start: State, last: Any, together: Any) -> Iterator[Event]:
    while True:
        flight = Flight(model, start)
        met = first_crossing(flight.gaps, flight.bound(), start.t, last, model.noise)
        if met is None:
            return
        event = struck(model, flight, *met)
        refuse_others_that_strike_too(flight, event, together)
        yield event
        if Flight(model, event.after).gaps(event.time)[event.corner][1] ** 2 <= model.noise:
            raise Chatter(
                f"corner {event.corner} stays on the table at t = {float(event.time):.9f}"
            )
        start = event.after


def struck(model: Model, flight: Flight, time: Any, corner: int) -> Event:
    """The impact of a corner at this time of a flight: only the velocities change."""
    before = flight.state(time)
    _, along, up = model.table(time)
    met = impact(
        (before.VX - along, before.VY - up, before.omega),
        places(model, before.theta)[corner],
        model.k2,
        model.e,
        model.mu,
    )
    push_along, push_up = met.impulse
    return Event(
        time,
        corner,
        met.mode,
        before,
        before._replace(VX=before.VX + push_along, VY=before.VY + push_up, omega=met.motion[2]),
    )


def refuse_others_that_strike_too(flight: Flight, event: Event, together: Any) -> None:
    """Raise where another corner is as good as on the table and approaches it, before this impact
    or after it.

    Both impulses would have to be taken symmetrically, so that a mirrored start gives the mirrored
    orbit; the law of one corner says nothing of it.
    """
    after = Flight(flight.model, event.after).gaps(event.time)
    for corner, (gap, rate) in enumerate(flight.gaps(event.time)):
        if corner != event.corner and gap <= together and min(rate, after[corner][1]) < 0:
            raise Simultaneous(
                f"corners {event.corner} and {corner} strike together at t ="
                f" {float(event.time):.9f}"
            )

"""Title, abstract, and section 2.1: what the paper promises, and the part on the vibrating table,
of which much is simulated and not proved.
"""

from __future__ import annotations

from juggleproof.judging import forms
from juggleproof.judging.claims import (
    Assertion,
    Following,
    NotFormalised,
    Reading,
    Readings,
    Remark,
    Simulated,
)
from juggleproof.proofs.paper.names import alpha, always, claim, g
from juggleproof.proofs.paper.states import STABILITY
from juggleproof.proofs.simulations.figures import Onset, figures
from juggleproof.statements.language import (
    Formula,
    Statement,
    Term,
    different,
    equal,
    iff,
    real,
    reals,
)
from juggleproof.symbolic import MODES


@claim("s0-all-starts", "abstract", "title and line 3")
def a_vibration_without_feedback_brings_every_ball_to_one_orbit() -> Following:
    """Without feedback, the table brings the ball from every initial state to one periodic
    orbit.
    """
    return Following(STABILITY, is_conclusion=True)


# -------------------------------------------------------------------------------------------------
# Section 2.1: what can be decided of the part.

om, acc, x, y, mass, c_x, c_y = reals("omega acc x y mass c_x c_y")
half_short, half_long = reals("h k")
kinetic = real("kinetic")
c, s, c_2, s_2 = reals("m p n q")  # cosine and sine of the angle of a block
UNIT, UNIT_2 = equal(c**2 + s**2, 1), equal(c_2**2 + s_2**2, 1)
PAST = half_long * s - half_short * c  # 0 where the centre is above the corner, theta = atan(h/k)


def height_of_centre(cosine: Term, sine: Term) -> Term:
    """The height of a block's centre above its lowest corner, for angles of 0 to 90 degrees."""
    return half_long * cosine + half_short * sine


@claim("s2.1-rotating-table", "2.1", "footnote 2", parameters=())
def parts_away_from_the_centre_of_a_turning_table_need_another_force() -> Statement:
    """Where a table turns about an axis through its centre, or begins to, a part that it carries
    off that axis experiences another force than one of the same mass at the centre.

    The place (x, y) is in the plane across the axis; the force is the mass times the acceleration,
    which at the centre is any.
    """
    along, across = mass * (c_x - om**2 * x - acc * y), mass * (c_y + acc * x - om**2 * y)
    return forms.always(
        different(along, mass * c_x) | different(across, mass * c_y),
        given=[mass > 0, different(om, 0) | different(acc, 0), different(x, 0) | different(y, 0)],
    )


@claim(
    "s2.1-fall-sides",
    "2.1",
    "line 70",
    parameters=(),
    remark=Remark(
        "That the energy of a block never rises is assumed; no impact of a corner raises it. That a"
        " block comes to rest is simulated, and not shown.",
        by=(*(f"part-{mode}-energy" for mode in MODES), "s2.1-fall"),
    ),
)
def a_block_let_go_never_passes_the_angle_at_which_its_centre_is_highest() -> list[Statement]:
    """A block that is let go with a corner on a still table, where its centre is not above that
    corner, and whose energy never rises, never passes through an angle at which its centre is above
    a corner; upright and lying, its centre is lowest.

    It is parted at tan(theta) = h/k, the half sides, which is 1/2 for 2 x 4 cm.  The centre is at
    least as high as above each corner.
    """
    start, highest = height_of_centre(c, s), half_short**2 + half_long**2

    def never_passed(across: Term, label: str) -> Statement:
        """The angle at which the centre is above, or below, the corner that is so far across."""
        above_corner = half_long * c_2 + across * s_2
        return forms.always(
            different(half_long * s_2, across * c_2),
            given=[
                UNIT,
                different(PAST, 0),
                y <= start,
                UNIT_2,
                y >= above_corner,
                y >= -above_corner,
            ],
            label=label,
        )

    return [
        forms.always(
            (start**2 <= highest) & iff(equal(start**2, highest), equal(PAST, 0)),
            given=[UNIT],
            label="highest",
        ),
        forms.always(
            y <= start, given=[g > 0, kinetic >= 0, kinetic + g * y <= g * start], label="no-higher"
        ),
        never_passed(half_short, "never-passed"),
        never_passed(-half_short, "never-passed-on-the-other-side"),
        forms.always(
            start > half_long,
            given=[half_long > 0, UNIT, c > 0, s > 0, PAST < 0],
            label="upright",
        ),
        forms.always(
            start > half_short,
            given=[half_short > 0, UNIT, c > 0, s > 0, PAST > 0],
            label="lying",
        ),
    ]


@claim("s2.1-fall-angles", "2.1", "line 70", parameters=())
def the_angle_that_parts_the_blocks_lies_between_26_and_27_degrees() -> list[Statement]:
    """tan 26 degrees < 1/2 < tan 27 degrees; of 26 degrees it is shown of 26.25.

    The tangent of five times 27 degrees is -1; that of four times 26.25 degrees, 105, is -2 -
    sqrt(3), and 26.25 degrees is an angle below 30, of which the tangent is below 3/5.
    """
    tangent = real("tangent")
    of_twice, over = 2 * tangent, 1 - tangent**2  # the tangent of twice the angle is a quotient
    of_four_times, over_that = 2 * of_twice * over, over**2 - of_twice**2
    return [
        forms.always(
            2 * tangent > 1,
            given=[
                tangent > 0,
                equal(
                    tangent**5 - 10 * tangent**3 + 5 * tangent,
                    -(1 - 10 * tangent**2 + 5 * tangent**4),
                ),
            ],
            label="above",
        ),
        forms.always(
            (2 * tangent < 1) | (5 * tangent > 3),
            given=[equal((of_four_times + 2 * over_that) ** 2, 3 * over_that**2)],
            label="below",
        ),
    ]


A, f, phase = reals("amplitude frequency phase")
A_2, f_2, phase_2 = reals("amplitude_2 frequency_2 phase_2")


def meeting_speed(amplitude: Term, frequency: Term, at_phase: Term) -> Term:
    """The relative speed of an impact at which a ball that strikes once a period meets the table:
    it falls at g/(2 f), and the table's velocity is A f times a factor of the phase.
    """
    return amplitude * frequency * at_phase + g / (2 * frequency)


def strikes_once_a_period(amplitude: Term, frequency: Term, at_phase: Term) -> list[Formula]:
    """The ball leaves the impact as fast as it came, upwards, so that it is back a period later."""
    falls = g / (2 * frequency)
    table = amplitude * frequency * at_phase
    factor = [at_phase >= -6, at_phase <= 6]  # within 2 pi
    return [
        amplitude > 0,
        frequency > 0,
        *factor,
        equal(falls, alpha * falls + (1 + alpha) * table),
    ]


def meets_at_one_speed() -> Statement:
    """A ball that strikes once a period meets the table at g/((1 + alpha) f): no amplitude changes
    it, and a higher frequency lowers it.
    """
    return always(
        equal(meeting_speed(A, f, phase) * (1 + alpha) * f, g),
        given=[f > 0, strikes_once_a_period(A, f, phase)[-1]],
    )


@claim(
    "s2.1-impact-velocity",
    "2.1",
    "line 79",
    parameters=(),
    remark=Remark(
        "A ball that strikes once a period meets the table at g/((1 + alpha) f): no amplitude"
        " changes this, and a higher frequency lowers it.",
        lambda: meets_at_one_speed(),
    ),
)
def impact_speeds_grow_with_amplitude_and_with_frequency() -> Readings:
    """The relative velocity of impacts on a vibrating table is proportional to the frequency and to
    the amplitude of the vibration: the velocity that the table has at one phase, or that at which a
    ball that strikes once in each period meets it.
    """
    y, y_2, rises, rises_2 = reals("height height_2 rises rises_2")
    vibrates = [
        equal(rises**2, f**2 * (A**2 - y**2)),
        equal(rises_2**2, f_2**2 * (A_2**2 - y_2**2)),
        *(one > 0 for one in (A, A_2, f, f_2, rises, rises_2)),
    ]
    at_one_phase = [*vibrates, equal(y_2 * A, y * A_2)]
    of_ball = [*strikes_once_a_period(A, f, phase), *strikes_once_a_period(A_2, f_2, phase_2)]
    one, two = meeting_speed(A, f, phase), meeting_speed(A_2, f_2, phase_2)

    def grows(first: Term, second: Term, given: list[Formula]) -> Assertion:
        return Assertion(
            (
                always(
                    equal(second * A, first * A_2),
                    given=[*given, equal(f_2, f)],
                    label="with-amplitude",
                ),
                always(
                    equal(second * f, first * f_2),
                    given=[*given, equal(A_2, A)],
                    label="with-frequency",
                ),
            )
        )

    return Readings(
        {
            "of-the-table": Reading(
                grows(rises, rises_2, at_one_phase),
                "section 2.1 names frequency and amplitude, which are the table's",
            ),
            "of-a-ball": Reading(
                grows(one, two, of_ball), "section 2.1 says the relative impact velocity"
            ),
        }
    )


CLOSED_FORM = (
    "which functions a closed form may be made of is not said, and that none of them solves an"
    " equation with a sine is no statement of real arithmetic"
)


@claim("s2.1-flight-time", "2.1", "line 81", parameters=())
def no_closed_form_of_the_time_of_flight() -> NotFormalised:
    """Between a block that turns as it flies and a table that moves as a sine, no closed form gives
    the time of flight.
    """
    return NotFormalised(CLOSED_FORM)


# -------------------------------------------------------------------------------------------------
# Section 2.1: what is simulated of the part; the figures are those of `simulations`.


def of_the_part() -> str:
    """What the runs have in common."""
    kept = figures()
    return f"{read_as()}; {kept['ensembles']} ensembles of 91 blocks, seed {kept['seed']}"


def read_as() -> str:
    """The reading of what the paper leaves open."""
    kept = figures()["reading"]
    return (
        f"{kept['face']} cm, amplitudes {kept['amplitudes']}, phases {kept['phase_x']:g} and"
        f" {kept['phase_y']:g} degrees, e = {kept['e']:g}, mu = {kept['mu']:g}"
    )


def seconds(onset: float | None) -> str:
    """An onset, or that none is within the run."""
    return "none" if onset is None else f"{onset:g} s"


def spread(counts: list[int]) -> str:
    """The least and the greatest."""
    return f"{min(counts)} to {max(counts)}"


def name_of(row: Onset) -> str:
    """The vibration along the table."""
    return f"{row['frequency']:g} Hz {row['amplitude']:g} mm"


def onset_of(row: Onset) -> str:
    """A row of table I: the median onset with its spread, and what the paper prints."""
    printed = "chaotic" if row["paper"] is None else f"{row['paper']:g} s"
    return (
        f"{name_of(row)} {seconds(row['median'])} ({seconds(row['low'])} to"
        f" {seconds(row['high'])}, {row['chaotic']} chaotic; printed {printed})"
    )


def is_most(count: int) -> bool:
    """So many are more than half of the ensembles."""
    return 2 * count > figures()["ensembles"]


def is_as_printed(row: Onset) -> bool:
    """The printed onset lies in the spread of the simulated ones; or most ensembles are chaotic, as
    printed.
    """
    if row["paper"] is None or is_most(row["chaotic"]):
        return row["paper"] is None and is_most(row["chaotic"])
    low, high = row["low"], row["high"]
    return low is not None and low <= row["paper"] and (high is None or row["paper"] <= high)


def third_row() -> Onset:
    """The row of table I with the vibration of figure 2."""
    return next(
        row for row in figures()["table"] if (row["frequency"], row["amplitude"]) == (30, 1)
    )


@claim("s2.1-fall", "2.1", "line 70", parameters=())
def where_blocks_come_to_rest_without_vibration() -> Simulated:
    """Let go on a still table, blocks from 0 to 26 degrees come to rest upright and those from 27
    to 90 degrees lying.
    """
    still = figures()["still"]
    low, high = still["between"]
    return Simulated(
        f"{still['upright']} of 91 blocks end upright and {still['lying']} lie, parted between"
        f" {low:.9f} and {high:.9f} degrees; {read_as()}",
        agrees=(still["upright"], still["lying"]) == (27, 64) and 26 < low < high < 27,
    )


@claim("s2.1-at-0.8-s", "2.1", "line 77", parameters=())
def some_blocks_still_stand_early() -> Simulated:
    """After 0.8 s of the vibration of figure 2 some blocks stand upright while their neighbours
    have fallen.
    """
    frame = figures()["frame"]
    return Simulated(
        f"{spread(frame['upright'])} of 91 stand at 0.8 s, and {spread(frame['apart'])} of 90 pairs"
        f" of neighbours differ; {of_the_part()}",
        agrees=min(frame["upright"]) > 0 and min(frame["apart"]) > 0,
    )


@claim("s2.1-at-3-s", "2.1", "line 77", parameters=())
def all_blocks_lie_late() -> Simulated:
    """After 3 s of the vibration of figure 2 all blocks lie."""
    late = figures()["frame"]["late"]
    return Simulated(
        f"all lie at 3 s in {late.count(0)} of {len(late)} ensembles, else {max(late)} or fewer"
        f" stand; {of_the_part()}",
        agrees=is_most(late.count(0)),
    )


@claim("s2.1-destabilizes", "2.1", "line 77", parameters=())
def the_vibration_fells_upright_blocks_and_no_lying_one() -> Simulated:
    """The vibration of figure 2 destabilizes the upright position and not the lying one."""
    row, ensembles = third_row(), figures()["ensembles"]
    felled = ensembles - row["censored"] - row["chaotic"]
    return Simulated(
        f"all blocks lie for good within 12 s in {felled} of"
        f" {ensembles} ensembles, and {row['rises']} blocks rise from 6 s on; {of_the_part()}",
        agrees=is_most(felled) and not row["rises"],
    )


@claim("table-1", "2.1.2", "table I", parameters=())
def from_when_on_all_blocks_lie() -> Simulated:
    """From when on all blocks lie, for six vibrations along the table, of which one is chaotic; by
    such a choice the lying position attracts all of these starts.
    """
    table = figures()["table"]
    rows = "; ".join(onset_of(row) for row in table)
    apart = [name_of(row) for row in table if not is_as_printed(row)]
    others = f", not those of {' and '.join(apart)}" if apart else ""
    return Simulated(
        f"{len(table) - len(apart)} of {len(table)} rows are as simulated{others};"
        f" median onsets: {rows}; {of_the_part()}",
        agrees=not apart,
    )


@claim("s2.1-no-generalization", "2.1", "line 79", parameters=())
def equal_speeds_of_the_table_act_unlike() -> Simulated:
    """Frequency and amplitude do not act alike: vibrations with the same product of both, 60 mm/s,
    have unlike onsets.
    """
    alike = [row for row in figures()["table"] if row["frequency"] * row["amplitude"] == 60]
    rows = "; ".join(onset_of(row) for row in alike)
    return Simulated(
        f"median onsets: {rows}; {of_the_part()}",
        agrees=len({row["median"] for row in alike}) > 1,
    )


@claim("s2.1-chaotic", "2.1", "line 79", parameters=())
def the_chaotic_vibration_turns_blocks_back_and_forth() -> Simulated:
    """The vibration that is called chaotic turns blocks back and forth between upright and
    lying.
    """
    (row,) = (row for row in figures()["table"] if row["paper"] is None)
    return Simulated(
        f"{row['chaotic']} of {figures()['ensembles']} ensembles are chaotic, and {row['rises']}"
        f" blocks rise from 6 s on; {of_the_part()}",
        agrees=is_as_printed(row),
    )

"""The figures of a report, and the data of those that show the ranges of claims."""

from __future__ import annotations

from base64 import b64decode, b64encode
from collections.abc import Collection, Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

from juggleproof.drawing.look import inline_svg
from juggleproof.judging import report_cache
from juggleproof.judging.extras import needed
from juggleproof.papers.figures import PaperFigure
from juggleproof.papers.paper import opened
from juggleproof.reports.contents import Contents, gather
from juggleproof.reports.contents import Entry as Judged
from juggleproof.reports.results import has_range
from juggleproof.reports.words import Interval, read
from juggleproof.statements.language import ClaimError, lemmas_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from juggleproof.drawing.argument import Dot
    from juggleproof.reports.part import TableResults


# claim (and reading), verdict, range; None where the range cannot be drawn
Row = tuple[str, str, "Sequence[Interval] | None"]
FORMS = ("svg", "pdf")


class Saved(NamedTuple):
    """A figure as a file, with its title, caption and alternative text."""

    slug: str
    title: str
    caption: str
    alt: str
    data: bytes


def of_paper() -> tuple[PaperFigure, ...]:
    """The figures of the paper, in order."""
    found: tuple[PaperFigure, ...] | None = opened().hook("figures", tuple)
    return found or ()


def figures(
    contents: Contents | None = None, leaving_out: Collection[str] = ()
) -> list[tuple[str, str, str, str, Figure]]:
    """Slug, title, caption, alternative text and figure of every figure, in order, except those
    left out; raises ClaimError where matplotlib is absent.
    """
    needed("matplotlib")
    entries = (contents or gather()).entries
    drawn = (one for one in of_paper() if one.slug not in leaving_out)
    return [(*labels(one), one.draw(entries)) for one in drawn]


def rows(entries: Iterable[Judged]) -> list[Row]:
    """A row for each range of each claim in which the parameter occurs."""
    return [
        (f"{entry.claim.id} ({label})" if label else entry.claim.id, entry.verdict, intervals)
        for entry in entries
        if has_range(entry.sharp)
        for label, intervals in read(entry.sharp)
    ]


def without_range(entries: Iterable[Judged]) -> int:
    """The number of claims in which the parameter does not occur."""
    return sum(not has_range(entry.sharp) for entry in entries)


def what_ranges_show(entries: Sequence[Judged]) -> tuple[list[Row], int]:
    """A row for each range, and the number of claims without a range."""
    return rows(entries), without_range(entries)


def what_claims_rest_on(entries: Sequence[Judged]) -> tuple[list[Dot], str]:
    """The claims with those that each rests on: the claim that it repeats, the claims of the map
    rules that settle it, and those of statements that its certificates use; and the theorem's.
    """
    from juggleproof.drawing.argument import Dot

    known = {entry.claim.id for entry in entries}
    dots = []
    for entry in entries:
        names = [entry.claim.repeats, *entry.rests_on]
        names += sorted(set().union(*(lemmas_of(one.certificate) for one in entry.statements)))
        claims = dict.fromkeys(name.partition("/")[0] for name in names)
        rests_on = tuple(name for name in claims if name in known and name != entry.claim.id)
        dots.append(Dot(entry.claim.id, entry.claim.section, entry.verdict, rests_on))
    theorem = opened().theorem
    return dots, theorem.claim if theorem else ""


def labels(one: PaperFigure) -> tuple[str, str, str, str]:
    """Slug, title, caption and alternative text of a figure."""
    return (
        one.slug,
        f"Figure {one.number}. {one.title}" if one.number else one.title,
        one.caption,
        one.alt,
    )


def saved(contents: Contents | None = None, form: str = "svg") -> list[Saved]:
    """Every figure in order as a file of this form (svg or pdf); they are kept in the cache, so
    that unchanged ones are not drawn again.

    Raises ClaimError where they must be drawn and matplotlib is absent, and for another form.
    """
    if form not in FORMS:
        raise ClaimError(f"{form!r} is no form of figures; choose from {', '.join(FORMS)}")
    contents = contents or gather()
    of_sources = report_cache.key(report_cache.version_of("matplotlib"))
    key = f"figures-{form}-{of_sources}" if report_cache.folder() else ""
    kept = _kept(report_cache.load(key)) if key else {}
    lasting = {one.slug for one in of_paper() if not one.of_verdicts}
    there = kept.keys() if kept.keys() == lasting else ()
    made = {slug: _file(figure, slug, form) for slug, *_, figure in figures(contents, there)}
    if key and not there:
        encoded = ((slug, b64encode(made[slug]).decode("ascii")) for slug in sorted(lasting))
        report_cache.keep(key, [{"slug": slug, "data": data} for slug, data in encoded])
    return [Saved(*labels(one), {**kept, **made}[one.slug]) for one in of_paper()]


def _kept(records: list[dict[str, str]]) -> dict[str, bytes]:
    try:
        return {record["slug"]: b64decode(record["data"], validate=True) for record in records}
    except (KeyError, TypeError, ValueError):
        return {}


def _file(figure: Figure, slug: str, form: str) -> bytes:
    from juggleproof.drawing import drawing

    return drawing.svg(figure, slug) if form == "svg" else drawing.pdf(figure)


class Picture(NamedTuple):
    """A figure of the page: SVG that contains its own title and description."""

    slug: str
    title: str
    caption: str
    alt: str
    svg: str


def pictures(contents: Contents) -> list[Picture]:
    """The report's figures."""
    return [
        Picture(
            one.slug,
            one.title,
            one.caption,
            one.alt,
            inline_svg(one.data, one.slug, one.title, one.alt),
        )
        for one in saved(contents)
    ]


def scene_picture(scene: TableResults | None) -> list[Picture]:
    """Figure 2 for the page; none where it was not drawn."""
    if scene is None or not scene.figure:
        return []
    slug, title, caption, alt = (scene.figure[key] for key in ("slug", "title", "caption", "alt"))
    return [Picture(slug, title, caption, alt, inline_svg(scene.figure["svg"], slug, title, alt))]

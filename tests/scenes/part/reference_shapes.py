"""The slow reference for any convex polygon, on a table that moves by harmonics; of exact numbers,
and by other ways than the scene's.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from mpmath import mpf

from juggleproof.scenes.part.setting import Scene
from tests.scenes.part.reference import Model, setting

Sines = Sequence[tuple[float, float, float]]


def triangles(corners: Sequence[tuple[Fraction, Fraction]]) -> tuple[Fraction, Fraction, Fraction]:
    """Centre of mass and squared radius of gyration about it, from the triangles of a fan: of each
    area, centroid, and the mean square of its corners and of its centroid (the parallel axes).

    >>> square = [(Fraction(x), Fraction(y)) for x, y in ((0, 0), (2, 0), (2, 2), (0, 2))]
    >>> triangles(square)
    (Fraction(1, 1), Fraction(1, 1), Fraction(2, 3))
    """
    fan = []
    (x0, y0), rest = corners[0], corners[1:]
    for (x1, y1), (x2, y2) in zip(rest, rest[1:]):
        area = ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) / 2
        square = sum((x * x + y * y for x, y in ((x0, y0), (x1, y1), (x2, y2))), Fraction(0))
        middle = ((x0 + x1 + x2) / 3, (y0 + y1 + y2) / 3)
        fan.append((area, middle, (square + 9 * (middle[0] ** 2 + middle[1] ** 2)) / 12))
    whole = sum(area for area, _, _ in fan)
    X, Y = (sum(area * middle[k] for area, middle, _ in fan) / whole for k in range(2))
    about = sum(area * square for area, _, square in fan) / whole
    return X, Y, about - X * X - Y * Y


class ShapedModel(Model):
    """The block and the table of a scene, whatever they are."""

    def __init__(self, block: Scene, digits: int) -> None:
        super().__init__(setting(1, 1, e=block.e, mu=block.mu, g=block.g), digits)
        corners = [(Fraction(x), Fraction(y)) for x, y in block.polygon().corners]
        self.k2 = self.lift(triangles(corners)[2])
        self.ends = [(self.lift(x), self.lift(y)) for x, y in corners]
        self.rho = max(self.context.hypot(x, y) for x, y in self.ends)
        self.sines: tuple[Sines, Sines]
        if block.drive is None:
            self.sines = (
                [(block.A_x, block.f_x, block.phase_x)],
                [(block.A_y, block.f_y, block.phase_y)],
            )
        else:
            self.sines = (block.drive.along, block.drive.away)

    def table(self, t: mpf) -> tuple[mpf, mpf, mpf]:
        """Height, and the speeds along and upwards."""
        (_, along), (height, up) = self.moved(0, t), self.moved(1, t)
        return height, along, up

    def moved(self, axis: int, t: mpf) -> tuple[mpf, mpf]:
        """Place and speed along an axis."""
        place = speed = self.context.mpf(0)
        for A, f, phase in self.sines[axis]:
            W = 2 * self.context.pi * self.lift(f)
            cosine, sine = self.context.cos_sin(W * t + self.lift(phase))
            place, speed = place + self.lift(A) * sine, speed + self.lift(A) * W * cosine
        return place, speed

    def steepest(self) -> mpf:
        """A bound of the table's acceleration upwards."""
        return sum(
            (abs(self.lift(A)) * (2 * self.context.pi * self.lift(f)) ** 2)
            for A, f, _ in self.sines[1]
        ) + self.context.mpf(0)


def modelled(block: Scene, digits: int = 35) -> ShapedModel:
    """A scene as the reference follows it."""
    return ShapedModel(block, digits)

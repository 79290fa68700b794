"""The animation is one file that shows the simulated states, asks for nothing, and is moved by
slider, keys and button.
"""

from __future__ import annotations

import base64
import io
import json
import re
from collections.abc import Iterator
from functools import cache
from math import nan
from typing import TYPE_CHECKING

import numpy as np
import pytest

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body, scene
from juggleproof.scenes.part.animation import ANGLE, LENGTH, RATE, animation, digest, varied
from juggleproof.scenes.part.ensemble import frames
from juggleproof.scenes.part.layout import ANGLES, lying
from juggleproof.scenes.part.picture import as_in_figure_two
from juggleproof.scenes.part.setting import Array
from tests.reports.browser import Element, chromium, read_html, requests, resize
from tests.rows import each_row

if TYPE_CHECKING:
    from selenium.webdriver.chrome.webdriver import WebDriver

pytest.importorskip("numba", reason="numba, the extra `part`, is not installed")

SETTING = as_in_figure_two(scene(e=0.7, mu=0.08))
HORIZON = 3.0
TIMES = np.arange(round(HORIZON * RATE) + 1) / RATE
MEDIA = "Emulation.setEmulatedMedia"


def made(angles: Array = ANGLES, horizon: float = HORIZON) -> bytes:
    file = io.BytesIO()
    animation(SETTING, angles, horizon, file)
    return file.getvalue()


@cache
def page() -> bytes:
    return made()


@cache
def document() -> Element:
    return read_html(page().decode())


@cache
def seen() -> Array:
    return frames(SETTING, ANGLES, TIMES)


def unvaried(text: str) -> list[int]:
    """What `varied` wrote, read by its own words."""
    found, number, shift = [], 0, 0
    for byte in base64.b64decode(text):
        number |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            found.append(number // 2 if number % 2 == 0 else -(number + 1) // 2)
            number = shift = 0
    return found


def test_states_are_those_simulated_to_half_a_unit_holds() -> None:
    given = json.loads(
        next(one.text() for one in document().all("script") if one.attributes.get("id") == "states")
    )
    assert (given["frames"], given["blocks"], given["rate"]) == (181, 91, 60)
    for name, column, unit in (
        ("X", body.X, LENGTH),
        ("Y", body.Y, LENGTH),
        ("theta", body.THETA, ANGLE),
    ):
        places = np.cumsum(np.array(unvaried(given[name])).reshape(181, 91), axis=0) * unit
        assert np.abs(places - seen()[:, :, column]).max() <= unit / 2 * (1 + 1e-9)


def test_numbers_are_read_back_holds() -> None:
    numbers = [0, 1, -1, 63, -64, 64, 10**6, -(10**9)]
    assert unvaried(base64.b64encode(varied(numbers)).decode()) == numbers


def test_file_is_small_and_the_same_from_run_to_run_holds() -> None:
    assert len(page()) < 500_000 and page() == made()


def test_nothing_is_fetched_holds() -> None:
    assert not list(document().all("link", "img", "iframe", "object", "embed", "base"))
    assert not [
        name
        for one in document().all()
        for name in one.attributes
        if name in ("src", "href", "style") or name.startswith("on")
    ]
    assert not re.findall(rb"https?://|@import|url\(", page())
    policy = next(
        one.attributes["content"]
        for one in document().all("meta")
        if "Content-Security-Policy" in one.attributes.get("http-equiv", "")
    )
    style = next(document().all("style")).text()
    script = next(one.text() for one in document().all("script") if "type" not in one.attributes)
    assert policy.startswith(
        f"default-src 'none'; style-src '{digest(style)}'; script-src '{digest(script)}';"
    )


@each_row("horizon", [0.0, -1.0, 61.0, nan])
def test_rejects_a_horizon_that_no_file_has_room_for(horizon: float) -> None:
    with pytest.raises(SceneError, match="^horizon"):
        made(horizon=horizon)


def test_rejects_more_blocks_than_are_seen() -> None:
    with pytest.raises(SceneError, match="601 blocks"):
        made(angles=np.zeros(601))


@pytest.fixture(scope="module")
def driver(tmp_path_factory: pytest.TempPathFactory) -> Iterator[WebDriver]:
    path = tmp_path_factory.mktemp("animation") / "part.html"
    path.write_bytes(page())
    with chromium(1000, 1000) as browser:
        browser.address = path.as_uri()
        yield browser


def opened(driver: WebDriver, motion: str = "reduce") -> WebDriver:
    """The page, loaded anew."""
    driver.execute_cdp_cmd(
        MEDIA, {"media": "", "features": [{"name": "prefers-reduced-motion", "value": motion}]}
    )
    resize(driver, 1000, 1000)
    driver.get("about:blank")
    driver.get_log("browser")
    requests(driver)
    driver.get(driver.address)
    return driver


def status(driver: WebDriver) -> str:
    return str(driver.execute_script("return document.getElementById('told').textContent"))


def words(frame: int) -> str:
    down = int(lying(SETTING, seen()[frame]).sum())
    return f"{TIMES[frame]:.2f} s: {91 - down} of 91 nearer to upright, {down} nearer to lying"


def pixels(driver: WebDriver) -> str:
    return str(driver.execute_script("return document.getElementById('picture').toDataURL()"))


def slide(driver: WebDriver, time: float) -> None:
    driver.execute_script(
        "const s = document.getElementById('time'); s.value = arguments[0]; s.dispatchEvent(new"
        " Event('input'));",
        str(time),
    )


def press(driver: WebDriver, key: str) -> None:
    from selenium.webdriver.common.action_chains import ActionChains

    ActionChains(driver).send_keys(key).perform()


def test_loads_without_error_and_asks_for_nothing_else_holds(driver: WebDriver) -> None:
    opened(driver)
    assert driver.get_log("browser") == []
    assert set(requests(driver)) - {"about:blank"} == {driver.address}


def test_slider_moves_the_blocks_holds(driver: WebDriver) -> None:
    opened(driver)
    shots = {pixels(driver)}
    assert status(driver) == words(0)
    for frame in (30, 48, 180):
        slide(driver, TIMES[frame])
        assert status(driver) == words(frame)
        shots.add(pixels(driver))
    assert len(shots) == 4
    slide(driver, 0)
    assert pixels(driver) in shots and status(driver) == words(0)


def test_blocks_are_drawn_where_they_are_holds(driver: WebDriver) -> None:
    """The middle of every block has its kind's colour, at the start and half a second on."""
    opened(driver)
    for frame in (0, 30):
        slide(driver, TIMES[frame])
        drawn = driver.execute_script(
            """
          const pen = document.getElementById("picture").getContext("2d"), m = pen.getTransform();
          return arguments[0].map(([x, y]) =>
            [...pen.getImageData(m.a * x + m.e, m.d * y + m.f, 1, 1).data.slice(0, 3)]);""",
            [
                [(k % 10) * pitch(), (k // 10) * pitch() + seen()[frame, k, body.Y]]
                for k in range(91)
            ],
        )
        assert drawn == [
            [0xC7, 0xDF, 0xEE] if down else [0xD5, 0x5E, 0x00]
            for down in lying(SETTING, seen()[frame])
        ]


def pitch() -> float:
    from juggleproof.scenes.part.layout import pitch as of

    return of(SETTING)


def test_keys_move_time_holds(driver: WebDriver) -> None:
    from selenium.webdriver.common.keys import Keys

    opened(driver)
    for key, frame in (
        (Keys.ARROW_RIGHT, 1),
        (Keys.PAGE_UP, 16),
        (Keys.ARROW_LEFT, 15),
        (Keys.END, 180),
        (Keys.HOME, 0),
    ):
        press(driver, key)
        assert status(driver) == words(frame)
    press(driver, " ")
    assert driver.execute_script("return document.getElementById('play').textContent") == "Pause"
    press(driver, " ")
    assert driver.execute_script("return document.getElementById('play').textContent") == "Play"


def test_plays_to_the_end_and_again_holds(driver: WebDriver) -> None:
    from selenium.webdriver.support.ui import WebDriverWait

    opened(driver)
    slide(driver, 2.8)
    driver.execute_script(
        "document.getElementById('speed').value = '2'; document.getElementById('play').click();"
    )
    WebDriverWait(driver, 20).until(lambda _: status(driver) == words(180))
    assert driver.execute_script("return document.getElementById('play').textContent") == "Play"
    driver.execute_script(
        "document.getElementById('speed').value = '0.05'; document.getElementById('play').click();"
    )
    WebDriverWait(driver, 20).until(lambda _: status(driver).startswith("0."))
    assert driver.execute_script("return document.getElementById('play').textContent") == "Pause"


def test_moves_by_itself_only_where_motion_is_not_to_be_reduced_holds(driver: WebDriver) -> None:
    from selenium.webdriver.support.ui import WebDriverWait

    opened(driver)
    still = driver.execute_async_script(
        "const done = arguments[0]; setTimeout(() =>"
        " done(document.getElementById('told').textContent), 300);"
    )
    assert still == words(0)
    opened(driver, "no-preference")
    WebDriverWait(driver, 20).until(lambda _: status(driver) != words(0))


def test_drift_is_shown_when_asked_for_holds(driver: WebDriver) -> None:
    opened(driver)
    slide(driver, 3)
    without = pixels(driver)
    driver.execute_script("document.getElementById('drift').click()")
    assert pixels(driver) != without and status(driver) == words(180)


def test_readers_who_do_not_see_are_told_what_things_are_holds(driver: WebDriver) -> None:
    opened(driver)
    label = driver.execute_script(
        "return document.getElementById('picture').getAttribute('aria-label')"
    )
    assert (
        label.startswith("91 rectangles in rows bounce and turn")
        and f"{int((~lying(SETTING, seen()[-1])).sum())} after 3 s" in label
    )
    assert driver.execute_script(
        "return document.getElementById('time').getAttribute('aria-valuetext')"
    ) == words(0)
    assert (
        driver.execute_script("return document.getElementById('told').getAttribute('aria-live')")
        == "polite"
    )
    assert all(
        driver.execute_script(
            "return [...document.querySelectorAll('input, select')].map((one) => one.labels.length"
            " === 1)"
        )
    )


def test_fits_a_phone_holds(driver: WebDriver) -> None:
    opened(driver)
    resize(driver, 360, 740)
    assert driver.execute_script("return document.documentElement.scrollWidth") <= 360

"""The page as a browser shows it: drawn, filtered, linked, readable on a phone, in the dark, on
paper, by keyboard and without a script.
"""

from __future__ import annotations

import base64
import shutil
import subprocess
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.reports.browser import chromium, contrast, read_whole, requests, resize, scheme
from tests.reports.runs import page, page_of_some, some_contents

if TYPE_CHECKING:
    from selenium.webdriver.remote.webdriver import WebDriver
    from selenium.webdriver.remote.webelement import WebElement

pytestmark = pytest.mark.exhaust
Load = Callable[..., "WebDriver"]  # of a place in a page
RULE = "rule-theorem-in-units/contracts"
PREMISE = "premise-theorem-in-units/contracts.closer-1"


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[WebDriver, Path]]:
    with chromium() as driver:
        folder = tmp_path_factory.mktemp("page")
        (folder / "juggleproof.html").write_bytes(page())
        (folder / "some.html").write_bytes(page_of_some())
        yield driver, folder


def shows(driver: WebDriver, path: Path) -> Load:
    """What loads a page anew at a place and returns the driver; what moves stands still, unless it
    is what is looked at: to draw it takes half of a processor, and a frame is awaited at each step.
    """

    def at(place: str = "", scripted: bool = True, moving: bool = False) -> WebDriver:
        driver.get("about:blank")
        driver.get(path.as_uri() + place)
        if scripted:
            wait_for(driver, "return document.documentElement.classList.contains('whole')")
        if not moving:
            driver.execute_script("document.getElementById('motion').pauseAnimations()")
        return driver

    resize(driver, 1280)
    scheme(driver, "light")
    return at


@pytest.fixture
def show(opened: tuple[WebDriver, Path]) -> Load:
    """Loads a page with some of the claims."""
    return shows(opened[0], opened[1] / "some.html")


@pytest.fixture
def show_whole(opened: tuple[WebDriver, Path]) -> Load:
    """Loads the page as users have it."""
    return shows(opened[0], opened[1] / "juggleproof.html")


def find(driver: WebDriver, selector: str) -> WebElement:
    from selenium.webdriver.common.by import By

    return driver.find_element(By.CSS_SELECTOR, selector)


def find_all(driver: WebDriver, selector: str) -> list[WebElement]:
    from selenium.webdriver.common.by import By

    return driver.find_elements(By.CSS_SELECTOR, selector)


def named(driver: WebDriver, name: str) -> WebElement:
    from selenium.webdriver.common.by import By

    return driver.find_element(By.ID, name)


def wait_for(driver: WebDriver, script: str, *arguments: WebElement) -> None:
    from selenium.webdriver.support.ui import WebDriverWait

    WebDriverWait(driver, 20, poll_frequency=0.02).until(
        lambda driver: driver.execute_script(script, *arguments)
    )


def shown(driver: WebDriver) -> set[str]:
    return set(
        driver.execute_script(
            "return [...document.querySelectorAll('article.claim:not([hidden])')].map((one) =>"
            " one.id)"
        )
    )


def with_verdict(*words: str) -> set[str]:
    return {entry.claim.id for entry in some_contents().entries if entry.verdict in words}


@cache
def words_of_claims() -> dict[str, str]:
    articles = read_whole(page_of_some().decode("utf-8")).with_class("claim")
    return {
        one.attributes["id"]: " ".join(
            (one.text() + " " + " ".join(m.attributes["alttext"] for m in one.all("math")))
            .lower()
            .split()
        )
        for one in articles
    }


def test_loads_without_error_and_asks_for_nothing_else_holds(show_whole: Load) -> None:
    driver = show_whole()
    driver.get_log("browser")
    requests(driver)
    driver = show_whole("#errata")
    assert [
        entry for entry in driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")
    ] == []
    asked = {address.partition("#")[0] for address in requests(driver)} - {"about:blank"}
    assert asked == {driver.current_url.partition("#")[0]} and next(iter(asked)).startswith("file:")


def test_policy_stops_what_would_leave_the_file_holds(show: Load) -> None:
    driver = show()
    blocked = driver.execute_async_script("""
        const done = arguments[arguments.length - 1];
        document.addEventListener("securitypolicyviolation",
            (event) => done(event.violatedDirective));
        fetch("http://127.0.0.1:9/").catch(() => setTimeout(() => done("none"), 2000));""")
    assert blocked.startswith("connect-src")
    driver.get_log("browser")


def fits(driver: WebDriver) -> None:
    for width in (360, 768, 1280):
        resize(driver, width)
        assert driver.execute_script("return document.documentElement.scrollWidth") <= width, width


def test_every_formula_is_drawn_and_nothing_scrolls_sideways_holds(show_whole: Load) -> None:
    driver = show_whole()
    fits(driver)
    driver.execute_script(
        "document.querySelectorAll('details').forEach((box) => { box.open = true; })"
    )
    count, wrong = driver.execute_script("""
        const found = [...document.querySelectorAll("math")];
        const flat = found.filter((one) => {
            const box = one.getBoundingClientRect();
            return !(box.width > 0 && box.height > 0)
            || one.namespaceURI !== "http://www.w3.org/1998/Math/MathML"; });
        return [found.length, flat.slice(0, 5).map((one) => one.outerHTML)];""")
    assert count > 5000 and wrong == []
    fits(driver)


def test_verdict_filter_shows_these_claims_only_holds(show: Load) -> None:
    driver = show()
    assert shown(driver) == with_verdict(
        "holds", "misprint", "false", "gap", "ambiguous", "simulated", "unknown"
    )
    for word in ("gap", "false"):
        find(driver, f"input[value={word}]").click()
    assert shown(driver) == with_verdict("gap", "false")
    assert (
        named(driver, "shown").text
        == f"{len(with_verdict('gap', 'false'))} of {len(some_contents().entries)} claims shown"
    )
    assert driver.current_url.endswith("#?verdict=false,gap")
    assert not driver.execute_script(
        "return [...document.querySelectorAll('.of-section:not([hidden])')].some("
        "(one) => !one.querySelector('article.claim:not([hidden])'))"
    )
    find(driver, "button[type=reset]").click()
    wait_for(driver, "return document.querySelectorAll('article.claim[hidden]').length === 0")


def test_section_filter_shows_this_section_only_holds(show: Load) -> None:
    from selenium.webdriver.support.ui import Select

    driver = show()
    Select(named(driver, "section")).select_by_value("A.2")
    assert shown(driver) == {
        entry.claim.id for entry in some_contents().entries if entry.claim.section == "A.2"
    }
    assert driver.current_url.endswith("#?section=A.2")


def test_search_finds_exactly_the_claims_with_all_words_holds(show: Load) -> None:
    driver = show("#claims")
    for words in ("energy", "ENERGY  impact", "\\lambda", "eq-37", "psatz", "no such word"):
        named(driver, "q").clear()
        named(driver, "q").send_keys(words)
        wanted = {
            name
            for name, text in words_of_claims().items()
            if all(word in text for word in words.lower().split())
        }
        wait_for(
            driver,
            "return document.getElementById('shown').textContent.startsWith(arguments[0] + ' of')",
            str(len(wanted)),
        )
        assert shown(driver) == wanted, words
        assert named(driver, "none").is_displayed() == (not wanted)


def test_shared_link_restores_the_filter_holds(show: Load) -> None:
    driver = show("#?verdict=misprint,false&section=4.3.1&q=impact")
    wanted = {
        entry.claim.id
        for entry in some_contents().entries
        if entry.verdict in ("misprint", "false")
        and entry.claim.section == "4.3.1"
        and "impact" in words_of_claims()[entry.claim.id]
    }
    assert wanted and shown(driver) == wanted
    assert named(driver, "q").get_property("value") == "impact"
    assert (
        find(driver, "input[value=misprint]").is_selected()
        and not find(driver, "input[value=holds]").is_selected()
    )


def test_nonsense_in_the_address_does_no_harm_holds(show: Load) -> None:
    driver = show("#?verdict=nonsense&section=Q&q=")
    assert len(shown(driver)) == len(some_contents().entries)
    for place in ("#%E0%A4%A", "#?verdict=%00&q=%", "#no-such-place", "#<script>", "#?", "#"):
        driver.execute_script("location.hash = arguments[0]", place)
    assert named(driver, "main").is_displayed()
    assert [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"] == []


def test_link_to_a_hidden_claim_shows_it_holds(show: Load) -> None:
    driver = show("#?verdict=false")
    assert not named(driver, "eq-37").is_displayed()
    driver.execute_script("location.hash = '#eq-37/bound'")
    wait_for(
        driver, "return document.getElementById('eq-37/bound').getBoundingClientRect().height > 0"
    )
    top = driver.execute_script(
        "return document.getElementById('eq-37/bound').getBoundingClientRect().top"
    )
    assert -1 <= top < 900


def test_tally_links_to_the_claims_of_a_verdict_holds(show: Load) -> None:
    driver = show()
    find(driver, ".tally a[href='#?verdict=gap']").click()
    wait_for(driver, "return location.hash === '#?verdict=gap'")
    wait_for(
        driver,
        "return document.querySelectorAll('article.claim:not([hidden])').length === arguments[0]",
        len(with_verdict("gap")),
    )


def is_open(driver: WebDriver, name: str) -> bool:
    return bool(
        driver.execute_script(
            "const box = document.getElementById(arguments[0]).getBoundingClientRect();"
            "return box.height > 20 && box.top < innerHeight && box.bottom > 0",
            name,
        )
    )


def test_node_of_the_tree_opens_its_statement_and_certificate_by_click_holds(show: Load) -> None:
    driver = show()
    link = find(driver, f"svg.tree a[href='#{PREMISE}']")
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", link)
    assert not is_open(driver, PREMISE)
    link.click()
    wait_for(
        driver,
        "return document.getElementById(arguments[0]).getBoundingClientRect().height > 20",
        PREMISE,
    )
    assert is_open(driver, PREMISE)
    text, certificate = [pre.text for pre in find_all(driver, f"[id='{PREMISE}'] pre")]
    assert text.startswith(
        "statement theorem-in-units/contracts.closer-1\n"
    ) and certificate.startswith('["proof",')


def test_node_of_the_tree_opens_by_keyboard_holds(show: Load) -> None:
    from selenium.webdriver.common.keys import Keys

    driver = show()
    link = find(driver, f"svg.tree a[href='#{RULE}']")
    driver.execute_script("arguments[0].focus()", link)
    outline = driver.execute_script(
        "return getComputedStyle(arguments[0].querySelector('rect')).strokeWidth", link
    )
    assert float(outline.removesuffix("px")) >= 3
    driver.switch_to.active_element.send_keys(Keys.ENTER)
    wait_for(
        driver,
        "return document.getElementById(arguments[0]).getBoundingClientRect().height > 20",
        RULE,
    )
    assert is_open(driver, RULE)
    assert driver.execute_script("return document.activeElement.id") == RULE
    driver.switch_to.active_element.send_keys(Keys.TAB)
    assert driver.execute_script(
        "return document.getElementById(arguments[0]).contains(document.activeElement)", RULE
    )


def test_first_key_leads_past_the_contents_and_is_seen_holds(show: Load) -> None:
    from selenium.webdriver.common.keys import Keys

    driver = show()
    find(driver, "body").send_keys(Keys.TAB)
    active = driver.switch_to.active_element
    assert active.text == "Skip to the report" and active.rect["x"] >= 0
    assert (
        driver.execute_script("return getComputedStyle(document.activeElement).outlineStyle")
        == "solid"
    )
    active.send_keys(Keys.ENTER)
    wait_for(driver, "return document.activeElement.id === 'main'")


def test_tree_is_legible_on_a_phone_holds(show: Load) -> None:
    driver = show()
    resize(driver, 360)
    size, wider = driver.execute_script(
        """
        const tree = document.querySelector("svg.tree");
        const text = tree.querySelector(".label");
        const shown = tree.parentElement;
        return [text.getBoundingClientRect().height, shown.scrollWidth > shown.clientWidth];"""
    )
    assert size >= 12 and wider


def test_text_and_badges_stand_out_holds(show: Load) -> None:
    driver = show()
    driver.execute_script(
        "document.querySelectorAll('details').forEach((box) => { box.open = true; })"
    )
    words = [f".badge.{word}" for word in some_contents().verdicts]
    texts = [
        "main p",
        "h1",
        "h2",
        "h3",
        "h4 a",
        "main a",
        ".place",
        ".aside",
        ".label",
        ".count",
        "small",
        "summary",
        "code",
        "pre",
        "dt",
        "dd",
    ]
    texts += [
        "nav a",
        "th",
        "td",
        "footer p",
        "legend",
        "button",
        "select",
        "input[type=search]",
        "b.certified",
        "b.refuted",
        "math",
    ]
    for name in ("light", "dark"):
        scheme(driver, name)
        for selector in [*texts, *words]:
            element = find(driver, selector)
            assert contrast(driver, element) >= 4.5, (name, selector)
        paper = driver.execute_script("return getComputedStyle(document.body).backgroundColor")
        dark = sum(map(int, paper.removeprefix("rgb(").removesuffix(")").split(", "))) < 200
        assert dark == (name == "dark")


def test_tree_stands_out_holds(show: Load) -> None:
    driver = show()
    for name in ("light", "dark"):
        scheme(driver, name)
        fills = driver.execute_script(
            """return ["text.title", "text.subtitle", "text.label", "rect.node", "rect.chip"].map(
            (one) => getComputedStyle(document.querySelector("svg.tree " + one))
                .fill.match(/[\\d.]+/g).map(Number))"""
        )
        from tests.reports.browser import luminance

        title, subtitle, label, node, chip = map(luminance, fills)
        for ink, paper in ((title, node), (subtitle, node), (label, chip)):
            assert (max(ink, paper) + 0.05) / (min(ink, paper) + 0.05) >= 4.5


def test_page_prints_with_derivation_and_rules_open_holds(show: Load, tmp_path: Path) -> None:
    driver = show()
    printed = base64.b64decode(
        driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})["data"]
    )
    assert printed.startswith(b"%PDF") and printed.count(b"/Type /Page\n") > 30
    if shutil.which("pdftotext") is None:
        pytest.skip("pdftotext is needed to read the printed page")
    (tmp_path / "printed.pdf").write_bytes(printed)
    text = subprocess.run(
        ["pdftotext", "-layout", str(tmp_path / "printed.pdf"), "-"],
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    assert "Every claim" in text and "weights" in text and "contraction" in text
    assert "Show all" not in text and "as the checker reads it" not in text and "psatz" not in text
    assert not driver.execute_script("return document.querySelectorAll('details[open]').length")


def test_claim_opens_to_its_statements_and_certificates_holds(show_whole: Load) -> None:
    driver = show_whole()
    before = driver.execute_script("return document.getElementsByTagName('*').length")
    assert before < 25_000
    box = find(driver, "[id='eq-37'] details")
    assert not find_all(driver, "[id='eq-37'] pre")
    driver.execute_script("arguments[0].scrollIntoView()", box)
    find(driver, "[id='eq-37'] summary").click()
    wait_for(driver, "return arguments[0].querySelectorAll('.statement pre').length > 0", box)
    drawn = driver.execute_script(
        "return [...arguments[0].querySelectorAll('math')].filter("
        "(one) => one.getBoundingClientRect().width > 0).length",
        box,
    )
    assert drawn > 5 and not find_all(driver, "[id='eq-37'] [data-part]")


def test_what_moves_moves_until_it_is_paused_holds(show: Load) -> None:
    driver = show(moving=True)
    place = (
        "return document.querySelector('#motion .moving .body').getBoundingClientRect().top"
        " + scrollY"
    )
    first = driver.execute_script(place)
    wait_for(driver, f"return ({place.removeprefix('return ')}) !== {first}")
    named(driver, "pause").click()
    assert driver.execute_script("return document.getElementById('motion').animationsPaused()")
    assert driver.execute_script(place) == driver.execute_script(place)


def test_what_moves_stands_still_where_no_motion_is_wanted_holds(show: Load) -> None:
    driver = show(moving=True)
    wanted = {"name": "prefers-reduced-motion", "value": "reduce"}
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": [wanted]})
    for name, displayed in ((".still .body", True), (".moving .body", False)):
        assert find(driver, f"#motion {name}").is_displayed() == displayed
    assert not named(driver, "pause").is_displayed()


def test_page_is_a_list_without_a_script_holds(show: Load) -> None:
    driver = show()
    driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    try:
        driver = show("#eq-37/bound", scripted=False)
        assert not named(driver, "filter").is_displayed()
        assert named(driver, "eq-37").is_displayed() and named(driver, "eq-37/bound").is_displayed()
        assert len(find_all(driver, "article.claim")) == len(some_contents().entries)
    finally:
        driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})

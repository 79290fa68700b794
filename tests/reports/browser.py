"""Pages as tests read them: strictly as text, and in a browser."""

from __future__ import annotations

import json
import re
import shutil
import zlib
from base64 import a85decode
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from html.parser import HTMLParser
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from selenium.webdriver.remote.webdriver import WebDriver
    from selenium.webdriver.remote.webelement import WebElement

# -------------------------------------------------------------------------------------------------
# A strict reader of HTML: every element is closed where it was opened, every attribute stands once.

VOID = frozenset({"meta", "link", "input", "br", "hr", "img"})


class NotNested(AssertionError):
    """An element ends where another one is open, or an attribute stands twice."""


@dataclass
class Element:
    tag: str
    attributes: dict[str, str]
    line: int
    children: list[Element | str] = field(default_factory=list)

    def text(self) -> str:
        return "".join(child if isinstance(child, str) else child.text() for child in self.children)

    def all(self, *tags: str) -> Iterator[Element]:
        for child in self.children:
            if isinstance(child, Element):
                if not tags or child.tag in tags:
                    yield child
                yield from child.all(*tags)

    def with_class(self, name: str) -> Iterator[Element]:
        return (one for one in self.all() if name in one.attributes.get("class", "").split())


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.root = Element("", {}, 0)
        self.open = [self.root]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        names = [name for name, _ in attrs]
        if len(names) != len(set(names)):
            raise NotNested(f"line {self.getpos()[0]}: an attribute of {tag} stands twice")
        element = Element(tag, {name: value or "" for name, value in attrs}, self.getpos()[0])
        self.open[-1].children.append(element)
        if tag not in VOID:
            self.open.append(element)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        if self.open[-1].tag != tag:
            raise NotNested(
                f"line {self.getpos()[0]}: </{tag}> while {self.open[-1].tag} of line"
                f" {self.open[-1].line} is open"
            )
        self.open.pop()

    def handle_data(self, data: str) -> None:
        self.open[-1].children.append(data)


def read_html(text: str) -> Element:
    """The document as a tree; raises NotNested where it is not one."""
    reader = _Reader()
    reader.feed(text)
    reader.close()
    if len(reader.open) != 1:
        raise NotNested(f"{reader.open[-1].tag} of line {reader.open[-1].line} is never closed")
    return reader.root


def parts_of(document: Element) -> dict[str, str]:
    """The parts of a page that stand in it as data, by name."""
    packed = next(one for one in document.all("script") if one.attributes.get("id") == "parts")
    data = json.loads(zlib.decompress(a85decode(packed.text().replace("v", "<"))))
    return {
        name: re.sub(r"#(\d+);", lambda number: data["shared"][int(number[1])], part)
        for name, part in data["parts"].items()
    }


def read_whole(text: str) -> Element:
    """The document with each part in its place, as the page's script puts it there; KeyError where
    one lacks.
    """
    document = read_html(text)
    parts = parts_of(document)
    for element in [document, *document.all()]:
        for at, child in enumerate(element.children):
            if isinstance(child, Element) and "data-part" in child.attributes:
                part = read_html(parts[child.attributes["data-part"]])
                part.tag = "div"
                element.children[at] = part
    return document


# -------------------------------------------------------------------------------------------------
# A headless Chromium that is driven over its own protocol; tests that need it are skipped, with the
# reason, where it is absent.

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
OPTIONS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
)


@contextmanager
def chromium(width: int = 1280, height: int = 900) -> Iterator[WebDriver]:
    """The driver of a browser with a window of this size."""
    pytest.importorskip("selenium", reason="selenium is not installed")
    program = next((found for found in map(shutil.which, NAMES) if found), None)
    server = shutil.which("chromedriver")
    if program is None or server is None:
        pytest.skip("chromium and chromedriver are needed to look at the page")
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service

    options = Options()
    options.binary_location = program
    for option in OPTIONS:
        options.add_argument(option)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(server))
    try:
        resize(driver, width, height)
        yield driver
    finally:
        driver.quit()


def resize(driver: WebDriver, width: int, height: int = 900) -> None:
    driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False},
    )


def scheme(driver: WebDriver, name: str) -> None:
    driver.execute_cdp_cmd(
        "Emulation.setEmulatedMedia",
        {"media": "", "features": [{"name": "prefers-color-scheme", "value": name}]},
    )


def requests(driver: WebDriver) -> list[str]:
    """The addresses that were asked for since the last time."""
    messages = [json.loads(entry["message"])["message"] for entry in driver.get_log("performance")]
    return [
        one["params"]["request"]["url"]
        for one in messages
        if one["method"] == "Network.requestWillBeSent"
    ]


# The colours of an element's text and of what lies behind it, as [red, green, blue] from 0 to 255.
COLOURS = """
const numbers = (colour) => colour.match(/[\\d.]+/g).map(Number);
const ink = numbers(getComputedStyle(arguments[0]).color);
let box = arguments[0], paper = [255, 255, 255, 1];
for (; box; box = box.parentElement) {
  const behind = numbers(getComputedStyle(box).backgroundColor);
  if (behind.length < 4 || behind[3] === 1) { paper = behind; break; }
}
return [ink.slice(0, 3), paper.slice(0, 3), ink.length < 4 || ink[3] === 1];
"""


def contrast(driver: WebDriver, element: WebElement) -> float:
    """The contrast ratio of WCAG 2: (lighter + 0.05) / (darker + 0.05) in relative luminance."""
    ink, paper, opaque = driver.execute_script(COLOURS, element)
    assert opaque
    one, other = luminance(ink), luminance(paper)
    return (max(one, other) + 0.05) / (min(one, other) + 0.05)


def luminance(colour: list[float]) -> float:
    parts = [part / 255 for part in colour]
    red, green, blue = (
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue

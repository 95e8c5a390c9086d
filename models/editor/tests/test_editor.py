"""The editor in a browser: it compiles what is typed, tells what is wrong with it, and writes the pages of
`mbs export page` to the byte. MBS is the program, EDITOR the page, BROWSER a Chromium."""

import os
import subprocess
import time
from pathlib import Path

import pytest
from playwright.sync_api import sync_playwright

MBS = os.environ["MBS"]
EDITOR = Path(os.environ["EDITOR"]).absolute()
# a driven mechanism, chaotic ones, a spline, friction, a chain in loops
MODELS = ["slider-crank", "double-pendulum", "cam-follower", "block-on-incline", "jansen", "n-pendulum-10"]
WRONG = """/// 𝛼 has two units of JavaScript's strings.
Crank {
    dof = 1;
    body wheel (phi) { /* 𝛼 */ inertia = 1 [kg]; }
    start { phi = 0; }
}
"""
DEEP = "Deep { dof = 1; param a = NESTED; body block (x) { mass = 1 [kg]; } start { x = 1 [m]; } }"


@pytest.fixture(scope="session")
def browser():
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=os.environ["BROWSER"], args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture
def editor(browser):
    editor = Editor(browser)
    yield editor
    # nothing was complained of, nothing was asked of a network
    assert editor.complaints == []
    assert [url for url in editor.requests if not url.startswith(("file:", "blob:", "data:", "about:"))] == []
    editor.page.close()


class Editor:
    def __init__(self, browser):
        self.page = browser.new_page(viewport={"width": 1400, "height": 900})
        self.complaints, self.requests = [], []
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(EDITOR.as_uri())
        self.until("document.querySelector('#export') && !document.querySelector('#export').disabled")
        self.rest()

    def until(self, condition):
        """Asked from outside, since the policy of the page lets nobody evaluate texts inside it."""
        end = time.monotonic() + 60
        while not self.page.evaluate(condition):
            assert time.monotonic() < end, (condition, self.complaints, self.state(), self.problems())
            self.page.wait_for_timeout(20)

    def rest(self):
        """Until what was typed is compiled, and its mechanism is there."""
        # longer than a pause in typing, after which compiling begins
        self.page.wait_for_timeout(400)
        self.until("document.querySelector('#state').textContent !== 'compiling…'")
        self.until("!document.querySelector('iframe.coming')")

    def write(self, text):
        self.page.fill("#text", text)
        self.rest()

    def choose(self, model):
        self.page.select_option("#examples", label=model)
        self.rest()
        return self.page.input_value("#text")

    def state(self):
        return self.page.inner_text("#state")

    def problems(self):
        return self.page.inner_text("#problems")

    def underlined(self):
        return self.page.locator(".shown .bad").all_inner_texts()

    def mechanism(self):
        """The frame of the mechanism."""
        return self.page.frames[-1]

    def download(self, button):
        with self.page.expect_download() as download:
            self.page.click(button)
        return download.value.path(), download.value.suggested_filename


def test_it_is_small_and_begins_with_a_mechanism(editor):
    assert EDITOR.stat().st_size < 3_000_000
    assert editor.mechanism().inner_text("h1") == "SliderCrank"
    assert editor.problems() == "" and editor.underlined() == []


@pytest.mark.parametrize("model", MODELS)
def test_pages_are_those_of_the_program_to_the_byte(editor, tmp_path, model):
    text = editor.choose(model)
    page, name = editor.download("#export")
    declaration = tmp_path / name.replace(".html", ".mbs")
    declaration.write_text(text)
    native = tmp_path / "native.html"
    subprocess.run([MBS, "export", "page", declaration, "--out", native], check=True)
    assert page.read_bytes() == native.read_bytes()


def test_every_example_moves(editor):
    options = editor.page.locator("#examples option").all_inner_texts()[1:]
    listed = subprocess.run([MBS, "list", "--json"], capture_output=True, text=True, check=True).stdout
    assert len(options) > 30 and all(f'"{name}"' in listed for name in options)
    for name in options:
        editor.choose(name)
        # its equations hold, and a step can be made
        frame = editor.mechanism()
        frame.click("#step")
        assert frame.evaluate("mechanism.run.t > 0") and frame.inner_text("#message") == "", name
        assert "Warning" in editor.problems() or editor.problems() == "", (name, editor.problems())


def test_an_error_is_underlined_and_found_by_a_click(editor):
    editor.write(WRONG)
    said = editor.problems()
    assert said.startswith("4:42  ") and "kg" in said, said
    # the token at fault, behind a letter that is two units of JavaScript's strings
    assert editor.underlined() == ["1"]
    assert editor.page.locator(".numbers .bad").all_inner_texts() == ["4\n"]
    # what was understood before stays, and says that it is old
    assert editor.mechanism().inner_text("h1") == "SliderCrank" and "last understood" in editor.state()
    editor.page.click(".problem button")
    field = editor.page.locator("#text")
    selected = field.evaluate("(it) => it.value.slice(it.selectionStart, it.selectionEnd)")
    assert selected == "1"
    editor.write(WRONG.replace("[kg]", "[kg*m^2]"))
    assert editor.problems() == "" and editor.underlined() == [] and editor.state() == ""
    assert editor.mechanism().inner_text("h1") == "Crank"


def test_what_plays_goes_on_playing_when_the_text_changes(editor):
    text = editor.choose("double-pendulum")
    frame = editor.mechanism()
    frame.select_option("#speed", "0.5")
    frame.click("#play")
    editor.write(text.replace("pub DoublePendulum", "pub Changed"))
    frame = editor.mechanism()
    assert frame.inner_text("h1") == "Changed"
    assert "Pause" in frame.inner_text("#play") and frame.input_value("#speed") == "0.5"


def test_times_are_those_of_the_fields(editor):
    editor.page.fill("#step", "2 ms")
    editor.page.press("#step", "Enter")
    editor.rest()
    assert editor.mechanism().evaluate("mechanism.run.h") == 0.002
    editor.page.fill("#step", "2 kg")
    editor.page.press("#step", "Enter")
    editor.rest()
    assert "step" in editor.problems() and "mass" in editor.problems(), editor.problems()


def test_a_file_is_opened_and_saved(editor, tmp_path):
    file = tmp_path / "own.mbs"
    file.write_text("/// Mine.\nOwn { dof = 1; body block (x) { mass = 1 [kg]; } start { x = 1 [m]; } }\n")
    editor.page.set_input_files("#file", file)
    editor.rest()
    assert editor.mechanism().inner_text("h1") == "Own"
    saved, name = editor.download("#save")
    assert name == "own.mbs" and saved.read_text() == file.read_text()


def test_keys_indent_and_the_keyword_at_the_caret_is_explained(editor):
    page = editor.page
    page.click("#text")
    page.keyboard.press("Control+A")
    page.keyboard.type("Own {\ndof = 1;\nbody block (x) { mass = 1 [kg]; }\n}\n")
    assert page.input_value("#text") == "Own {\n    dof = 1;\n    body block (x) { mass = 1 [kg]; }\n}\n"
    for _ in range(2):
        page.keyboard.press("ArrowUp")
    editor.until("document.querySelector('#keyword').textContent.includes('a rigid body')")
    # Escape, then Tab leaves the field
    page.keyboard.press("Escape")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.id") != "text"


@pytest.mark.parametrize("nested", ["(" * 120 + "1" + ")" * 120, "-" * 120 + "1", "sqrt(" * 120 + "1" + ")" * 120])
def test_formulas_may_nest_as_deep_as_in_the_program(editor, nested):
    """Browsers bound the stack of WebAssembly, and the compiler descends by recursion."""
    editor.write(DEEP.replace("NESTED", nested))
    assert editor.mechanism().inner_text("h1") == "Deep" and editor.problems() == ""


def test_what_nests_too_deep_for_the_browser_is_told(editor):
    editor.write(DEEP.replace("NESTED", "(" * 50000 + "1" + ")" * 50000))
    assert "nested too deeply" in editor.problems() or "nest" in editor.problems()
    editor.write(DEEP.replace("NESTED", "1"))
    assert editor.mechanism().inner_text("h1") == "Deep" and editor.problems() == ""


def test_texts_of_a_declaration_stay_texts(editor):
    editor.write(
        "/// </script><script>alert(1)</script><img src=x onerror=alert(2)>\n"
        "Hostile { dof = 1; body block (x) { mass = 1 [kg]; } start { x = 1 [m]; } }"
    )
    assert "<img" in editor.mechanism().inner_text("header p")
    assert editor.page.locator("img").count() == 0


def test_a_telephone_has_room_for_it(editor):
    editor.page.set_viewport_size({"width": 360, "height": 740})
    assert editor.page.evaluate("document.documentElement.scrollWidth") <= 360
    sizes = editor.page.evaluate("[...document.querySelectorAll('header button')].map((it) => it.offsetHeight)")
    assert min(sizes) >= 32

"""The page of `mbs export page` in a browser: it plays, changes, drags and downloads, with the numbers of
`mbs simulate` to the bit. MBS is the program, BROWSER a Chromium."""

import csv
import os
import signal
import subprocess
import time

import pytest
from playwright.sync_api import sync_playwright

MBS = os.environ["MBS"]
# a driven mechanism, chaotic ones, a spline, friction, springs, reduced states, stops that rub, a mode
MODELS = ["slider-crank", "double-pendulum", "cam-follower", "block-on-incline", "jansen", "reduced", "rough", "hooked"]
REDUCED = """Reduced {
    dof = 1; states = reduced;
    param length = 0.4 [m] where length > 0;
    input push [N];
    gravity = (0, -9.81) [m/s^2];
    body rod (x, y, theta) { mass = 1 [kg]; inertia = 1/12*length^2*1 [kg]; }
    point hinge on rod = (-length/2, 0);
    point end on rod = (length/2, 0);
    revolute pivot (rod.hinge, ground);
    force pushed on x = push;
    start { theta = 20 [deg]; }
    output height [mm] = y;
}"""
ROUGH = """Rough {
    dof = 3;
    gravity = (0, -9.81) [m/s^2];
    body block (x, y, phi) { mass = 3 [kg]; inertia = 0.05 [kg*m^2]; }
    point left on block = (-0.2 [m], -0.1 [m]);
    point right on block = (0.2 [m], -0.1 [m]);
    stop at_left: block.left.y >= 0 [m] { restitution = 0.3; friction = 0.4; along = block.left.x; }
    stop at_right: block.right.y >= 0 [m] { restitution = 0.3; friction = 0.4; along = block.right.x; }
    start { y = 0.17 [m]; phi = 0.3; der(x) = 1 [m/s]; der(phi) = 4 [rad/s]; }
}"""
HOOKED = """Hooked {
    dof = 1;
    body slide (x) { mass = 2 [kg]; }
    potential spring = 50 [N/m]*x^2/2;
    mode caught { constraint hook: x = 0.2 [m]; }
    when x > 0.2 [m] { enter caught; }
    when t > 0.8 [s] { leave caught; }
    start { x = -0.3 [m]; }
    output force [N] = lambda(hook);
}"""
TEXTS = {"reduced": REDUCED, "rough": ROUGH, "hooked": HOOKED}


@pytest.fixture(scope="session")
def browser():
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=os.environ["BROWSER"], args=["--no-sandbox"])
        yield browser
        browser.close()


class Opened:
    """The page of a model, and what it complained of."""

    def __init__(self, browser, folder, model, *options):
        self.folder, self.model = folder, model
        if model in TEXTS:
            self.model = folder / f"{model}.mbs"
            self.model.write_text(TEXTS[model])
        file = folder / f"{model}.html"
        subprocess.run([MBS, "export", "page", self.model, "--out", file, *options], check=True)
        self.page = browser.new_page(viewport={"width": 1200, "height": 900})
        self.complaints, self.requests = [], []
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(file.as_uri())
        self.until("!!globalThis.mechanism")
        assert [url for url in self.requests if not url.startswith(("file:", "blob:", "data:"))] == []

    def until(self, condition):
        """Asked from outside, since the policy of the page lets nobody evaluate texts inside it."""
        end = time.monotonic() + 60
        while not self.page.evaluate(condition):
            assert time.monotonic() < end, (condition, self.complaints, self.page.inner_text("#message"))
            self.page.wait_for_timeout(50)

    def play(self, rows):
        """Until there are so many rows."""
        self.page.select_option("#speed", "0.5")
        if "Play" in self.page.inner_text("#play"):
            self.page.click("#play")
        self.until(f"mechanism.rows.length >= {rows}")
        self.page.click("#play")
        assert "Play" in self.page.inner_text("#play")

    def set(self, name, text):
        self.page.fill(f"#{name}", text)
        self.page.press(f"#{name}", "Enter")

    def download(self, button):
        with self.page.expect_download() as download:
            self.page.click(button)
        return download.value.path()

    def rows(self):
        return table(self.download("#csv"))

    def native(self, end, *options):
        """The same of the program, with constant steps as in the page."""
        file = self.folder / "native.csv"
        command = [MBS, "simulate", self.model, "--end", repr(end), "--method", "heun", "--out", file, *options]
        # a doubt about the numbers of a run is a warning, with code 3
        assert subprocess.run(command, stdout=subprocess.DEVNULL).returncode in (0, 3)
        return table(file)

    def on_screen(self, body, point):
        """Pixels of a point of a body, on the page."""
        self.page.evaluate("scrollTo(0, 0)")
        box = self.page.locator("#scene").bounding_box()
        x, y = self.page.evaluate("([body, point]) => mechanism.pixels(body, point)", [body, point])
        return box["x"] + x, box["y"] + y


def table(path):
    with open(path, newline="") as file:
        head, *rows = csv.reader(file)
    return head, [[float(cell) for cell in row] for row in rows]


def same(found, native, at_least):
    """Every recorded row is one of the program's, to the bit."""
    (head, rows), (known_head, known) = found, native
    assert head == known_head
    by_time = {row[0]: row for row in known}
    assert len(rows) >= at_least
    for row in rows:
        if row[0] <= known[-1][0]:
            # as texts, in which numbers that are none are alike
            assert list(map(repr, row)) == list(map(repr, by_time[row[0]]))
    assert sum(row[0] <= known[-1][0] for row in rows) >= at_least


@pytest.mark.parametrize("model", MODELS)
def test_numbers_are_the_native_ones(browser, tmp_path, model):
    opened = Opened(browser, tmp_path, model)
    opened.play(300)
    head, rows = opened.rows()
    same((head, rows), opened.native(rows[-1][0]), 300)
    assert opened.complaints == [] and opened.page.inner_text("#message") == ""


def test_parameters_change_the_run_and_bad_ones_are_refused(browser, tmp_path):
    opened = Opened(browser, tmp_path, "double-pendulum")
    opened.set("parameters-length2", "0.35")
    opened.play(200)
    head, rows = opened.rows()
    same((head, rows), opened.native(rows[-1][0], "--set", "length2=0.35m"), 200)
    opened.set("parameters-length2", "-1")
    message = opened.page.inner_text("#message")
    native = subprocess.run(
        [MBS, "simulate", "double-pendulum", "--set", "length2=-1m"], capture_output=True, text=True
    ).stderr
    words = message.split(": ", 1)[1]
    assert "length2" in message and words and words in native, (message, native)
    # the run goes on with what it had
    assert opened.page.evaluate("mechanism.mechanism.parameters()[1]") == 0.35
    assert opened.complaints == []


def test_a_page_begins_with_the_values_that_were_set(browser, tmp_path):
    values = "--set", "length=30cm", "--input", "push=-2N"
    opened = Opened(browser, tmp_path, "reduced", *values)
    assert opened.page.input_value("#parameters-length") == "0.3" and opened.page.input_value("#inputs-push") == "-2"
    opened.play(100)
    head, rows = opened.rows()
    same((head, rows), opened.native(rows[-1][0], *values), 100)
    opened.page.click("#parameters button")
    assert opened.page.input_value("#parameters-length") == "0.4"
    assert opened.complaints == []


def test_what_holds_is_shown_and_its_changes_are_marked(browser, tmp_path):
    opened = Opened(browser, tmp_path, "hooked")
    page = opened.page
    assert page.inner_text("#time") == "t = 0.0000 s"
    caught = {}
    for row in opened.native(1.0)[1]:
        caught[row[0]] = row[-2]
    before = lambda t: caught[max(at for at in caught if at < t)]
    page.select_option("#speed", "0.2")
    page.click("#play")
    opened.until("mechanism.changes.length === 1")
    opened.until("document.getElementById('time').textContent.endsWith(' · caught')")
    opened.until("mechanism.changes.length === 2")
    page.click("#play")
    assert "caught" not in page.inner_text("#time")
    entered, left = page.evaluate("mechanism.changes")
    assert (before(entered), caught[entered]) == (0, 1) and (before(left), caught[left]) == (1, 0)
    page.click("#restart")
    assert page.evaluate("mechanism.changes") == []
    # hits are changes, too
    rough = Opened(browser, tmp_path, "rough")
    rough.page.click("#play")
    rough.until("document.getElementById('time').textContent.endsWith(' · at_left · at_right')")
    assert rough.page.evaluate("mechanism.changes.length") > 4
    assert opened.complaints == rough.complaints == []


def test_inputs_change_a_run_while_it_plays(browser, tmp_path):
    opened = Opened(browser, tmp_path, "reduced")
    opened.set("inputs-push", "3.5")
    opened.play(100)
    head, rows = opened.rows()
    same((head, rows), opened.native(rows[-1][0], "--input", "push=3.5N"), 100)


def test_a_body_at_rest_follows_the_pointer(browser, tmp_path):
    opened = Opened(browser, tmp_path, "double-pendulum")
    x, y = opened.on_screen(1, 2)
    mouse = opened.page.mouse
    mouse.move(x, y)
    mouse.down()
    mouse.move(x - 60, y - 80, steps=8)
    mouse.up()
    found = opened.on_screen(1, 2)
    assert abs(found[0] - x + 60) < 2 and abs(found[1] - y + 80) < 2
    # it keeps its constraints, at rest, and is where it plays on from
    assert opened.page.evaluate("mechanism.run.violation()") < 1e-12
    assert opened.page.evaluate("Math.max(...mechanism.run.v.map(Math.abs))") < 1e-12
    opened.play(50)
    assert opened.complaints == []


def test_a_spring_pulls_a_body_while_it_plays(browser, tmp_path):
    opened = Opened(browser, tmp_path, "double-pendulum")
    page, mouse = opened.page, opened.page.mouse
    page.select_option("#speed", "1")
    page.click("#play")
    x, y = opened.on_screen(1, 2)
    mouse.move(x, y)
    mouse.down()
    target = x - 120, y - 60
    mouse.move(*target, steps=5)
    page.wait_for_timeout(2500)
    found = opened.on_screen(1, 2)
    # the spring is damped: by then the end hangs near the pointer
    assert abs(found[0] - target[0]) < 40 and abs(found[1] - target[1]) < 40
    mouse.up()
    assert page.evaluate("mechanism.run.violation()") < 1e-6
    page.wait_for_timeout(300)
    # and the body falls again
    assert page.evaluate("Math.max(...mechanism.run.v.map(Math.abs))") > 0.05
    page.click("#restart")
    assert page.inner_text("#message") == "" and opened.complaints == []


def test_a_driven_mechanism_says_that_it_cannot_be_dragged(browser, tmp_path):
    opened = Opened(browser, tmp_path, "slider-crank")
    x, y = opened.on_screen(0, 0)
    opened.page.mouse.move(x, y)
    opened.page.mouse.down()
    opened.page.mouse.move(x + 30, y + 30, steps=3)
    opened.page.mouse.up()
    assert "no freedom" in opened.page.inner_text("#message")
    opened.play(20)
    assert opened.page.inner_text("#message") == ""
    assert opened.complaints == []


def test_keys_picture_and_equations(browser, tmp_path):
    opened = Opened(browser, tmp_path, "slider-crank")
    page = opened.page
    page.focus("#scene")
    page.keyboard.press("ArrowRight")
    after = page.evaluate("mechanism.run.t")
    assert after > 0
    page.keyboard.press("Space")
    opened.until(f"mechanism.run.t > {after}")
    page.keyboard.press("Space")
    page.keyboard.press("r")
    assert page.evaluate("mechanism.run.t") == 0 and len(opened.rows()[1]) == 1
    with open(opened.download("#png"), "rb") as file:
        assert file.read(8) == b"\x89PNG\r\n\x1a\n"
    page.click("summary")
    assert page.locator("math").count() > 10
    assert page.locator("math").first.bounding_box()["height"] > 10
    assert opened.complaints == []


def test_a_telephone_has_room_for_it(browser, tmp_path):
    opened = Opened(browser, tmp_path, "double-pendulum")
    opened.page.set_viewport_size({"width": 360, "height": 740})
    assert opened.page.evaluate("document.documentElement.scrollWidth") <= 360
    sizes = opened.page.evaluate("[...document.querySelectorAll('button')].map((it) => it.offsetHeight)")
    assert min(size for size in sizes if size) >= 32


@pytest.fixture
def watched(tmp_path):
    """A file, and the address at which it is followed."""
    file = tmp_path / "watched.mbs"
    file.write_text(REDUCED)
    program = subprocess.Popen([MBS, "watch", file, "--set", "length=30cm"], stdout=subprocess.PIPE, text=True)
    yield file, program.stdout.readline().split()[0]
    program.send_signal(signal.SIGINT)
    assert program.wait(10) == -signal.SIGINT


def test_a_watched_mechanism_can_be_played(browser, watched):
    file, address = watched
    page = browser.new_page()
    complaints = []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto(address)
    page.wait_for_selector("iframe[data-view=recorded]")
    page.click("#played")
    frame = page.frame_locator("iframe[data-view=played]")
    # it plays at once, from the values that were given
    frame.locator("#play", has_text="Pause").wait_for()
    assert frame.locator("#parameters-length").input_value() == "0.3"
    file.write_text(REDUCED.replace("Reduced {", "Changed {"))
    page.frame_locator("iframe:last-child").locator("h1", has_text="Changed").wait_for()
    # a save leaves it in this view, playing
    page.frame_locator("iframe[data-view=played]:last-child").locator("#play", has_text="Pause").wait_for()
    file.write_text(REDUCED.replace("dof = 1", "dof = 2"))
    page.wait_for_selector("#error:not([hidden])")
    assert "dof" in page.inner_text("#error") and complaints == []
    page.close()

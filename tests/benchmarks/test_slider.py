"""How fast a slider answers: pictures and books in the kernel, and in the browser from key press to after paint.

Goals, in JupyterLab: a step, and the angle of 15,000 strokes, under 20 ms in the median and 34 ms at the 95th percentile; a
constant whose book is not known yet under 60 ms in the median. A bare slider of ipywidgets with a bare text is measured beside
them.
"""

from __future__ import annotations

import itertools
import statistics

import pytest

from lsys_kit import draw, explore, read, system
from lsys_kit.classroom.panel.books.book import book
from lsys_kit.classroom.panel.view_model import ViewModel

WATCH = """async ([panel, changing]) => {
    window.latencies = [];
    let pressed = null;
    const painted = new MessageChannel();
    painted.port1.onmessage = () => {
        if (pressed !== null) window.latencies.push(performance.now() - pressed);
        pressed = null;
    };
    const told = () => painted.port2.postMessage(0); // its answer comes after the paint of the frame
    const press = (event) => { if (event.type === "keydown" && panel.contains(event.target)) pressed = event.timeStamp; };
    const stop = Event.prototype.stopImmediatePropagation; // the panel keeps its keys from later listeners, such as this one
    Event.prototype.stopImmediatePropagation = function () { press(this); stop.call(this); };
    window.addEventListener("keydown", press, true);
    const inFrame = changing.localName === "canvas"; // a canvas changes while its frame is made, a text before
    const watcher = new MutationObserver(() => (inFrame ? told() : requestAnimationFrame(told)));
    watcher.observe(changing, { attributes: true, childList: true, subtree: true, characterData: true });
}"""
FRAMES = """window.frames_seen = [];
const ask = window.requestAnimationFrame.bind(window);
let last = 0;
window.requestAnimationFrame = (act) => ask((time) => {
    const begun = performance.now();
    act(time);
    if (time !== last) window.frames_seen.push(0);
    window.frames_seen[window.frames_seen.length - 1] += performance.now() - begun;
    last = time;
});"""
"""How many milliseconds the scripts of a page work in each frame."""
BARE = """import ipywidgets
slider, text = ipywidgets.IntSlider(5, 0, 60), ipywidgets.HTML("5")
slider.observe(lambda change: setattr(text, "value", str(change["new"])), "value")
box = ipywidgets.VBox([slider, text])
box.add_class("lsys-panel")
text.add_class("bare")
box"""
GROWN = "c = 10 in 1 .. 60\nangle: 30\naxiom: A\nA -> F(c)[+A]F(1)[-A]A"
KEYS, FEW_KEYS = 40, 8
"""How many keys are pressed where numbers are asked for, and where it is only seen whether each is answered."""
PACE = 100
"""Milliseconds between two keys where numbers are asked for."""


@pytest.mark.parametrize(("id", "step"), [("J4", 15), ("K5", 4)])
def test_a_first_picture(benchmark, id, step):
    """A step that was never shown before: derive it and write its picture."""
    assert benchmark(lambda: draw(system(id), step).svg)


@pytest.mark.parametrize("id", ["J4", "K5", "K19", "P5"])
def test_a_book(benchmark, id):
    """All steps of a system for one setting of its constants, as the browser gets them."""
    assert benchmark(lambda: book(system(id)))["steps"] > 5


@pytest.mark.parametrize("id", ["J4", "K5"])
def test_a_panel(benchmark, id):
    """From the call to the panel."""
    assert benchmark(lambda: explore(id)).step


@pytest.mark.parametrize("step", [5, 7])
def test_a_plant_is_turned_in_the_kernel(benchmark, step):
    """The static picture of a plant in space from one side after the other: 363 and 3,279 segments."""
    study, sides = ViewModel(read("angle: 22.5\naxiom: A\nA -> [&FA]/(120)[&FA]/(120)[&FA]")), itertools.cycle(range(0, 360, 5))
    assert benchmark(lambda: study.sight(step, {}, around=next(sides), above=10).picture.svg)


@pytest.mark.parametrize(
    ("source", "name", "changing"),
    [
        ("explore('J4', 1)", "step", "canvas.lsys-canvas"),
        ("explore('K5', 1)", "step", "canvas.lsys-canvas"),
        ("explore('K5', 6)", "angle", "canvas.lsys-canvas"),
        ("explore('K19', 12)", "around", "canvas.lsys-canvas"),
        ("explore('K5', 3, show=['drawing', 'walk'])", "command", "canvas.lsys-canvas"),
        (f"explore(read({GROWN!r}), 5)", "c", "canvas.lsys-canvas"),
        (BARE, None, ".bare"),
    ],
    ids=["step of J4", "step of K5", "angle of 15,625 strokes", "side of K19", "walk", "a new constant", "bare"],
)
def test_from_key_press_to_after_paint(benchmark, open_notebook, write_notebook, source, name, changing):
    """In a real JupyterLab, at a pace of ten keys a second where numbers are asked for."""
    notebook = open_notebook(write_notebook("latency.ipynb", f"from lsys_kit import explore, read\n{source}"))
    notebook.run_all()
    panel = notebook.output(1).locator(".lsys-panel").first
    handle = panel.get_by_role("slider", name=f"{name}, slider", exact=True) if name else panel.locator(".noUi-handle")
    handle.focus()
    keys_pressed, pace = (KEYS, PACE) if benchmark.enabled else (FEW_KEYS, 0)
    notebook.page.wait_for_timeout(8 * pace)
    notebook.page.evaluate(WATCH, [panel.element_handle(), panel.locator(changing).element_handle()])

    def press_all():
        half = 4 if name == "step" and "K5" in source else keys_pressed // 2 - 2
        keys = ["ArrowRight"] * half + (["ArrowLeft"] * half if name != "c" else [])
        for key in keys * (keys_pressed // len(keys)):
            notebook.page.wait_for_timeout(pace)
            before = notebook.page.evaluate("latencies.length")
            handle.press(key)
            notebook.page.wait_for_function(f"latencies.length > {before}", timeout=5_000)

    benchmark.pedantic(press_all, rounds=1)
    found = sorted(notebook.page.evaluate("latencies"))
    median, slow = statistics.median(found), found[int(0.95 * len(found))]
    benchmark.extra_info |= {"median ms": round(median, 2), "95th percentile ms": round(slow, 2)}
    print(f"\n{name or 'bare'}: median {median:.1f} ms, 95th percentile {slow:.1f} ms of {len(found)}")


@pytest.mark.browser
@pytest.mark.parametrize(("id", "step"), [("J4", 14), ("K5", 4), ("K19", 7)])
def test_a_frame_of_the_unfolding(benchmark, browser, tmp_path, id, step):
    """At 60 frames a second a frame has 16.7 ms; K5 becomes its 3,125 strokes."""
    explore(id, step, show=["drawing", "unfolding"]).save(tmp_path / "page.html")
    page = browser.new_page(viewport={"width": 1440, "height": 900}, bypass_csp=True)
    page.add_init_script(FRAMES)
    page.goto((tmp_path / "page.html").as_uri())
    page.locator("canvas[data-drawn]").wait_for()
    frames = 100 if benchmark.enabled else 5

    def unfold():
        page.locator("[data-view=unfolding] .lsys-play").click()
        page.evaluate("frames_seen.length = 0")
        page.wait_for_function(f"frames_seen.length > {frames}")

    benchmark.pedantic(unfold, rounds=1)
    found = sorted(page.evaluate("frames_seen"))
    page.close()
    benchmark.extra_info |= {"median ms": round(statistics.median(found), 2)}
    print(f"\n{id}: median {statistics.median(found):.1f} ms of {len(found)} frames")

# SPDX-License-Identifier: GPL-3.0-or-later
"""browser_test.py WRITE_SAMPLE_RUN ICEPOST: report and sweep in headless Chromium.

Skipped (exit code 77) where Chromium, its driver, Selenium or Pillow are not installed.
"""
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

try:
    from PIL import Image
    from selenium import webdriver
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ImportError as error:
    print(f"skipped: {error} (apt-get install python3-selenium python3-pil)")
    sys.exit(77)
import page_layout

DRIVER = shutil.which("chromedriver")
BROWSER = shutil.which("chromium")
if not DRIVER or not BROWSER:
    print("skipped: no Chromium here (apt-get install chromium chromium-driver)")
    sys.exit(77)

WAIT = 60  # s, for a software renderer on a busy machine
WEBGL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
END = 4.49  # s, of the made-up run (tests/common/fixtures.hpp); its last frame is at 4.4 s


class Page:
    """A report or another page in a browser of its own, in a window `width` px wide."""

    def __init__(self, address, flags, width=1200):
        options = webdriver.ChromeOptions()
        options.binary_location = BROWSER
        # no name is resolved: whatever the page wanted from the network would fail
        for flag in ["--headless=new", "--no-sandbox", f"--window-size={width},900",
                     "--host-resolver-rules=MAP * ~NOTFOUND", *flags]:
            options.add_argument(flag)
        if width < 600:  # no window of a desk is so narrow
            options.add_experimental_option("mobileEmulation", {"deviceMetrics": {
                "width": width, "height": 844, "pixelRatio": 2.0}})
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(DRIVER), options=options)
        self.driver.get(address)
        self.wait(lambda: self.js("return !document.getElementById('run-meta')"
                                  " || document.documentElement.dataset.viewer || ''"))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait(self, condition):
        return WebDriverWait(self.driver, WAIT, poll_frequency=0.1).until(lambda _: condition())

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def state(self):
        return self.js("return document.documentElement.dataset.viewer")

    def clock(self):
        """Time that the 3D view shows [s]."""
        return float(self.find(".clock").text.split()[2])

    def picture(self):
        """The 3D view as it is drawn now."""
        return self.js("icepost.view.draw(); return document.querySelector('canvas').toDataURL()")

    def click_at(self, element, share):
        """Clicks into an element at a share of its width."""
        self.js("arguments[0].scrollIntoView({block: 'center'})", element)
        x = (share - 0.5) * element.size["width"]
        ActionChains(self.driver).move_to_element_with_offset(element, int(x), 0).click().perform()

    def check_quiet(self):
        faults = [entry["message"] for entry in self.driver.get_log("browser")
                  if entry["level"] in ("SEVERE", "WARNING")]
        assert not faults, faults
        assert self.js("return performance.getEntriesByType('resource').length") == 0
        wide, window = self.js("return [document.documentElement.scrollWidth, innerWidth]")
        assert wide <= window, f"the page is {wide} px wide in a window of {window} px"


def check_data(page):
    """What the script decoded is what the run holds: floe 1 on its way under the hull."""
    assert page.js("return [icepost.run.meta.floes, icepost.run.meta.frames]") == [6, 45]
    pose = page.js("""
        const { meta, arrays } = icepost.run;
        const at = (f, b) => [0, 1, 2].map((d) => arrays.position[(d * 6 + b) * 45 + f]
          * meta.position.scale[d] + meta.position.offset[d]);
        return [at(0, 0), at(44, 0), at(44, 5)];""")
    for got, wanted in zip(pose, [[8.5, -0.5, -0.08], [8.5, -0.5, -0.85], [10.7, 0.5, -0.85]]):
        assert all(abs(g - w) < 2e-3 for g, w in zip(got, wanted)), pose


def check_time(page):
    assert page.clock() == 0.0
    play = page.find('[name="play"]')
    play.click()
    page.wait(lambda: page.clock() > 0.3)
    play.click()
    stopped = page.clock()
    time.sleep(0.3)
    assert page.clock() == stopped, "pause does not stop"

    page.click_at(page.find('[name="time"]'), 0.5)
    assert abs(page.clock() - 0.5 * END) < 0.1 * END, page.clock()
    for chart, share in [("resistance", 0.25), ("force-z", 0.75), ("coverage", 0.1)]:
        page.click_at(page.find(f'[data-chart="{chart}"] .u-over'), share)
        span = 4.4 if chart == "coverage" else END
        assert abs(page.clock() - share * span) < 0.02 * END, (chart, page.clock())
    # every chart over time shows the instant
    assert page.js("return icepost.charts.length") >= 5
    assert page.js("return document.querySelectorAll('.now[hidden]').length") == 0


def check_pictures(page):
    page.js("icepost.playback.seek(2.5)")
    seen = {}

    def must_differ(name):
        # a machine with other work draws the frame later
        deadline = time.monotonic() + 60.0
        while (picture := page.picture()) in seen.values() and time.monotonic() < deadline:
            time.sleep(0.1)
        assert picture not in seen.values(), f"{name} shows nothing new: {list(seen)}"
        seen[name] = picture

    for button in page.driver.find_elements(By.CSS_SELECTOR, "[data-camera]"):
        page.js("arguments[0].scrollIntoView({block: 'center'})", button)
        button.click()
        must_differ(button.text)
    assert {"Top", "Side", "Front", "Below"} <= set(seen), list(seen)
    for name in ("ice", "hull"):
        select = Select(page.find(f'[name="{name}"]'))
        first = select.options[0].text
        for option in [o.text for o in select.options[1:]]:
            select.select_by_visible_text(option)
            must_differ(f"{name} by {option}")
        select.select_by_visible_text(first)
    for box in ("water", "through", "flow"):
        page.find(f'[name="{box}"]').click()
        must_differ(box)
        page.find(f'[name="{box}"]').click()
    assert page.picture() == seen["Below, oblique"], "controls set back do not restore the picture"
    page.find('[name="follow"]').click()
    page.js("icepost.playback.seek(4.4)")
    must_differ("not following")


def floe_colours(page):
    """The colours of the view from above at an instant, nothing of the water's plane on them."""
    shot = Image.open(io.BytesIO(page.find("canvas").screenshot_as_png)).convert("RGB")
    return {colour for count, colour in shot.getcolors(maxcolors=1 << 24) if count > 20}


def check_pieces(page):
    """Two pieces break off, at 1 and 2 s by 10 and 20 kN; the other floes stay unbroken ice."""
    assert page.js("return icepost.run.meta.floes") == 9, "four floes, two pieces, the sheet"
    born = page.js("return [...icepost.run.arrays.piece_born]")
    assert born == [-1, -1, -1, -1, 1, 2, -2, -2, -2], born
    assert page.js("return icepost.playback.time == icepost.playback.last"), "opens at its end"
    assert page.find('[name="ice"]').get_attribute("value") == "age"
    assert "just now" in page.find(".legend3d").text, "the colours' ends in words"
    assert page.js("return icepost.run.meta.pieces.load.scale_text") == "10"
    select = Select(page.find('[name="ice"]'))
    assert len(select.options) == 4, [o.text for o in select.options]
    for box in ("water", "through"):
        page.find(f'[name="{box}"]').click()
    page.find('[data-camera="top"]').click()
    for mode, title in (("age", "Time since it broke off"), ("breaking", "Load that broke it")):
        select.select_by_value(mode)
        legend = page.find(".legend3d").text
        assert title in legend and "unbroken" in legend, legend
        seen = []
        for moment in (0.5, 1.5, 4.0):  # none, one and both are broken off
            page.js("icepost.playback.seek(arguments[0])", moment)
            page.picture()
            seen.append(floe_colours(page))
        assert seen[1] - seen[0] and seen[2] - seen[1], f"{mode}: colours do not follow the pieces"


def check_screenshot(page):
    """The window shows hull, ice and water: many colours, none of them nearly everywhere."""
    page.js("document.querySelector('canvas').scrollIntoView()")
    shot = Image.open(io.BytesIO(page.find("canvas").screenshot_as_png)).convert("RGB")
    colours = shot.getcolors(maxcolors=1 << 24)
    most = max(count for count, _ in colours)
    assert len(colours) > 20 and most < 0.97 * shot.width * shot.height, (len(colours), most)


def check_drawings(page):
    """Top and side view, plots and tables that need no 3D."""
    titles = page.js("return [...document.querySelectorAll('#views svg > title')]"
                     ".filter((t) => t.parentElement.checkVisibility()).map((t) => t.textContent)")
    for view in ("From above", "From starboard", "From below"):
        assert any(title.startswith(view) for title in titles), titles
    charts = page.js("return icepost.charts.length")
    assert page.js("return document.querySelectorAll('.live canvas').length") == charts >= 5
    assert page.find("#load").text and page.find("#origin table").text


def check_layout(address, charts_with_numbers):
    for width in page_layout.WIDTHS:
        with Page(address, WEBGL, width) as page, tempfile.TemporaryDirectory() as folder:
            faults = page_layout.layout_faults(page)
            assert not faults, "\n".join([f"at {width} px:"] + faults)
            if width in (1400, 400):
                page_layout.check_buttons(page, folder, charts_with_numbers)
            page.check_quiet()


def write_sweep(folder, write_sample):
    """Runs at three speeds with two seeds in 3D, and two runs in 2D, as summaries alone."""
    subprocess.run([write_sample, os.path.join(folder, "run.h5"), "--summary"], check=True)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    for dimension, speed, seed in [(3, u, s) for u in (0.5, 1.0, 1.5) for s in (1, 2)] + [
            (2, 0.5, 1), (2, 1.0, 1)]:
        run = os.path.join(folder, "sweep", f"d{dimension}u{speed}s{seed}")
        os.makedirs(run)
        summary["dimension"] = dimension
        summary["resistance"]["mean_N"] = 100000.0 * speed + 1000.0 * seed
        with open(os.path.join(run, "summary.json"), "w", encoding="utf-8") as file:
            json.dump(summary, file)
        with open(os.path.join(run, "case.resolved.cfg"), "w", encoding="utf-8") as file:
            file.write(f"[simulation]\nseed = {seed}\ndimension = {dimension}\n"
                       f"[hull]\nspeed = {speed}\n")
    return os.path.join(folder, "sweep")


def main():
    write_sample, icepost = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        sweep = write_sweep(folder, write_sample)
        subprocess.run([icepost, "-q", "report", folder], check=True)
        check_layout("file://" + os.path.join(folder, "report.html"), True)
        subprocess.run([icepost, "-q", "sweep", sweep], check=True)
        check_layout("file://" + os.path.join(sweep, "sweep.html"), False)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([write_sample, os.path.join(folder, "run.h5")], check=True)
        subprocess.run([icepost, "-q", "report", folder], check=True)
        address = "file://" + os.path.join(folder, "report.html")
        with Page(address, WEBGL) as page:
            assert page.state() == "ready", page.state()
            check_data(page)
            check_time(page)
            check_pictures(page)
            check_screenshot(page)
            page.check_quiet()
        with Page(address + "#t=2&camera=top&ice=state", WEBGL, width=390) as page:
            assert page.state() == "ready" and page.clock() == 2.0
            check_screenshot(page)
            page.check_quiet()
        with Page(address + "#ice=age", WEBGL) as page:  # an address of another run
            assert page.js("return document.querySelectorAll('[name=ice] option').length") == 2
            page.check_quiet()
        with Page(address, ["--disable-3d-apis"]) as page:
            assert page.state() == "no-webgl", page.state()
            check_drawings(page)
            page.check_quiet()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([write_sample, os.path.join(folder, "run.h5"), "--pieces"], check=True)
        subprocess.run([icepost, "-q", "report", folder], check=True)
        with Page("file://" + os.path.join(folder, "report.html"), WEBGL) as page:
            assert page.state() == "ready", page.state()
            check_pieces(page)
            page.check_quiet()
    print("ok")


if __name__ == "__main__":
    main()

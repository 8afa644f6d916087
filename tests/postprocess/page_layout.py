# SPDX-License-Identifier: GPL-3.0-or-later
"""What must hold for every page in every window: nothing wraps that must not, nothing is cut, no
texts of a chart lie on each other, links lead somewhere, buttons give files.

page_layout.py PAGE...: checks pages that exist, e.g. the report of a real run.
"""
import os
import time
import xml.etree.ElementTree as xml

WIDTHS = (1400, 1024, 800, 400, 320)  # px
SMALLEST_TEXT = 8  # px on the screen, of a drawing's labels, in windows of 400 px and more

# each gives a list of faults
HEADLINES = """
return [...document.querySelectorAll('.card b')].filter((b) => {
  const line = parseFloat(getComputedStyle(b).lineHeight);
  return b.getBoundingClientRect().height > 1.5 * line || b.scrollWidth > b.clientWidth + 1;
}).map((b) => `the headline "${b.textContent}" wraps or is cut`);"""

TABLES = """
const faults = [];
for (const table of document.querySelectorAll('table')) {
  if (!table.checkVisibility()) continue;
  const wide = table.closest('.wide');
  const name = `the table of "${table.rows[0].textContent.slice(0, 40)}"`;
  const room = (wide ?? document.documentElement).getBoundingClientRect();
  const box = table.getBoundingClientRect();
  if (box.right <= room.right + 1 && room.right <= innerWidth) continue;
  if (!wide || !['auto', 'scroll'].includes(getComputedStyle(wide).overflowX))
    faults.push(`${name} is cut`);
  else if (room.right > innerWidth + 1) faults.push(`${name} scrolls outside of the window`);
  else if (!wide.previousElementSibling?.matches('.hint:not([hidden])'))
    faults.push(`${name} scrolls and nothing says so`);
}
return faults;"""

DRAWINGS = """
const smallest = arguments[0], faults = [];
for (const svg of document.querySelectorAll('svg[viewBox]')) {
  if (!svg.checkVisibility() || svg.parentElement.closest('svg')) continue;
  const name = `"${svg.querySelector('title')?.textContent}"`;
  const room = svg.getBoundingClientRect();
  if (room.width === 0) continue;
  if (room.right > innerWidth + 1 && !svg.closest('.legend, .opening'))
    faults.push(`${name} reaches out of the window`);
  const texts = [...svg.querySelectorAll('text')].filter((t) => t.textContent.trim())
    .map((t) => ({ text: t.textContent, box: t.getBoundingClientRect(),
      size: parseFloat(getComputedStyle(t).fontSize)
        * Math.hypot(t.getScreenCTM().a, t.getScreenCTM().b) }));
  // a line's box is taller than its letters
  const slack = (box) => Math.min(3, 0.2 * Math.min(box.width, box.height));
  texts.forEach(({ text, box, size }, k) => {
    if (size < smallest && innerWidth >= 400) faults.push(`${name}: "${text}" is tiny`);
    if (box.left < room.left - 1 || box.right > room.right + 1 || box.top < room.top - 2
        || box.bottom > room.bottom + 2) faults.push(`${name}: "${text}" is cut at the edge`);
    for (const other of texts.slice(k + 1)) {
      const gap = slack(box) + slack(other.box);
      const across = Math.min(box.right, other.box.right) - Math.max(box.left, other.box.left);
      const up = Math.min(box.bottom, other.box.bottom) - Math.max(box.top, other.box.top);
      if (across > gap && up > gap) faults.push(`${name}: "${text}" lies on "${other.text}"`);
    }
  });
}
return faults;"""

# uPlot draws its labels into a canvas: its own places tell
LIVE_CHARTS = """
const faults = [];
for (const chart of window.icepost?.charts ?? []) {
  const u = chart.plot, name = `"${chart.spec.title}"`;
  const [x, y] = u.axes;
  const width = (text) => { u.ctx.font = y.font[0]; return u.ctx.measureText(text).width
    / devicePixelRatio; };
  const widest = Math.max(0, ...(y._values ?? []).map((text) => width(text ?? '')));
  const room = y._size - (y.ticks.size + y.gap);
  if (widest > room + 1) faults.push(`${name}: labels of ${widest} px have ${room} px`);
  for (const text of y._values ?? [])
    if (/,/.test(text)) faults.push(`${name}: "${text}" has a comma`);
  if ((y._values ?? []).length === 0) faults.push(`${name} has no labels`);
  const places = (x._splits ?? []).map((v) => u.valToPos(v, 'x'));
  places.slice(1).forEach((p, k) => {
    if (p - places[k] < 0.5 * (width(x._values[k]) + width(x._values[k + 1])) + 2)
      faults.push(`${name}: labels of the time lie on each other`);
  });
  if (u.width > innerWidth) faults.push(`${name} is wider than the window`);
}
for (const legend of document.querySelectorAll('.u-legend .u-value'))
  if (legend.checkVisibility() && /^[-\\u2013]*$/.test(legend.textContent))
    faults.push('a legend has placeholders in place of values');
return faults;"""

LINKS = """
return [...document.querySelectorAll('a[href^="#"]')]
  .filter((a) => !document.getElementById(decodeURIComponent(a.getAttribute('href').slice(1))))
  .map((a) => `the link ${a.getAttribute('href')} leads nowhere`);"""

PAGE = """
const wide = document.documentElement.scrollWidth;
return wide > innerWidth ? [`the page is ${wide} px wide in a window of ${innerWidth} px`] : [];"""


def layout_faults(page):
    """Faults of a page in its window, each as a sentence."""
    time.sleep(0.3)  # observers of sizes have been told
    page.js("document.querySelectorAll('details').forEach((d) => { d.open = true; });")
    faults = []
    for script in (PAGE, HEADLINES, TABLES, DRAWINGS, LIVE_CHARTS, LINKS):
        faults += page.js(script, SMALLEST_TEXT)
    peaks = page.driver.find_elements("css selector", '[name="peaks"]')
    if peaks and peaks[0].is_displayed():
        page.js("arguments[0].click()", peaks[0])
        faults += [f"with peaks: {fault}" for fault in page.js(LIVE_CHARTS)]
        page.js("arguments[0].click()", peaks[0])
    return faults


def wait_for_file(folder, ending):
    end = time.monotonic() + 20
    while time.monotonic() < end:
        names = [n for n in os.listdir(folder) if n.endswith(ending)]
        if names and os.path.getsize(os.path.join(folder, names[0])) > 0:
            return os.path.join(folder, names[0])
        time.sleep(0.1)
    raise AssertionError(f"no {ending} was saved: {os.listdir(folder)}")


def check_buttons(page, folder, charts_with_numbers):
    """The first visible button of each kind gives a file that is what its name says."""
    page.driver.execute_cdp_cmd("Browser.setDownloadBehavior",
                                {"behavior": "allow", "downloadPath": folder})
    press = """
      const found = [...document.querySelectorAll(arguments[1])].find((b) => !b.hidden
        && b.checkVisibility() && b.textContent === arguments[0]);
      if (found) found.click();
      return Boolean(found);"""

    def saved(kind, where):
        for name in os.listdir(folder):
            os.remove(os.path.join(folder, name))
        assert page.js(press, kind, where), f"no button {kind} in {where}"
        with open(wait_for_file(folder, "." + kind.lower()), "rb") as file:
            return file.read()

    drawing = ":is(.figures, .opening, .both) .save button"
    assert saved("PNG", drawing)[1:4] == b"PNG"
    assert xml.fromstring(saved("SVG", drawing)).tag.endswith("svg")
    rows = saved("CSV", ".wide + .save button").decode().splitlines()
    assert rows and "," in rows[0], rows
    if charts_with_numbers:
        rows = saved("CSV", "[data-chart] .save button").decode().splitlines()
        assert rows[0].startswith("time [s],") and len(rows) > 10, rows[:3]


def main(pages):
    from browser_test import Page, WEBGL  # the same browser
    bad = 0
    for path in pages:
        for width in WIDTHS:
            with Page("file://" + os.path.abspath(path), WEBGL, width) as page:
                for fault in layout_faults(page):
                    bad += 1
                    print(f"{path}, {width} px: {fault}")
    return 1 if bad else 0


if __name__ == "__main__":
    import sys
    sys.exit(main(sys.argv[1:]))

"""What holds of the page in every state: nothing overflows, thumbs reach what steers, axe-core finds nothing."""
import json

from .browser import LAPTOP, PHONE

LEAST_SCENE = 0.40  # of a phone's height
THUMB_PX = 44       # least height of what a thumb presses

# What is shown and sticks out of the window, though nothing scrolls it.
STICKING_OUT = """[...document.querySelectorAll("button, select, input, summary, p, h1, h2, span, canvas, progress")].filter((e) => {
  if (!e.checkVisibility()) return false;
  for (let p = e; p; p = p.parentElement) if (["auto", "scroll"].includes(getComputedStyle(p).overflowY) && p.scrollHeight > p.clientHeight) return false;
  const r = e.getBoundingClientRect();
  return r.width > 0 && (r.left < -1 || r.right > innerWidth + 1 || r.top < -1 || r.bottom > innerHeight + 1);
}).map((e) => e.id || e.textContent.slice(0, 30))"""
TOO_WIDE = """[document.scrollingElement, ...["panel", "library", "help"].map((id) => document.getElementById(id))]
  .filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => e.id || "page")"""
TOO_SMALL = """[...document.querySelectorAll("footer button, body > header button, footer select")].filter((e) => e.checkVisibility())
  .filter((e) => e.getBoundingClientRect().height < %d).map((e) => e.id)""" % THUMB_PX
SCENE_SHARE = "document.getElementById('scene').clientHeight / innerHeight"


def sizes(checks, state):
    """Laptop and phone; a picture of each."""
    browser = checks.browser
    for name, size in (("laptop", LAPTOP), ("phone", PHONE)):
        browser.resize(size)
        out, wide = browser.value(STICKING_OUT), browser.value(TOO_WIDE)
        checks.expect(not out and not wide, f"{state}, {name}: nothing overflows {out or ''} {wide or ''}")
        if size == PHONE:
            share = browser.value(SCENE_SHARE)
            checks.expect(share >= LEAST_SCENE, f"{state}, phone: the 3D view has {share:.0%} of the height")
            small = browser.value(TOO_SMALL)
            checks.expect(not small, f"{state}, phone: buttons are {THUMB_PX} px high {small or ''}")
        for scheme in ("dark", "light"):
            browser.scheme(scheme)
            axe(checks, f"{state}, {name}, {scheme}")
            checks.picture(f"{state}-{name}-{scheme}")
    browser.scheme("dark")
    browser.resize(LAPTOP)


def axe(checks, state):
    """All rules of axe-core, best practices too."""
    if checks.axe is None:
        return
    browser = checks.browser
    if not browser.value("typeof axe !== 'undefined'"):
        browser.value(checks.axe)
    found = json.loads(browser.value(
        "axe.run(document).then((r) => JSON.stringify({passes: r.passes.length, wrong: r.violations.map("
        "(v) => `${v.id}: ${v.nodes.map((n) => n.target.join(' ') + ' ' + n.any.map((a) => a.message).join('; ')).join(', ')}`)}))",
        wait=True))
    checks.violations += len(found["wrong"])
    checks.expect(not found["wrong"], f"axe, {state}: {found['passes']} rules pass {found['wrong'] or ''}")

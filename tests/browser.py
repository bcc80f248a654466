"""Pages in a real browser, without a driver: one page holds them all in frames and looks into each."""

import html
import json
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
AXE = ROOT / ".venv" / "axe" / "node_modules" / "axe-core" / "axe.min.js"
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
NO_BROWSER = "no Chromium on this machine: the pages were not looked at in a browser"
NO_AXE = "axe-core is not installed (npm install --prefix .venv/axe axe-core): the pages were not looked at"
LOOK = """
const found = [];
async function look(frame) {
  const page = frame.contentWindow, script = page.document.createElement("script");
  for (const details of page.document.querySelectorAll("details")) details.open = true;
  script.textContent = document.getElementById("axe").textContent;
  page.document.head.append(script);
  const { violations } = await page.axe.run(page.document);
  const root = page.document.documentElement;
  const wide = [];
  if (root.scrollWidth > frame.clientWidth) {
    for (const one of page.document.querySelectorAll("main *")) {
      const inside = one.closest(".scroll, .stack, pre");
      if (!inside && one.getBoundingClientRect().right > frame.clientWidth) wide.push(one.outerHTML.slice(0, 120));
    }
  }
  const told = violations.map((one) => [one.impact, one.id, one.nodes.slice(0, 3).map((node) => node.html.slice(0, 160))]);
  found.push({ name: frame.name, violations: told, wide });
}
window.addEventListener("load", async () => {
  for (const frame of document.querySelectorAll("iframe")) {
    try { await look(frame); } catch (error) { found.push({ name: frame.name, violations: [["critical", String(error), []]], wide: [] }); }
  }
  document.body.innerHTML = "";
  const told = document.createElement("pre");
  told.id = "found";
  told.textContent = JSON.stringify(found);
  document.body.append(told);
});
"""


def browser():
    """The command of the browser on this machine; the test is skipped where there is none."""
    for name in BROWSERS:
        if shutil.which(name):
            return name
    pytest.skip(NO_BROWSER)


def looked_at(folder, pages, widths, *options):
    """What axe-core finds on every page at every width, and whether it is wider than that.

    `pages` are names and texts; the result has "name width" as keys.
    """
    command = browser()
    if not AXE.exists():
        pytest.skip(NO_AXE)
    frames = []
    for name, text in pages.items():
        for width in widths:
            # A page's own policy would keep axe out.
            inside = html.escape(text.replace("Content-Security-Policy", "X-Policy"))
            frames.append(
                f'<iframe name="{name} {width}" width="{width}" height="900" style="border:0" srcdoc="{inside}"></iframe>'
            )
    axe = AXE.read_text(encoding="utf-8").replace("</script", "<\\/script")
    harness = folder / "harness.html"
    harness.write_text(
        f'<!doctype html><meta charset="utf-8"><body>{"".join(frames)}'
        f'<script type="text/plain" id="axe">{axe}</script><script>{LOOK}</script></body>',
        encoding="utf-8",
    )
    dumped = dom(command, folder, harness, *options)
    start = dumped.index('<pre id="found">') + len('<pre id="found">')
    told = json.loads(html.unescape(dumped[start : dumped.index("</pre>", start)]))
    return {one["name"]: one for one in told}


def dom(command, folder, page, *options):
    """The document of a page after its scripts ran."""
    ran = subprocess.run(
        [
            command,
            "--headless",
            "--no-sandbox",  # which needs rights that a container has not
            "--disable-gpu",
            "--disable-dev-shm-usage",
            f"--user-data-dir={folder / 'profile'}",
            "--virtual-time-budget=600000",
            "--dump-dom",
            *options,
            page.as_uri(),
        ],
        capture_output=True,
        text=True,
        timeout=300,
        check=True,
    )
    return ran.stdout

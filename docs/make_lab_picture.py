"""Writes `docs/figures/lab.png`: the lab with the hidden effect of a practice experiment found and fitted.

Needs Chromium; a minute.
"""

from __future__ import annotations

import io
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from rockref.discover.compare.models import baseline_model  # noqa: E402
from rockref.lab.page import write_page  # noqa: E402
from rockref.measure import load_experiment  # noqa: E402
from rockref.model.storage import write_bytes  # noqa: E402
from tests.acceptance.browser import Browser  # noqa: E402

WIDTH, HEIGHT = 1600, 1000
#: Decided: in the middle of the clatter between the first two main impacts, when two feet of one side carry the block.
FRAME = 352
PICTURE = ROOT / "docs" / "figures" / "lab.png"


def taken() -> bytes:
    """Return the picture as PNG, of 255 colours, so that it stays below 250 kB."""
    experiment = load_experiment(ROOT / "data" / "experiments" / "mystery-04")
    with tempfile.TemporaryDirectory() as folder:
        page = write_page(Path(folder) / "lab.html", baseline_model(experiment), experiment)
        with Browser(Path(folder) / "profile", WIDTH, HEIGHT) as browser:
            browser.open(page)
            ready = "document.body.dataset.state === 'ready'"
            browser.evaluate(
                f"new Promise(r => {{ const look = () => {ready} ? r() : setTimeout(look, 50); look(); }})"
            )
            browser.click("document.getElementById('e-gyro_misalignment')")
            browser.evaluate("lab.fit()")
            browser.evaluate(f"lab.seek({FRAME})")
            browser.resize(WIDTH, HEIGHT)
            browser.evaluate("scrollTo(0, 0)")
            browser.settle()
            shot = browser.screenshot()
    picture = Image.open(io.BytesIO(shot)).convert("RGB").quantize(256, kmeans=2, dither=Image.Dither.NONE)
    out = io.BytesIO()
    picture.save(out, "PNG", optimize=True)
    return out.getvalue()


if __name__ == "__main__":
    write_bytes(PICTURE, taken())

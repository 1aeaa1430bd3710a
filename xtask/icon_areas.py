"""Areas of icons by rasters, for `cargo xtask corpora`: python3 xtask/icon_areas.py DIR [EVERY].

Reads DIR/icons/**/*.svg, every 13th or EVERYth, and writes DIR/icons-areas.csv. Needs cairosvg, pillow and numpy.
"""

import csv
import io
import pathlib
import re
import sys

import cairosvg
import numpy
from PIL import Image

folder = pathlib.Path(sys.argv[1])
every = int(sys.argv[2]) if len(sys.argv) > 2 else 13
SIDE = 800
files = sorted((folder / "icons").glob("**/*.svg"))[::every]
with open(folder / "icons-areas.csv", "w", newline="") as out:
    rows = csv.writer(out)
    rows.writerow(["file", "area"])
    for path in files:
        # What is painted counts, however thinly.
        text = re.sub(r'(fill-|stroke-)?opacity="0?\.\d*[1-9]\d*"', "", path.read_text())
        box = re.search(r'viewBox="([^"]*)"', text)
        _, _, width, height = map(float, box.group(1).replace(",", " ").split())
        scale = SIDE / max(width, height)
        size = {"output_width": round(scale * width), "output_height": round(scale * height)}
        png = cairosvg.svg2png(bytestring=text.encode(), **size)
        alpha = numpy.asarray(Image.open(io.BytesIO(png)).convert("RGBA"))[:, :, 3]
        area = alpha.sum() / 255 * width * height / alpha.size
        rows.writerow([path.relative_to(folder / "icons").as_posix(), area])

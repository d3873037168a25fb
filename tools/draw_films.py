#!/usr/bin/env python3
"""Draws the two films that open the manual: a day of a maize row, and a tree that grows.

    tools/draw_films.py day -o docs/images/day.webp
    tools/draw_films.py growth -o docs/images/growth.webp

The left half of a frame shows plants as the eye sees them, the right half the light that each organ
absorbs; both halves are one view. Needs Pillow, which Debian's matplotlib includes.
"""

import argparse
import io
import json
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "examples/07-grow"))

import film as growing  # noqa: E402  (the path is set above)

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
WIDTH, HEIGHT, STRIP = 680, 360, 56  # pixels
INK, SOFT, LINE = (20, 33, 27), (84, 97, 90), (135, 147, 140)
BAR, CHOSEN, TO_COME = (127, 145, 136), (15, 107, 70), (223, 229, 225)
SKY, HORIZON = (226, 234, 240), (245, 247, 244)  # behind the plants
VIRIDIS = [(68, 1, 84), (70, 50, 126), (54, 92, 141), (39, 127, 142), (31, 161, 135), (74, 193, 109),
           (160, 218, 57), (253, 231, 37)]
MAX_LIGHT = 110  # end of the scale, W m-2
MAX_BYTES = 395_000
# Only plants are coloured: paths from organs report no light for what is not measured.
METHOD = 'method = "from_organs"'
UNCOLOURED = "measured = false\n"


@dataclass
class Frame:
    """One picture of a film."""

    title: str
    light: float  # that the plants absorb
    realistic: Path
    by_light: Path
    brightness: float  # of the left half


class Program:
    """quasimc in a folder."""

    def __init__(self, folder, given):
        self.folder, self.path = Path(folder), growing.program_path(given)

    def __call__(self, *words):
        subprocess.run([self.path, *words], cwd=self.folder, check=True)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def result(self, name):
        return json.loads((self.folder / name).read_text(encoding="utf-8"))


def view(camera, fov):
    size = ["--size", f"{WIDTH}x{HEIGHT}", "--background", "transparent", "--no-annotations"]
    return [*size, "--camera", camera, "--fov", fov]


DAY = """
title = "A day of a maize row"
band = [{ name = "blue", from_nm = 400, to_nm = 500 },
        { name = "green", from_nm = 500, to_nm = 600 },
        { name = "red", from_nm = 600, to_nm = 700 }]
site = { latitude_deg = 51.97, longitude_deg = 5.67 }
time = { day = "2024-06-21", utc_offset_hours = 2 }
run = { paths = 8192, METHOD }
"""

PLANTS = """
[[material]]
name = "leaf"
reflectance = [0.035, 0.10, 0.05]
transmittance = [0.01, 0.08, 0.035]
[[material]]
name = "stem"
reflectance = [0.05, 0.14, 0.08]
[[material]]
name = "soil"
reflectance = [0.07, 0.11, 0.15]
"""


def maize_row():
    """Positions of plants in a row from west to east: a scattering of headings and sizes."""
    for i in range(13):
        heading = (0 if i % 2 == 0 else 180) + (37 * i) % 41 - 20
        yield f"[{0.2 * i - 1.2:.2f}, 0, 0, {heading}, {0.92 + 0.14 * ((7 * i) % 13) / 12:.3f}]"


def day_run():
    return (
        f'{DAY.replace("METHOD", METHOD)}output = {{ json = "day.json" }}\n'
        f'[ground]\nmaterial = "soil"\n{UNCOLOURED}x = [-1.55, 1.55]\ny = [-0.6, 0.6]\n'
        f'{PLANTS}[[geometry]]\nfile = "maize.obj"\nname = "maize"\n'
        f"at = [{', '.join(maize_row())}]\n"
    )


def absorbed(result):
    """The red light that all plants absorb; organs that are not measured have none."""
    return sum(organ["absorbed_flux"]["red"]["mean"] or 0 for organ in result["organs"])


def frame(quasimc, title, step, number, brightness=1.0):
    files = [quasimc.folder / f"{kind}_{number:02}.png" for kind in ("seen", "light")]
    return Frame(title, absorbed(step), *files, brightness)


def day_frames(quasimc):
    """A frame for each hour with light, dimmer where there is less."""
    shutil.copy(ROOT / "examples/04-first-canopy/maize.obj", quasimc.folder)
    quasimc.write("day.toml", day_run())
    quasimc("run", "day.toml", "--quiet")
    camera = view("188,9", "24")
    light = ["--band", "red", "--range", f"0,{MAX_LIGHT}"]
    quasimc("show", "day.json", "-o", "seen_%02d.png", "--realistic", *camera)
    quasimc("show", "day.json", "-o", "light_%02d.png", *light, *camera)
    steps = [step for step in quasimc.result("day.json")["time_steps"] if absorbed(step) > 0]
    most = max(absorbed(step) for step in steps)
    for i, step in enumerate(steps, start=1):
        brightness = 0.55 + 0.45 * (absorbed(step) / most) ** 0.5
        yield frame(quasimc, step["time"][11:16], step, i, brightness)


def growth_frames(quasimc):
    """A frame for each step of a tree, in the room of the last one."""
    quasimc("grow", str(ROOT / "examples/07-grow/tree.l"), "--series", ".", "--quiet")
    first, last = 3, 30
    for step in range(first, last + 1):
        text = "".join(growing.scene(growing.Film((step,), 1.6, 1.0)))
        text = text.replace("film.json", f"{step}.json")
        text = text.replace("paths = 65536", f"paths = 8192, {METHOD}")
        text = text.replace("[ground]\n", f"[ground]\n{UNCOLOURED}")
        quasimc.write(f"{step}.toml", text)
        quasimc("run", f"{step}.toml", "--quiet")
    for step in range(first, last + 1):
        camera = ["--frame", f"{last}.toml", *view("188,7", "24")]
        light = ["--band", "red", "--range", f"0,{MAX_LIGHT}"]
        for kind, colors in (("seen", ["--realistic"]), ("light", light)):
            quasimc("show", f"{step}.json", "-o", f"{kind}_{step:02}.png", *colors, *camera)
        yield frame(quasimc, f"step {step}", quasimc.result(f"{step}.json"), step)


def backdrop():
    """A pale sky."""
    column = Image.new("RGB", (1, HEIGHT + STRIP))
    for y in range(column.height):
        part = min(1, y / HEIGHT)
        column.putpixel((0, y), tuple(round(a + part * (b - a)) for a, b in zip(SKY, HORIZON)))
    return column.resize((WIDTH, column.height))


def darkened(image, brightness):
    *colors, alpha = image.split()
    return Image.merge("RGBA", [c.point(lambda v: round(v * brightness)) for c in colors] + [alpha])


def draw_strip(draw, frames, number):
    """The title, and a bar for each frame, as high as its light."""
    left, bottom, high = 118, HEIGHT + STRIP - 10, STRIP - 20
    most = max(one.light for one in frames)
    wide = (WIDTH - left - 20) / len(frames)
    draw.text((20, bottom - 26), frames[number].title, INK, ImageFont.truetype(FONT, 20))
    for i, one in enumerate(frames):
        x, y = left + i * wide, bottom - max(1, high * one.light / most)
        color = CHOSEN if i == number else BAR if i < number else TO_COME
        draw.rectangle((x, y, x + wide - 3, bottom), color)


def draw_labels(draw):
    font, y = ImageFont.truetype(FONT, 13), 14
    draw.text((20, y), "as the eye sees it", SOFT, font)
    draw.text((WIDTH - 20, y), "red light that each organ absorbs", SOFT, font, anchor="ra")
    small = ImageFont.truetype(FONT, 11)
    draw.text((WIDTH - 20, y + 31), f"{MAX_LIGHT} W m⁻²", SOFT, small, anchor="ra")
    draw.text((WIDTH - 20 - 24 * len(VIRIDIS), y + 31), "0", SOFT, small)
    for i, color in enumerate(VIRIDIS):
        left = WIDTH - 20 - 24 * (len(VIRIDIS) - i)
        draw.rectangle((left, y + 22, left + 23, y + 27), color)
    draw.line((WIDTH / 2, y, WIDTH / 2, HEIGHT - 8), LINE)


def composed(frames, number):
    one, picture = frames[number], backdrop()
    half = (0, 0, WIDTH // 2, HEIGHT), (WIDTH // 2, 0, WIDTH, HEIGHT)
    for box, path, brightness in zip(half, (one.realistic, one.by_light), (one.brightness, 1)):
        part = darkened(Image.open(path).convert("RGBA").crop(box), brightness)
        picture.paste(part, box[:2], part)
    draw = ImageDraw.Draw(picture)
    draw_labels(draw)
    draw_strip(draw, frames, number)
    return picture


def encoded(pictures, every):
    """An animated WebP of the best quality that is small enough; its last picture stays longer."""
    times = [every] * (len(pictures) - 1) + [8 * every]
    for quality in range(85, 20, -3):
        file = io.BytesIO()
        pictures[0].save(
            file, "WEBP", save_all=True, append_images=pictures[1:], duration=times, loop=0,
            quality=quality, method=6, kmax=1)
        if len(file.getbuffer()) <= MAX_BYTES:
            break
    return file.getvalue()


FILMS = {"day": (day_frames, 350), "growth": (growth_frames, 180)}  # milliseconds a frame


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("film", choices=FILMS)
    parser.add_argument("-o", "--output", required=True, help="animated WebP to write")
    parser.add_argument("--program", help="quasimc (default: the one built here)")
    arguments = parser.parse_args()
    frames_of, every = FILMS[arguments.film]
    with tempfile.TemporaryDirectory() as folder:
        frames = list(frames_of(Program(folder, arguments.program)))
        pictures = [composed(frames, i) for i in range(len(frames))]
    Path(arguments.output).write_bytes(encoded(pictures, every))


if __name__ == "__main__":
    main()

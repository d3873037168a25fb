#!/usr/bin/env python3
"""Draws a column of a table of organs and times over the day, a line for each organ, as SVG.

    plot_day.py hours.csv incident_upper_PAR day.svg
"""

import csv
import sys

WIDTH, HEIGHT, MARGIN = 720, 400, 60
COLOURS = (
    "#8c510a", "#66ccee", "#228833", "#ccbb44", "#ee6677", "#aa3377", "#aaaaaa", "#000000",
    "#4477aa", "#ff8800",
)


def read_table(path, column):
    """{organ: [(hour, value), ...]} of a CSV table of the program; its head is comments."""
    lines = {}
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            hour = int(row["time"][11:13]) + int(row["time"][14:16]) / 60
            lines.setdefault(row["name"], []).append((hour, float(row[column])))
    return lines


def draw(lines, title):
    """The picture of lines, as the text of an SVG file."""
    largest = max(value for points in lines.values() for _, value in points) or 1

    def place(hour, value):
        x = MARGIN + hour / 24 * (WIDTH - 3 * MARGIN)
        return f"{x:.1f},{HEIGHT - MARGIN - value / largest * (HEIGHT - 2 * MARGIN):.1f}"

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}"'
        ' font-family="sans-serif" font-size="13">',
        '<rect width="100%" height="100%" fill="white"/>',
        f'<text x="{MARGIN}" y="{MARGIN / 2}">{title}, largest {largest:.4g}</text>',
        f'<polyline points="{place(0, largest)} {place(0, 0)} {place(24, 0)}"'
        ' fill="none" stroke="black"/>',
    ]
    for hour in range(0, 25, 4):
        x, y = place(hour, 0).split(",")
        parts.append(f'<text x="{x}" y="{float(y) + 20}" text-anchor="middle">{hour} h</text>')
    for i, (name, points) in enumerate(lines.items()):
        colour = COLOURS[i % len(COLOURS)]
        path = " ".join(place(hour, value) for hour, value in sorted(points))
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}"/>')
        y = MARGIN + 20 * i
        parts.append(f'<text x="{WIDTH - 1.7 * MARGIN}" y="{y}" fill="{colour}">{name}</text>')
    return "\n".join([*parts, "</svg>", ""])


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    table, column, picture = sys.argv[1:]
    with open(picture, "w", encoding="utf-8") as file:
        file.write(draw(read_table(table, column), column))


if __name__ == "__main__":
    main()

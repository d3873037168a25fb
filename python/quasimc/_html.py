"""A result in a notebook."""

from __future__ import annotations

from html import escape

from ._format import pair
from ._units import shown

ROWS = 12


def _number(mean, error):
    return pair(mean, error).replace("\u00b1", "&plusmn;")


def _row(cells, tag="td"):
    return "<tr>" + "".join(f"<{tag}>{cell}</{tag}>" for cell in cells) + "</tr>"


def result_html(result):
    """HTML table of the first organs with the light they absorb, and the method."""
    light = result["absorbed_flux"]
    units = [f"absorbed {escape(b)} [{escape(u)}]" for b, u in light.units.items()]
    rows = [_row(["id", "organ", f"area [{escape(result.organs.length_unit)}2]", *units], "th")]
    for i in range(min(len(result.organs), ROWS)):
        cells = [int(result.organs.ids[i]), escape(result.organs.names[i])]
        cells.append(f"{result.organs.areas[i]:.4g}")
        cells += [
            _number(light.values[i, b], light.standard_error[i, b]) for b in range(len(light.bands))
        ]
        rows.append(_row(cells))
    left = len(result.organs) - ROWS
    more = f"<p>... and {left} more organs</p>" if left > 0 else ""
    facts = (
        f"{escape(result.run.method)}, {result.run.paths} paths &times; {result.run.replicates} replicates, "
        f"{escape(result.run.stop)}; &plusmn; standard error"
    )
    return f"<table>{''.join(rows)}</table>{more}<p>{facts}</p>"


def estimates_html(light):
    """HTML table of the first numbers with their errors."""
    keys = getattr(light.index, "keys", range(len(light) if light.ndim else 1))
    bands = light.bands if light.bands and light.ndim == 2 else ("",)
    if light.ndim > 2 or light.ndim == 0:
        return f"<p>{escape(repr(light))}</p>"
    if light.bands and light.ndim == 1:
        keys = light.bands
    heads = [f"{light.name} {band}".strip() for band in bands]
    units = [shown(unit) for unit in light._units * len(bands)][: len(bands)]
    axis = getattr(light.index, "axis", "")
    rows = [_row([axis, *(escape(f"{h} [{u}]" if u else h) for h, u in zip(heads, units))], "th")]
    numbers = light._values.reshape(len(light), -1, 4)
    for key, own in list(zip(keys, numbers))[:ROWS]:
        rows.append(_row([escape(str(key)), *(escape(pair(*one[:2])) for one in own)]))
    left = len(light) - ROWS
    more = f"<p>... and {left} more</p>" if left > 0 else ""
    return f"<table>{''.join(rows)}</table>{more}"

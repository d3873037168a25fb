"""A result in a notebook."""

from __future__ import annotations

from html import escape

ROWS = 12


def _number(mean, error):
    return f"{mean:.4g} &plusmn; {error:.1g}"


def _row(cells, tag="td"):
    return "<tr>" + "".join(f"<{tag}>{cell}</{tag}>" for cell in cells) + "</tr>"


def result_html(result):
    """HTML table of the first organs with the light they absorb, and the method."""
    light = result["absorbed_flux"]
    units = [f"absorbed {escape(b)} [{escape(u)}]" for b, u in zip(light.bands, light.unit)]
    rows = [_row(["id", "organ", f"area [{escape(result.organs.length_unit)}2]", *units], "th")]
    for i in range(min(len(result.organs), ROWS)):
        cells = [int(result.organs.ids[i]), escape(result.organs.names[i])]
        cells.append(f"{result.organs.areas[i]:.4g}")
        cells += [
            _number(light.mean[i, b], light.standard_error[i, b]) for b in range(len(light.bands))
        ]
        rows.append(_row(cells))
    left = len(result.organs) - ROWS
    more = f"<p>... and {left} more organs</p>" if left > 0 else ""
    facts = (
        f"{escape(result.method)}, {result.paths} paths &times; {result.replicates} replicates, "
        f"{escape(result.stop)}; &plusmn; standard error"
    )
    return f"<table>{''.join(rows)}</table>{more}<p>{facts}</p>"

"""Numbers with their errors as text."""

from __future__ import annotations

import math


def digits_after_point(error):
    """Digits that show an error in one digit, or two if it begins with 1 or 2."""
    power = math.floor(math.log10(error))
    return (1 if error / 10**power < 2.95 else 0) - power


def number(value):
    """A number without a known error: four significant digits."""
    if not math.isfinite(value) or value == 0:
        return f"{value:g}"
    return fixed(value, 3 - math.floor(math.log10(abs(value))))


def fixed(value, digits):
    """Rounded to a digit after the point, or before it; never in powers of ten."""
    return f"{round(value, digits):.{max(digits, 0)}f}"


def pair(value, error, spec=""):
    """ "812.4 ± 0.3"; "?" for an unknown error."""
    if spec:
        return f"{value:{spec}} \u00b1 {'?' if math.isnan(error) else format(error, spec)}"
    if math.isnan(value):
        return "?"
    if math.isnan(error):
        return f"{number(value)} \u00b1 ?"
    if not (math.isfinite(error) and error > 0):
        return f"{number(value)} \u00b1 {error:g}"
    digits = digits_after_point(error)
    return f"{fixed(value, digits)} \u00b1 {fixed(error, digits)}"

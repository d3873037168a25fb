"""Units as texts, "umol m-2 s-1"."""

from __future__ import annotations

import re

_FACTOR = re.compile(r"^([^\d\s^-]+)\^?(-?\d+)?$")
_RAISED = str.maketrans("-0123456789", "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079")


def _powers(unit):
    """Symbol -> power; None for a text of another form."""
    powers = {}
    for factor in unit.split():
        match = _FACTOR.match(factor)
        if not match:
            return None
        symbol, power = match.groups()
        powers[symbol] = powers.get(symbol, 0) + int(power or 1)
    return powers


def factors_of(unit):
    """Symbols of a unit with their powers: dict. Raises ValueError for a text of another form."""
    powers = _powers(unit)
    if powers is None:
        raise ValueError(f"the unit {unit!r} is not written as 'umol m-2 s-1'; see with_unit()")
    return powers


def product(a, b, power=1):
    """The unit of a times b to a whole power; "" if it can't be written."""
    left, right = _powers(a), _powers(b)
    if left is None or right is None or power != int(power):
        return ""
    for symbol, own in right.items():
        left[symbol] = left.get(symbol, 0) + own * int(power)
    return " ".join(f"{s}{'' if p == 1 else p}" for s, p in left.items() if p != 0)


def shown(unit):
    """As it is printed: "µmol m⁻² s⁻¹"."""
    powers = _powers(unit)
    if powers is None:
        return unit
    named = {re.sub("^umol", "\u00b5mol", s): p for s, p in powers.items()}
    return " ".join(f"{s}{'' if p == 1 else str(p).translate(_RAISED)}" for s, p in named.items())

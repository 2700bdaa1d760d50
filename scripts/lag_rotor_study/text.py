"""Numbers and tables as Markdown, and the list of checks."""
import math


def power(x):
    """3e4 -> '3·10⁴', 0.001 -> '10⁻³'."""
    exponent = math.floor(math.log10(x) + 1e-9)
    digits = str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    mantissa = round(x / 10.0 ** exponent, 3)
    return f"10{digits}" if mantissa == 1.0 else f"{mantissa:g}·10{digits}"


def number(error):
    return "n.c." if error is None else f"{error:.2e}"


def table(header, rows):
    lines = [header, ["---"] * len(header)] + rows
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines) + "\n"


class Checks:
    def __init__(self):
        self.rows, self.failed = [], 0

    def add(self, claim, passed, found):
        self.failed += not passed
        self.rows.append([claim, found, "passed" if passed else "**FAILED**"])


def close(found, expected, factor):
    """Both not converged, or their ratio within [1/factor, factor]."""
    if found is None or expected is None:
        return found is expected
    return 1.0 / factor <= found / expected <= factor

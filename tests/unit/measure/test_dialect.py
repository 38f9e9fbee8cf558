"""The dialect of a text table is told from its lines."""

import pytest

from rockref.measure.dialect import detect

ROWS = [[f"{0.001 * k:.3f}", f"{1.5 * k:.2f}", f"{-0.25 * k:.3f}"] for k in range(30)]


def lines(delimiter=",", decimal=".", *, facts=(), names=("time", "gx", "gy"), units=(), footer=(), end="", quote=""):
    """A table in a dialect."""
    body = [[f"{quote}{field.replace('.', decimal)}{quote}" for field in row] for row in ROWS]
    above = [list(row) for row in (names, units) if row]
    return [*facts, *(delimiter.join(row) + end for row in (*above, *body)), *footer]


CASES = {
    "plain": ({}, (",", ".", 0, 1)),
    "spreadsheet of a comma country": ({"delimiter": ";", "decimal": ","}, (";", ",", 0, 1)),
    "tabs": ({"delimiter": "\t"}, ("\t", ".", 0, 1)),
    "facts above": ({"facts": ["Device: X", "Rate: 1000 Hz", ""]}, (",", ".", 3, 4)),
    "units below the names": ({"units": ["s", "deg/s", "deg/s"]}, (",", ".", 0, 2)),
    "a separator line": ({"delimiter": ";", "facts": ["sep=;"]}, (";", ".", 1, 2)),
    "no names": ({"names": ()}, (",", ".", None, 0)),
    "a footer": ({"footer": ["# end", "Samples: 30"]}, (",", ".", 0, 1)),
    "a delimiter at the end": ({"delimiter": ";", "end": ";"}, (";", ".", 0, 1)),
    "quotes": ({"quote": '"'}, (",", ".", 0, 1)),
}


@pytest.mark.parametrize("case", CASES)
def test_a_dialect_is_told(case):
    form, (delimiter, decimal, header, first) = CASES[case]
    written = lines(**form)
    found = detect(written)
    assert (found.delimiter, found.decimal, found.header, found.first) == (delimiter, decimal, header, first)
    assert found.last == first + len(ROWS) - 1
    assert found.quoted == ("quote" in form)
    assert found.names[:3] == tuple(form.get("names", ("time", "gx", "gy")))
    assert found.units == tuple(form.get("units", ()))


def test_text_without_rows_of_numbers_has_no_dialect():
    assert detect(["a,b", "c,d"]) is None
    assert detect([]) is None

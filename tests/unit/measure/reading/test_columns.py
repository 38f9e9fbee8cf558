"""Column names say which quantity in which unit."""

import pytest

from rockref.measure.reading.columns import QUANTITIES, UNITS, full_names, parse_header
from rockref.model.errors import InputError


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_every_full_name_is_understood(quantity):
    for name in full_names(quantity):
        columns, width, notices = parse_header(f"other,{name}", "here", (quantity,))
        assert width == 2
        assert (columns[0].place, columns[0].name, columns[0].quantity) == (1, name, quantity)
        assert columns[0].factor == UNITS[QUANTITIES[quantity]][columns[0].unit]
        assert [n.code for n in notices] == ["W-COLUMN-UNREAD"]


def test_units_are_what_they_say():
    assert UNITS["rate"]["deg_s"] * 180.0 == pytest.approx(3.141592653589793, rel=1e-15)
    assert UNITS["time"] == {"s": 1.0, "ms": 1e-3, "us": 1e-6}


@pytest.mark.parametrize(("name", "near"), [("wx_deg/s", "wx_deg_s or wx_rad_s"), ("qw_rad", "qw"), ("x_cm", "x_m")])
def test_unknown_unit_names_the_known_ones(name, near):
    with pytest.raises(InputError) as caught:
        parse_header(f"t_s,{name}", "file, line 1", ("t",))
    assert caught.value.code == "E-UNIT"
    assert near in caught.value.cure


def test_a_quantity_that_only_begins_alike_is_another():
    columns, _, notices = parse_header("t_s,vx_m_s,temperature_c", "here", ("t",))
    assert [c.quantity for c in columns] == ["t"]
    assert len(notices) == 2


def refused(header, needed=("t",)):
    with pytest.raises(InputError) as caught:
        parse_header(header, "run.csv, line 1", needed)
    return str(caught.value)


EXAMPLE = "The first line names the columns, for example t_s,wx_deg_s,wy_deg_s,wz_deg_s. [E-HEADER]"
COMMAS = "Separate the columns by commas and write decimals with a point. [E-DELIMITER]"


@pytest.mark.parametrize(
    ("header", "said"),
    [
        ("t_s;wx_deg_s", f"the columns are separated by semicolons. {COMMAS}"),
        ("t_s\twx_deg_s", f"the columns are separated by tabs. {COMMAS}"),
        ("  # t_s,wx_deg_s", f"the first line is a comment. {EXAMPLE}"),
        ("t_s" + 64 * ",a", f"65 columns, more than 64. {EXAMPLE}"),
        ("0.0,1.5", f"the first line holds numbers ('0.0,1.5'). {EXAMPLE}"),
        ("t_s,wx", "column 'wx' names no unit. Name it wx_deg_s or wx_rad_s or wx_mrad_s. [E-UNIT]"),
        ("t_min", "column 't_min' has the unit 'min'. Name it t_s or t_ms or t_us. [E-UNIT]"),
        (
            "t_s,wx_deg_s,a,wx_rad_s",
            "columns 2 (wx_deg_s) and 4 (wx_rad_s) are the same quantity. Keep one of the two. [E-COLUMN-TWICE]",
        ),
        ("a,b", "no column t_s or t_ms or t_us. Add it, or rename the one that holds it. [E-COLUMN-MISSING]"),
    ],
)
def test_what_is_said_of_a_header(header, said):
    assert refused(header) == f"run.csv, line 1: {said}"


@pytest.mark.parametrize("stranger", ["gyro_wx_deg_s", "deg"])
def test_a_missing_column_is_looked_for_among_the_strangers(stranger):
    """Also after a column that is there, and where hardly more than half of the letters agree with its first name."""
    words = f"Add it, or rename the one that holds it. Is it the column '{stranger}'? [E-COLUMN-MISSING]"
    assert refused(f"t_s,{stranger}", ("t", "wx")).endswith(words)


def test_sixty_four_columns_are_not_too_many():
    columns, width, notices = parse_header("t_s" + 63 * ",a", "here", ("t",))
    assert (len(columns), width, len(notices)) == (1, 64, 63)


@pytest.mark.parametrize("header", ["t_s", "t_s,a;b", "t_s,a\tb"])
def test_one_column_or_odd_names_are_no_other_separator(header):
    columns, _, _ = parse_header(header, "here", ("t",))
    assert [(c.name, c.unit) for c in columns] == [("t_s", "s")]


def test_what_is_said_of_a_stranger():
    _, _, (notice,) = parse_header("t_s, note ", "run.csv, line 1", ("t",))
    assert str(notice) == "run.csv, line 1: column 'note' is not known. It was left unread. [W-COLUMN-UNREAD]"


def test_a_quaternion_has_no_unit_in_its_name():
    assert full_names("qw") == ["qw"] and full_names("wx") == ["wx_deg_s", "wx_rad_s", "wx_mrad_s"]
    assert "no column qy. Add it" in refused("t_s", ("qy",))

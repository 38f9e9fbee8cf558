"""Column names say which quantity in which unit."""

import pytest

from rockref.measure.columns import QUANTITIES, UNITS, full_names, parse_header
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

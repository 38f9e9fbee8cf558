"""Keys of TOML files: hostile text is refused, numbers arrive in SI."""

import math

import pytest

from rockref.measure.reading.schema import Number, Range, Section, Text, read_fields, read_toml
from rockref.model.errors import InputError
from tests.refusal import refused

FIELDS = (
    Number("noise", {"deg_s": math.pi / 180.0, "rad_s": 1.0}, 0.0, 2.0),
    Number("range", {"hz": 1.0}, 1.0, 1e6, required=False),
    Text("use", ("fit", "holdout")),
    Section("run", many=True, required=False),
)
GOOD = {"noise_deg_s": 90, "use": "fit"}


def test_numbers_arrive_in_si_and_absent_ones_as_none():
    found = read_fields(GOOD, FIELDS, "here")
    assert found == {"noise": pytest.approx(math.pi / 2.0, rel=1e-15), "range": None, "use": "fit", "run": None}


@pytest.mark.parametrize(
    ("change", "code", "where", "words"),
    [
        ({"noise_deg_s": "0.05"}, "E-TYPE", "noise_deg_s", "'0.05' is not a number"),
        ({"noise_deg_s": True}, "E-TYPE", "noise_deg_s", "not a number"),
        ({"noise_deg_s": [1]}, "E-TYPE", "noise_deg_s", "a list of 1"),
        ({"noise_deg_s": {"a": 1}}, "E-TYPE", "noise_deg_s", "a table"),
        ({"noise_deg_s": math.nan}, "E-RANGE", "noise_deg_s", "nan"),
        ({"noise_deg_s": math.inf}, "E-RANGE", "noise_deg_s", "inf"),
        ({"noise_deg_s": -1e-9}, "E-RANGE", "noise_deg_s", "outside 0 to 114.592"),
        ({"noise_deg_s": 10**5000}, "E-RANGE", "noise_deg_s", "more than forty digits"),
        ({"range_hz": -(10**5000)}, "E-RANGE", "range_hz", "more than forty digits"),
        ({"noise_rad_s": 1.0}, "E-KEY-TWICE", "here", "noise_deg_s and noise_rad_s"),
        ({"noise_rpm": 1.0}, "E-UNIT", "'noise_rpm'", "noise_deg_s or noise_rad_s"),
        ({"range": 5}, "E-UNIT", "'range'", "range_hz"),
        ({"use": "hold-out"}, "E-CHOICE", "use", "Did you mean holdout?"),
        ({"use": "zzz"}, "E-CHOICE", "use", "Known are fit, holdout."),
        ({"use": 3}, "E-TYPE", "use", "3 is not text"),
        ({"uze": "fit"}, "E-KEY-UNKNOWN", "'uze'", "Did you mean use?"),
        ({"zzzzzzzz": 1}, "E-KEY-UNKNOWN", "'zzzzzzzz'", "Known are"),
        ({"run": {}}, "E-TYPE", "run", "[[run]]"),
        ({"run": []}, "E-TYPE", "run", "a list of 0"),
        ({"run": [1]}, "E-TYPE", "run", "[[run]]"),
    ],
)
def test_wrong_values_are_refused_by_key(change, code, where, words):
    error = refused(read_fields, GOOD | change, FIELDS, "here")
    assert error.code == code
    assert where in error.where
    assert words in str(error)


@pytest.mark.parametrize("key", ["noise_deg_s", "use"])
def test_missing_keys_are_named(key):
    error = refused(read_fields, {k: v for k, v in GOOD.items() if k != key}, FIELDS, "here")
    assert error.code == "E-KEY-MISSING"
    assert key in error.what


def test_a_table_must_be_a_table():
    with pytest.raises(InputError, match="a list of 2 is not a table"):
        read_fields([1, 2], FIELDS, "here")


@pytest.mark.parametrize("value", [0.0, 2.0])
def test_ranges_are_inclusive(value):
    table = {"noise_rad_s": value, "use": "fit"}
    assert read_fields(table, FIELDS, "here")["noise"] == value


HOSTILE = {
    "not TOML": (b"a = \n", "E-TOML", "line 1"),
    "key twice": (b"a = 1\na = 2\n", "E-TOML", "line 2"),
    "deep list": (b"a = " + b"[" * 900 + b"]" * 90, "E-TOML", ""),
    "deep list over lines": (b"a = " + b"[\n" * 50_000 + b"]\n" * 50_000, "E-TOML", "deeply"),
    "deep inline tables": (b"a = " + b"{a = " * 190, "E-TOML", ""),
    "integer of 1000 digits": (b"a = [\n" + b"1" * 1000 + b"\n]", None, ""),
    "integer of 1001 digits": (b"a = [\n" + b"1" * 1001 + b"\n]", "E-TOML", "line 2"),
    "long line": (b"# " + b"x" * 3000 + b"\n", "E-TOML", "line 1"),
    "long dotted key": (b".".join([b"a"] * 5000) + b" = 1\n", "E-TOML", "characters"),
    "huge file": (b"# x\n" * 100_000, "E-SIZE", "262144 bytes"),
    "not UTF-8": (b"a = 'caf\xe9'\n", "E-ENCODING", "line 1"),
    "zero byte": (b"a = 1\0\n", "E-ENCODING", "line 1"),
    "empty": (b"\n\n", "E-EMPTY", "Compare it with the example"),
    "control character": (b"a = '\x07'\n", "E-TOML", "line 1"),
    "unclosed string": (b'a = "b\n', "E-TOML", "line 1"),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_toml(tmp_path, case):
    content, code, words = HOSTILE[case]
    path = tmp_path / "experiment.toml"
    path.write_bytes(content)
    if code is None:
        assert read_toml(path)[0]["a"][0] > 10**990
        return
    error = refused(read_toml, path)
    assert error.code == code
    assert words in str(error)


def test_many_dotted_keys_take_no_time(tmp_path):
    path = tmp_path / "experiment.toml"
    line = ".".join(["a"] * 480)
    path.write_text("".join(f"{line}.k{i} = 1\n" for i in range(250)))
    document, _ = read_toml(path)
    assert list(document) == ["a"]
    with pytest.raises(InputError, match="the key is not known"):
        read_fields(document, FIELDS, "here")


def test_a_range_is_two_numbers_in_si_the_lower_one_first():
    fields = (Range("height", {"mm": 1e-3}, -1.0, 1.0, required=False),)
    assert read_fields({"height_mm": [0, 0.2]}, fields, "here") == {"height": (0.0, pytest.approx(2e-4, rel=1e-15))}
    for value, code in ([0.2, 0.0], "E-RANGE"), ([1.0], "E-TYPE"), (1.0, "E-TYPE"), ([0, 5000], "E-RANGE"):
        error = refused(read_fields, {"height_mm": value}, fields, "here")
        assert error.code == code and "height_mm" in error.where

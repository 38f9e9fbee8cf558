"""Small files of records, in the layout of each format."""

import pytest


@pytest.fixture
def write(tmp_path):
    """A function that writes lines into a file and returns its path."""

    def file(name, *lines):
        path = tmp_path / name
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return path

    return file


@pytest.fixture
def esm(write):
    """A function that writes one component in the layout of ESM."""

    def file(values, stream="HNE", start="20190728_160905.700", **other):
        keys = {
            "EVENT_NAME": "",
            "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS": start,
            "SAMPLING_INTERVAL_S": "0.005000",
            "NDATA": len(values),
            "STREAM": stream,
            "UNITS": "cm/s^2",
            "PGA_CM/S^2": "",
            "DATA_TYPE": "ACCELERATION",
        } | other
        return write(f"{stream}.ASC", *(f"{key}: {value}" for key, value in keys.items()), *(f"{v:f}" for v in values))

    return file


@pytest.fixture
def at2(write):
    """A function that writes an AT2 file."""

    def file(
        *rows,
        sizes="NPTS= 7, DT= .00500 SEC",
        third="ACCELERATION TIME SERIES IN UNITS OF G",
        second="Somewhere, 1/1/2000, A Station, 140",
        name="a.AT2",
    ):
        return write(name, "PEER NGA STRONG MOTION DATABASE RECORD", second, third, sizes, *rows)

    return file

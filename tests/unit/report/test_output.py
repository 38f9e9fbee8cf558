"""Where a report is written: folders that cannot be used are refused before the work."""

import os

import pytest

from rockref.model.errors import InputError
from rockref.report.output import made_folder, usable_folder


def test_a_folder_is_made_with_those_above_it_when_something_is_written(tmp_path):
    path = tmp_path / "a" / "b"
    assert usable_folder(path) == path and not path.exists()
    assert made_folder(path).is_dir() and made_folder(path) == path


def test_what_is_in_the_way_of_a_folder_is_named(tmp_path):
    (tmp_path / "file").write_text("x")
    for refused in (usable_folder, made_folder):
        with pytest.raises(InputError, match="file") as error:
            refused(tmp_path / "file" / "out")
        assert error.value.code == "E-WRITE"


def test_a_folder_that_must_not_be_written_to_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(InputError, match="must not be written to") as error:
        usable_folder(tmp_path / "out")
    assert error.value.code == "E-WRITE" and not (tmp_path / "out").exists()

"""`rockref import`: what it refuses, what it hands on, and what it says."""

import pytest

from rockref.measure.importing import contactnets
from tests import command

run = command.of("import")


@pytest.fixture
def calls(monkeypatch):
    """What the import was called with; it finds four recordings, one a copy."""
    made = []
    monkeypatch.setattr(contactnets, "import_contactnets", lambda *a: made.append(tuple(map(str, a))) or (4, 1))
    return made


def test_recordings_and_copies_are_counted(capsys, calls):
    code, out, err = run(capsys, "contactnets", "clone", "-o", "tosses")
    assert (code, err) == (0, "") and calls == [("clone", "tosses")]
    assert out == "wrote tosses: 4 recordings, 1 of them turned copies of others\n"


def test_another_kind_is_refused_with_what_there_is(capsys, calls):
    code, out, err = run(capsys, "contactnet", "clone", "-o", "tosses")
    assert (code, out, calls) == (2, "", [])
    assert "'contactnet'" in err and "Use contactnets or planardrops. [E-CHOICE]" in " ".join(err.split())

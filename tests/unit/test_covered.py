"""The table of branches that tests take, from what coverage counted."""

import json

import pytest

from tests.covered import folders, main


def counted(covered: int, branches: int, missing=()):
    summary = {"covered_branches": covered, "num_branches": branches, "covered_lines": 9, "num_statements": 10}
    return {"summary": summary, "missing_branches": list(missing)}


FILES = {
    "rockref/cli.py": counted(0, 0),
    "rockref/model/contact.py": counted(8, 8),
    "rockref/model/points.py": counted(6, 10, [(12, 14), (12, -3), (40, 41), (7, 8)]),
}


def test_files_are_summed_by_folder():
    assert folders(FILES) == {"rockref": [0, 0, 9, 10], "rockref/model": [14, 18, 18, 20]}


@pytest.mark.parametrize(
    "line", ["rockref/model             14 of 18, 78 %", "60 % rockref/model/points.py: 7, 12, 40"]
)
def test_what_is_least_covered_is_named_with_its_lines(tmp_path, capsys, line):
    path = tmp_path / "coverage.json"
    path.write_text(json.dumps({"files": FILES}))
    main(str(path))
    shown = capsys.readouterr().out
    assert " ".join(line.split()) in " ".join(shown.split()) and "contact.py" not in shown

"""The page of the source's studies: a section for each that was made, with what it found."""

import pytest

from rockref.workflows import source_page
from tests.unit.report.page_checks import faults_of
from tests.unit.workflows import source_records as made

TITLES = {
    "response": "The response of Table 3.1", "sensitivity": "Sensitivity",
    "identification": "Identification on the control experiment", "twins": "Twin experiments",
    "reduction": "From 54 genes to 12", "scenarios": "The models that failed",
}  # fmt: skip
NAMES = (
    "figure_3_4_whole", "figure_3_4_zooms", "figure_3_5_time_step", "figure_3_6_last_digits",
    "figure_3_7_release_angle", "growth_of_differences", "twins", "reduction", "scenarios",
)  # fmt: skip
PICTURES = {name: b"\x89PNG" + name.encode() for name in NAMES}
LAST = "Where this comes from"


def page_of(*studies):
    results = {name: result for name, result in made.results().items() if name in studies}
    return source_page.source_page(results, PICTURES, {"engine": "made up"})


def test_all_studies_stand_in_their_order_on_a_page_that_keeps_the_rules():
    page = page_of(*TITLES)
    assert [s.title for s in page.sections] == [*TITLES.values(), LAST]
    text = page.html()
    assert faults_of(text) == [] and text.count("<figure") == len(NAMES) and "made up" in text
    for words in (
        "2 of 3 fits end at the noise floor", "4321 simulations with 54 genes; cost 0.0456",
        "3 came out of this search", "grows 10 times", "10000 simulations brought the cost to 0.1234",
    ):  # fmt: skip
        assert words in text, words


@pytest.mark.parametrize("study", TITLES)
def test_a_study_alone_has_its_section_and_no_other(study):
    assert [s.title for s in page_of(study).sections] == [TITLES[study], LAST]


def test_a_fact_without_a_number_in_the_source_has_no_verdict():
    assert [row[3] for row in source_page.facts_table(made.FACTS).rows] == ["yes", "no", ""]


def test_what_a_twin_does_not_determine_stands_in_brackets():
    table = source_page.twins_table(made.twins())
    first, last = (dict(zip(table.columns, row, strict=True)) for row in (table.rows[0], table.rows[2]))
    assert first["K_N"] == "(+0.50)" and first["theta_0"] == "+0.50" and last["theta_0"] == "+7.00"
    assert (first["seed"], first["chi2"], first["of the truth"], first["at floor"]) == ("1", "1.011", "1.022", "yes")
    assert last["at floor"] == "no" and first["trade off"].endswith("-0.87")


def test_groups_that_come_out_are_told_from_those_that_do_not():
    rows = source_page.reduction_table(made.reduction()).rows
    assert rows[0] == ["group 0", "2", "+0.81", "0.12", "0.05", "0.29", "yes"]
    assert [row[-1] for row in rows] == ["yes", "no"] * 3


def test_a_model_that_stays_out_of_its_plane_does_not_return():
    eight, four = source_page.scenarios_table(made.scenarios()).rows
    assert eight == ["eight points", "12", "0.021", "0.11", "0.22", "0.33", "from 7.3 s"]
    assert four[-1] == "no"

"""Every rule of the law has its one function, and the nomenclature page agrees with the code."""

import ast
import re

import pytest

from tests.shipped import ROOT

MODEL = sorted((ROOT / "rockref/model").glob("*.py"))
PAGE = (ROOT / "docs/reference/nomenclature.md").read_text(encoding="utf-8")

#: The rules, and the equation that a line of the function must carry at its margin, where the source numbers one.
RULES = {
    "G1": None, "G2": None, "P1": "(3.7)", "P2": "(3.8)", "P3": "(3.9)", "K1": None, "N1": "(3.5a)", "N2": "(3.5b)",
    "T1": "before (3.6)", "T2": "(3.6a)", "T3": "(3.6b)", "T4": None, "T5": None, "T6": "(3.6)",
    "A1": None, "B1": "B1", "A2": None, "A3": None, "I1": "I1", "I2": "I2", "I3": "I3", "I4": "I4", "I5": "I5",
    "M1": None,
}  # fmt: skip


def trees():
    return {path: ast.parse(path.read_text(encoding="utf-8")) for path in MODEL}


def rule_functions():
    """Rule id -> functions of rockref/model whose docstring begins with it."""
    found = {}
    for path, tree in trees().items():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef):
                match = re.match(r"Rule ([A-Z]\d+):", ast.get_docstring(node) or "")
                if match:
                    found.setdefault(match[1], []).append((path, node, node in tree.body))
    return found


FUNCTIONS = rule_functions()


@pytest.mark.parametrize("rule", RULES)
def test_every_rule_has_exactly_one_function(rule):
    assert len(FUNCTIONS.get(rule, [])) == 1


def test_no_rule_is_invented():
    assert set(FUNCTIONS) == set(RULES)


@pytest.mark.parametrize("rule", RULES)
def test_rules_are_short_plain_functions_at_module_level(rule):
    path, node, at_top = FUNCTIONS[rule][0]
    assert at_top
    assert not node.decorator_list
    body = node.body[1:]
    # "one rule = one function of 5 to 30 lines"; the docstring is not counted
    assert body[-1].end_lineno - body[0].lineno + 1 <= 30


@pytest.mark.parametrize("rule, equation", [(r, e) for r, e in RULES.items() if e])
def test_the_equation_stands_at_the_margin(rule, equation):
    path, node, _ = FUNCTIONS[rule][0]
    lines = path.read_text(encoding="utf-8").splitlines()[node.lineno - 1 : node.end_lineno]
    assert any(re.search(r"  # .*" + re.escape(equation), line) for line in lines)


@pytest.mark.parametrize("rule", [r for r in RULES if r[0] in "GPKNTABM"])
def test_docstrings_give_shapes_and_units(rule):
    text = ast.get_docstring(FUNCTIONS[rule][0][1])
    assert re.search(r"\((\.\.\.|n\b|3|8|4)", text) or rule in ("P1", "P2", "P3", "G1")
    # T2 gives truths, P3 gives numbers without unit
    assert re.search(r"\[[^\]]+\]", text) or rule in ("T2", "P3")


# --- the page


def rows():
    """Rows of the table: symbol, names in code, unit, frame, equation, rules."""
    for line in PAGE.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if line.startswith("|") and len(cells) == 6 and "`" in cells[1]:
            yield {
                "symbol": cells[0],
                "names": re.findall(r"`(\w+)`", cells[1]),
                "unit": cells[2],
                "frame": cells[3],
                "equation": cells[4],
                "rules": re.findall(r"[A-Z]\d", cells[5]),
            }


ROWS = list(rows())
NAMED = {name for row in ROWS for name in row["names"]}
FRAMES = {"plate", "body", "body → plate", "–"}
UNITS = {
    "–",
    "1",
    "m",
    "m/s",
    "m/s²",
    "rad",
    "rad/s",
    "rad/s²",
    "s",
    "kg",
    "kg m²",
    "kg m²/s",
    "N",
    "N m",
    "N/m",
    "N s/m",
    "deg/s",
}


def test_the_table_was_found():
    assert len(ROWS) > 40


def test_every_rule_is_on_the_page_and_no_other():
    assert {rule for row in ROWS for rule in row["rules"]} == set(RULES)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["names"][0])
def test_a_row_is_whole(row):
    assert row["symbol"]
    assert row["unit"] in UNITS
    assert row["frame"] in FRAMES
    assert row["rules"] or row["names"][0] in ("t", "theta_0")  # time and release angle stand in no rule


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["names"][0])
def test_names_occur_in_the_functions_of_their_rules(row):
    """For each rule of the row, at least one of its names is an argument, a variable, or a result of the function."""
    for rule in row["rules"]:
        _, node, _ = FUNCTIONS[rule][0]
        text = ast.unparse(node)
        assert any(re.search(rf"\b{name}\b", text) for name in row["names"]), (rule, row["names"])


def fields(path, name):
    for node in trees()[ROOT / "rockref/model" / path].body:
        if isinstance(node, ast.ClassDef) and node.name == name:
            return [item.target.id for item in node.body if isinstance(item, ast.AnnAssign)]
    raise LookupError(name)


@pytest.mark.parametrize(
    "path, name",
    [
        ("problem.py", "Block"),
        ("problem.py", "ContactPoints"),
        ("contact.py", "Kinematics"),
        ("parameters.py", "Parameters"),
    ],
)
def test_fields_of_the_arrays_are_on_the_page(path, name):
    # labels are words
    assert set(fields(path, name)) - {"names"} <= NAMED


def test_fields_of_the_state_are_on_the_page():
    # bookkeeping of the run: the clock in whole steps, and what effects remember
    assert set(fields("problem.py", "State")) - {"origin", "count", "memory"} <= NAMED


@pytest.mark.parametrize("rule", RULES)
def test_arguments_of_the_rules_are_on_the_page(rule):
    node = FUNCTIONS[rule][0][1]
    # `n` and `external` count and mark points
    assert {argument.arg for argument in node.args.args} - {"n", "external"} <= NAMED


def test_units_of_table_3_1_are_those_of_the_page():
    from rockref.model.parameters import TABLE_3_1

    unit = {name: row["unit"] for row in ROWS for name in row["names"]}
    for name, given in TABLE_3_1.items():
        assert unit[re.sub(r"^(delta_long)_\d$", r"\1", name)] == given.unit, name


def test_equations_are_those_of_the_functions():
    for row in ROWS:
        for rule in row["rules"]:
            if row["equation"] != "–" and RULES[rule] and RULES[rule].startswith("(3."):
                assert row["equation"].strip("()") in RULES[rule] or RULES[rule] in row["equation"], row

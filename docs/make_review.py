"""Write `docs/review.md` from the sources: ``python docs/make_review.py``.

For every rule of the law, in the order in which data flows: the equation, the code, what was decided, and what holds it
(unit and property tests that call it, test vectors and the mistakes that they were made to catch).
"""

from __future__ import annotations

import ast
import importlib
import inspect
import json
import re
from functools import cache
from pathlib import Path

from rockref.conformance.rules import RULES, Rule

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "review.md"
VECTORS = ROOT / "rockref" / "conformance" / "vectors" / "v1"
TESTS = ("tests/unit/model", "tests/property/model", "tests/acceptance")

#: The rules as a physicist writes them. The code below each is what is to be compared with it.
EQUATIONS = {
    "G1": r"J = \tfrac{m}{12}\,\mathrm{diag}(d^2 + h^2,\; b^2 + h^2,\; b^2 + d^2)",
    "G2": r"P_i^{ext} = (\pm\tfrac b2, \pm\tfrac d2, -\tfrac h2 + \delta_{long,i}), \quad"
    r" P_i^{int} = \Bigl(1 - \tfrac{2\,\delta_{diag}}{\sqrt{b^2 + d^2}}\Bigr)(\pm\tfrac b2, \pm\tfrac d2)"
    r"\ \text{at}\ z = -\tfrac h2",
    "P1": r"K_i^{(N)} = K^{(N)}, \quad K_i^{(T)} = K^{(T)} \quad \forall i \tag{3.7}",
    "P2": r"C = 2\,\beta\,\sqrt{K\,m} \tag{3.8}",
    "P3": r"\beta^{(T)} = \beta^{(N)} \tag{3.9}",
    "R1": r"\sum F_z = m g \ \text{on two pivots}, \quad \xi_i = \frac{m g}{2 K^{(N)}_i}, \quad v = 0,\ W = 0",
    "I1": r"x_{n+1} = x_n + h\,v_n + \tfrac12 h^2 a_n",
    "I2": r"\Theta = h\,W_n + \tfrac12 h^2 A_n, \quad A = J^{-1}(T - W \times J W)",
    "I3": r"\Lambda_{n+1} = \Lambda_n \exp(\hat\Theta)",
    "S1": r"F_{n+1} = F(x_{n+1}, \Lambda_{n+1}, v_n + h\,a_n, W_n + h\,A_n)",
    "K1": r"u = x + \Lambda P, \quad \dot u = v + (\Lambda W) \times \Lambda P, \quad"
    r" \xi = -u_z,\ \dot\xi = -\dot u_z,\ v_s = (\dot u_x, \dot u_y)",
    "N1": r"F^{(N)} = \max(K^{(N)} \xi + C^{(N)} \dot\xi,\ 0), \quad \xi \ge 0 \tag{3.5a}",
    "N2": r"F^{(N)} = 0, \quad \xi < 0 \tag{3.5b}",
    "T5": r"\xi < 0:\ \text{no anchor}; \quad s = u_t\ \text{where the point next touches}",
    "T1": r"F^* = -K^{(T)} (u_t - s) - C^{(T)} v_s",
    "T2": r"\text{sticking while}\quad \|F^*\| \le \mu_0 F^{(N)} \tag{3.6a}",
    "T6": r"\text{threshold} = \begin{cases} \mu_0 F^{(N)} & \text{it was sticking} \\"
    r" \mu F^{(N)} & \text{it was sliding} \end{cases} \tag{3.6}",
    "T3": r"F^{(T)} = \begin{cases} F^* & \text{sticking} \\"
    r" \mu F^{(N)} F^* / \|F^*\| & \text{sliding} \end{cases} \tag{3.6b}",
    "T4": r"s \leftarrow u_t + \bigl(F^{(T)} + C^{(T)} v_s\bigr) / K^{(T)}"
    r" \quad\Longleftrightarrow\quad -K^{(T)}(u_t - s) - C^{(T)} v_s = F^{(T)}",
    "A1": r"m\,a = \sum_i F_i - m g\,e_z",
    "B1": r"F_{B1} = -m\,a(t), \quad a(t) = a_k + (a_{k+1} - a_k)\tfrac{t - t_k}{\Delta t},"
    r" \quad t_k = t_0 + k\,\Delta t; \quad 0\ \text{outside of the record}",
    "A2": r"M = \sum_i (u_i - x) \times F_i",
    "A3": r"T = \Lambda^{\mathsf T} M",
    "I4": r"v_{n+1} = v_n + \tfrac h2 (a_n + a_{n+1})",
    "I5": r"J W_{n+1} = \exp(-\hat\Theta)\,[J W_n + \tfrac h2 T_n] + \tfrac h2 T_{n+1}",
    "S2": r"t_i = i\,h; \quad F_0\ \text{from the start itself}",
    "M1": r"W\,[\mathrm{deg/s}] = \tfrac{180}{\pi} W",
}

#: What the source has of the rules to which it gives no number.
SOURCES = {
    "G1": 'only "m is the mass of the block (54 kg)"; the formula is that of any uniform cuboid',
    "R1": "only that the block is released by a wire; the posture is decided",
    "I1": '"Simo\'s algorithm", without formulas; they are those of Simo and Wong (1991), doi:10.1002/nme.1620310103',
    "S1": "nothing; decided",
    "K1": "in words: penetration length, its time derivative and sliding velocity of each node",
    "T5": "nothing; decided",
    "T1": 'before (3.6): "a trial friction force corresponding to a sticking condition"',
    "T4": 'after (3.6): "both the friction force amplitude and the contact point position are updated"',
    "A1": "nothing; statics of a rigid body",
    "B1": "nothing; the second law of motion in axes that translate with the plate",
    "S2": "nothing; how a run starts and is recorded",
    "M1": "the axes of Fig. 3.4: convected rotational velocities (crv) in deg/s",
}
SOURCES |= dict.fromkeys(("I2", "I3", "I4", "I5"), SOURCES["I1"]) | dict.fromkeys(("A2", "A3"), SOURCES["A1"])

HEAD = r"""# The physics on one page

A rigid block with mass $m$ and inertia $J$ stands on a few points $P_i$ of its base. The state is its place $x$, its
rotation $\Lambda$, the rates $v$ and $W$ (in body axes), and for each touching point an anchor $s_i$ on the plate.

![The block on corners 1 and 2 with its axes; turned, on corners 3 and 4; its feet](figures/block.svg)

Each point $u = x + \Lambda P$ that is below the plate by $\xi = -u_z > 0$ pushes like a spring beside a damper, and
never pulls. Sideways a spring and a damper hold the point to its anchor; friction bounds that force (here with
$\mu_0 = \mu$), and a sliding point drags its anchor along:

$$
F^{(N)} = \max(K^{(N)} \xi + C^{(N)} \dot\xi,\ 0), \quad F^* = -K^{(T)} (u_t - s) - C^{(T)} v_s, \quad
F^{(T)} = F^* \min\bigl(1,\ \mu F^{(N)} / \|F^*\|\bigr)
$$

The forces of all points and the weight move the block, by the explicit scheme of Simo and Wong with a fixed step:

$$
m\,a = \sum_i F_i - m g\,e_z, \qquad J \dot W + W \times J W = \Lambda^{\mathsf T} \sum_i (u_i - x) \times F_i
$$

Below stands each rule of the law, in the order in which data flows through a step: the equation, the code that is it,
what had to be decided because the source is silent, and what holds the code to the equation. Every rule is one
undecorated function of the folder `rockref/model`. Symbols are those of [the nomenclature](reference/nomenclature.md).
The source is chapter 3 of a thesis, known here as an excerpt (`CITATION.cff`). Numbers like (3.5a) are its own; names
like K1 and T5 are those of this project. Layers of vectors: L0 parameters and geometry, L1 one contact point, L2 sums
and moments, L3 rotations, L4 single steps, L5s and L5 runs, L7 the measured channel.

This page is made from the code when the site is built."""


def source_of(rule: Rule) -> tuple[str, str, str]:
    """File, name and text of the function that is the rule."""
    module, name = rule.function.split(":")
    function = getattr(importlib.import_module(module), name)
    return module.replace(".", "/") + ".py", name, inspect.getsource(function)


def without_docstring(text: str) -> tuple[str, str]:
    """The code of a function without its docstring, and the docstring."""
    node = ast.parse(text).body[0]
    assert isinstance(node, ast.FunctionDef)
    first = node.body[0]
    lines = text.splitlines()
    return "\n".join(lines[: first.lineno - 1] + lines[first.end_lineno :]), ast.get_docstring(node) or ""


def decisions(docstring: str) -> list[str]:
    """The sentences of a text that say what was decided, or what the excerpt leaves open."""
    text = re.sub(r"\s+", " ", docstring)
    sentences = re.split(r"(?<=[.)]) (?=[A-Z])", text)
    found = [s.strip() for s in sentences if re.search(r"\b[Dd]ecided\b|\bexcerpt\b", s)]
    words = [re.sub(r"^Decided( \([^)]*\))?: ", "", s) for s in found]
    return [w[0].upper() + w[1:] for w in words]


def decided_constants() -> str:
    """The decisions that stand beside constants, and not in the function of a rule."""
    lines = ["## Decided once, for all rules"]
    for path in sorted((ROOT / "rockref" / "model").glob("*.py")):
        text = path.read_text(encoding="utf-8")
        for comment, name in re.findall(r"((?:^#:.*\n)+)^(\w+)", text, re.MULTILINE):
            words = re.sub(r"\s*\n#: ?", " ", comment[2:]).strip()
            if re.search(r"\b[Dd]ecided\b", words):
                lines.append(f"- `{name}` in `{path.relative_to(ROOT).as_posix()}`. {words}")
    return "\n".join([lines[0], "", *lines[1:]])


@cache
def calls(path: Path) -> dict[str, set[str]]:
    """Names that each test of a file uses, itself or through functions and fixtures of the same file."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    used: dict[str, set[str]] = {}
    tests = []
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names = {n.attr if isinstance(n, ast.Attribute) else n.id
                     for n in ast.walk(node) if isinstance(n, (ast.Attribute, ast.Name))}  # fmt: skip
            arguments = {a.arg for a in node.args.args} if isinstance(node, ast.FunctionDef) else set()
            used[node.name] = names | arguments
            machine = isinstance(node, ast.ClassDef) and any("StateMachine" in ast.unparse(b) for b in node.bases)
            if node.name.startswith("test_") or machine:
                tests.append(node.name)
    found = {}
    for test in tests:
        names = set(used[test])
        while more := {b for a in names & used.keys() for b in used[a]} - names:
            names |= more
        found[test] = names
    return found


def held_by(name: str) -> dict[str, list[str]]:
    """Test files and the tests in them that call the function `name`."""
    found = {}
    for folder in TESTS:
        for path in sorted((ROOT / folder).glob("test_*.py")):
            tests = [test for test, names in calls(path).items() if name in names]
            if tests:
                found[path.relative_to(ROOT).as_posix()] = tests
    return found


def vectors_of(rule: str) -> str:
    """Layers and numbers of the vectors of a rule, and the mistakes that they hunt."""
    manifest = json.loads((VECTORS / "MANIFEST.json").read_text(encoding="utf-8"))
    layers = []
    for path in sorted(VECTORS.glob("L*.json")):
        count = sum(entry.get("rule") == rule for entry in json.loads(path.read_text(encoding="utf-8"))["vectors"])
        if count:
            layers.append(f"{count} in {path.stem}")
    says = {key: value["says"] for key, value in manifest["mistakes"].items()}
    hunted = manifest["resolving_power"].get(rule, {}).get("hunts", [])
    if not layers:
        return "Vectors: none of its own; the runs of L5 go through it."
    return f"Vectors: {', '.join(layers)}. They catch: " + "; ".join(f"{says[z]} ({z})" for z in hunted) + "."


def section(rule: Rule) -> str:
    """The part of the page about one rule."""
    path, name, text = source_of(rule)
    code, docstring = without_docstring(text)
    parts = [f"## {rule.id}: {rule.says}", f"$$\n{EQUATIONS[rule.id]}\n$$"]
    parts.append(f"`{name}` in `{path}`. The source: {SOURCES.get(rule.id, rule.equation)}.")
    if docstring:
        parts.append("> " + docstring.split("\n\n")[0].replace("\n", " "))
    parts.append(f"```python\n{code}\n```")
    parts += [f"**Decided.** {sentence}" for sentence in decisions(docstring)]
    tests = held_by(name)
    # The run is called by nearly every trajectory test: those are listed once, at the end.
    if tests and rule.id != "S2":
        parts.append("Tests that call it:\n\n" + "\n".join(f"- `{p}`: {', '.join(t)}" for p, t in tests.items()))
    parts.append(vectors_of(rule.id))
    return "\n\n".join(parts)


def together() -> str:
    """The part of the page about tests of whole runs."""
    lines = ["## All rules together", "Tests of whole runs, which every rule has to pass through:"]
    for path in sorted([*(ROOT / "tests/property/model").glob("test_*.py"), *(ROOT / "tests/acceptance").glob("*.py"),
                        *(ROOT / "tests/golden").glob("test_*.py")]):  # fmt: skip
        tests = [t for t, names in calls(path).items() if {"simulate", "simulated"} & names]
        if tests and "commands" not in path.name and path.name not in ("test_demo.py", "test_bad_input.py"):
            first = (ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or "").split("\n")[0]
            lines.append(f"**`{path.relative_to(ROOT).as_posix()}`.** {first}\n\n" + ", ".join(tests) + ".")
    return "\n\n".join(lines)


def page() -> str:
    """The whole page."""
    return "\n\n".join([HEAD, *map(section, RULES), decided_constants(), together()]) + "\n"


def write() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    write()

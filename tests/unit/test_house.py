"""The house: what may import what, how long a file may be, what never stands in one."""

import ast
import inspect
import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from types import FunctionType

import grimp
import pytest

ROOT = Path(__file__).resolve().parents[2]
CODE = ("rockref", "golden", "tests", "benchmarks", "examples")
TEXT = {
    ".py",
    ".md",
    ".toml",
    ".cfg",
    ".txt",
    ".rst",
    ".json",
    ".yml",
    ".yaml",
    ".cff",
    ".html",
    ".j2",
    ".js",
    ".css",
    "",
}
# Absolute paths of one machine, and the folder beside the checkout. Written so that this line does not find itself.
MACHINE_PATH = re.compile(r"(?:^|[^\w.])/(?:wor[k]|roo[t]|tm[p]|far[m]|home/\w+)(?:/|\b)|\.\./share[d]")
# `Response.to_frame` hands out a pandas DataFrame, and loads pandas when it is called.
LENT = {"response.py": {"pandas"}}
EXPERIMENTS = [f"mystery-{number:02d}" for number in range(1, 12)]


def project_files() -> list[Path]:
    """Tracked files and those about to be; in an unpacked source archive, everything."""
    git = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    if git.returncode == 0:
        paths = [ROOT / name for name in git.stdout.split("\0") if name]
    else:
        paths = [path for path in ROOT.rglob("*") if not any(part.startswith(".venv") for part in path.parts)]
    return [path for path in paths if path.is_file()]


def source_files() -> list[Path]:
    return [path for path in project_files() if path.suffix == ".py" and path.relative_to(ROOT).parts[0] in CODE]


def loaded_by(statement: str) -> set[str]:
    """Top-level names, outside the standard library, that `statement` brings into a fresh interpreter."""
    code = f"import sys\nbefore = set(sys.modules)\n{statement}\nprint(*sorted(set(sys.modules) - before))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    return {name.partition(".")[0] for name in done.stdout.split()} - sys.stdlib_module_names


def imported_names(path: Path) -> set[str]:
    """Full names of the modules that the file imports, inside functions too."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            names.add("." * node.level + (node.module or ""))
    return names


def third_party(names: set[str]) -> set[str]:
    return {name.partition(".")[0] for name in names} - sys.stdlib_module_names - {"", "rockref"}


def test_model_loads_numpy_and_nothing_else():
    modules = [
        ".".join(path.relative_to(ROOT).with_suffix("").parts) for path in (ROOT / "rockref/model").rglob("*.py")
    ]
    assert "rockref.model.errors" in modules
    assert loaded_by("import " + ", ".join(modules)) <= {"numpy", "rockref"}


def test_model_text_names_numpy_and_nothing_else():
    for path in (ROOT / "rockref/model").rglob("*.py"):
        names = imported_names(path)
        assert third_party(names) <= {"numpy"} | LENT.get(path.name, set()), path
        ours = {name for name in names if name.partition(".")[0] == "rockref"}
        assert all(name.startswith("rockref.model") for name in ours), path


def test_import_rockref_is_light():
    assert loaded_by("import rockref") <= {"numpy", "rockref"}


def test_command_line_is_light():
    loaded = loaded_by("import rockref.cli; rockref.cli.application()")
    assert not loaded & {"scipy", "pandas", "matplotlib", "numba", "dask", "jinja2"}


def test_one_version_everywhere():
    import rockref

    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert rockref.__version__ == project["version"]
    assert f"\nversion: {project['version']}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")


def test_public_interface_is_annotated():
    import rockref

    missing = []
    for name in rockref.__all__:
        thing = getattr(rockref, name)
        functions = vars(thing).items() if inspect.isclass(thing) else [(name, thing)]
        for label, function in functions:
            function = inspect.unwrap(getattr(function, "__func__", function))
            if inspect.isfunction(function) and not label.startswith("_"):
                missing += [f"{name}.{label}: {gap}" for gap in unannotated(function)]
    assert not missing, "\n".join(missing)


def unannotated(function: FunctionType) -> list[str]:
    signature = inspect.signature(function)
    gaps = [p.name for p in signature.parameters.values() if p.annotation is p.empty and p.name not in ("self", "cls")]
    return gaps + (["return"] if signature.return_annotation is signature.empty else [])


def test_unannotated_parameters_are_seen():
    def half(x, y: int):
        return x

    assert unannotated(half) == ["x", "return"]


def test_one_way_order_of_folders():
    command = Path(sys.executable).with_name("lint-imports")
    done = subprocess.run([command, "--no-cache"], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_no_circles_among_modules():
    """Not in functions either, nor for the type checker alone; a package imports none that imports the package."""
    graph = grimp.build_graph("rockref", cache_dir=None)
    left = {module: graph.find_modules_directly_imported_by(module) for module in graph.modules}
    while free := [module for module, imported in left.items() if not imported & left.keys()]:
        for module in free:
            del left[module]
    assert sorted(left) == []


FOLDERS = "model jobs effects engines conformance measure identify studies discover report workflows commands".split()


@pytest.mark.parametrize("folder", FOLDERS)
def test_every_folder_is_in_the_contract(folder):
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    contract = settings["tool"]["importlinter"]["contracts"][0]
    assert folder in " ".join(contract["layers"]).split()
    assert (ROOT / "rockref" / folder / "__init__.py").is_file()


def test_no_file_over_400_lines():
    # Hand-written code only: 400 lines is what one reader keeps in view (a rule of the house).
    long = {str(path.relative_to(ROOT)): count_lines(path) for path in source_files() if count_lines(path) > 400}
    assert not long


def count_lines(path: Path) -> int:
    return len(path.read_text(encoding="utf-8").splitlines())


def test_no_room_for_leftovers():
    assert not [path for path in source_files() if path.stem in {"utils", "util", "helpers", "misc", "common"}]


def test_no_paths_of_one_machine():
    found = []
    for path in project_files():
        if path.suffix not in TEXT or path.stat().st_size > 1_000_000:
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
            if MACHINE_PATH.search(line):
                found.append(f"{path.relative_to(ROOT)}:{number}: {line.strip()[:100]}")
    assert not found, "\n".join(found)


@pytest.mark.parametrize(
    "line, is_path",
    [
        ("cd /wor" + "k/main", True),
        ("open('/tm" + "p/x.csv')", True),
        ("/home/" + "someone/data", True),
        ("see ../share" + "d/data", True),
        ("https://example.org/root/of/it", False),
        ("the square root/two", False),
        ("energy/work balance", False),
    ],
)
def test_machine_paths_are_recognised(line, is_path):
    assert bool(MACHINE_PATH.search(line)) == is_path


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_shipped_experiment_is_whole(name):
    folder = ROOT / "data/experiments" / name
    experiment = tomllib.loads((folder / "experiment.toml").read_text(encoding="utf-8"))
    assert experiment["name"] == name
    named = {run["file"] for run in experiment["run"]}
    assert len(named) == 6
    assert named | {"experiment.toml"} == {path.name for path in folder.iterdir()}


def test_every_shipped_experiment_has_its_answer():
    answers = json.loads((ROOT / "data/experiments/answers.json").read_text(encoding="utf-8"))
    assert [answer["name"] for answer in answers] == EXPERIMENTS


#: Words of a private language, each with the word of the field that stands for it now.
RETIRED = {
    "begun": "started", "grown": "forward selection", "plainer": "backward elimination", "kin": "confounders",
    "outlasting": "successive halving", "duel": "comparison of finalists", "upheld": "confirmed", "loud": "outlier",
    "taken_on": "refined", "in_full": "refined", "resized": "amplitude restart", "trifle": "negligible",
}  # fmt: skip


def test_no_word_of_a_private_language():
    """In text as in names: `not_begun` holds one."""
    pattern = re.compile(rf"(?<![^\W_])({'|'.join(RETIRED)})(?![^\W_])", re.IGNORECASE)
    pages = [*(ROOT / "docs").rglob("*.md"), *ROOT.glob("*.md"), *(ROOT / "rockref").rglob("*.py")]
    found = [
        f"{path.relative_to(ROOT)}: {word.group()} (write: {RETIRED[word.group().lower()]})"
        for path in pages
        for word in pattern.finditer(path.read_text(encoding="utf-8"))
    ]
    assert found == []


#: What a docstring of a function does not begin with: it says first what the function does.
NO_VERBS = re.compile(
    r"(The|An?|What|Whether|One|All|How|Which|Every|Each|Where|When|By|As|This|It|They|If) |[(`a-z\[]"
)


def test_docstrings_of_functions_begin_with_a_verb():
    found = []
    for path in [*(ROOT / "rockref").rglob("*.py"), *(ROOT / "golden").rglob("*.py")]:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef) and NO_VERBS.match(ast.get_docstring(node) or "Return"):
                found.append(f"{path.relative_to(ROOT)}:{node.lineno} {node.name}")
    assert found == []


#: Pages that a script writes, and lists that are searched, not read.
LISTS = {"api", "commands", "effects_gallery", "errors", "performance", "physics_engines", "review", "zoo"}


def test_no_page_is_longer_than_a_reader_follows():
    pages = [p for p in (ROOT / "docs").rglob("*.md") if "_build" not in p.parts and p.stem not in LISTS]
    assert not {str(p.relative_to(ROOT)): count_lines(p) for p in [*pages, ROOT / "README.md"] if count_lines(p) > 150}

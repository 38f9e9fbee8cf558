"""The pages of the documentation agree with the files that they describe."""

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FILES_PAGE = (ROOT / "docs/reference/files.md").read_text(encoding="utf-8")
EXPERIMENTS = sorted((ROOT / "data/experiments").glob("*/experiment.toml"))


def keys_of(document):
    """Every key of an experiment, as (section, key); the section is empty at the top."""
    for key, value in document.items():
        if isinstance(value, dict):
            yield from ((key, inner) for inner in value)
        elif isinstance(value, list):
            yield from ((key, inner) for table in value for inner in table)
        else:
            yield "", key


def example_on_the_page():
    return tomllib.loads(re.search(r"```toml\n(.*?)```", FILES_PAGE, re.DOTALL).group(1))


@pytest.mark.parametrize("path", EXPERIMENTS, ids=lambda path: path.parent.name)
def test_example_on_the_page_has_the_keys_of_the_shipped_experiments(path):
    assert set(keys_of(tomllib.loads(path.read_text(encoding="utf-8")))) == set(keys_of(example_on_the_page()))


def test_every_key_is_explained():
    explained = set(re.findall(r"^\| `(\w+)` \|", FILES_PAGE, re.MULTILINE))
    assert {key for _, key in keys_of(example_on_the_page())} <= explained

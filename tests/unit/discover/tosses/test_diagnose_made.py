"""The whole diagnosis on a few tosses with known truth."""

import json

import pytest

from rockref import Model, cli
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from tests.tosses import made, stated, write_tosses

pytest.importorskip("numba")


@pytest.mark.slow
def test_a_hidden_centre_is_named_shown_and_saved(capsys, tmp_path, monkeypatch):
    from rockref.discover.tosses import diagnose

    monkeypatch.setattr(
        diagnose, "CANDIDATES", {k: diagnose.CANDIDATES[k] for k in ("mass_eccentricity", "plate_tilt")}
    )
    true = stated().replace(effects=(MassEccentricity(1e-3, 0, 5e-3),))
    x, Lambda, _ = made(true, 40, frames=50, seed=2, noise=2e-5)
    folder = write_tosses(tmp_path / "tosses", x, Lambda)
    page, saved = tmp_path / "page", tmp_path / "m.toml"
    with pytest.raises(SystemExit) as end:
        cli.main(["diagnose", str(folder), "--report", str(page), "--save-model", str(saved), "--json"])
    assert end.value.code == 0
    record = json.loads(capsys.readouterr().out)
    assert record["effects"] == ["mass_eccentricity"] and record["verdict"] in ("named", "class")
    # What the tosses do not have is tried, and said to be so.
    assert record["not_needed"] == ["plate_tilt"]
    first = record["staircase"][1]
    assert first["proof"]["low"] > 0
    assert first["parameters"]["mass_eccentricity.z"]["value"] == pytest.approx(5e-3, abs=3e-4)
    arcs = next(a for a in record["agreement"] if a["quantity"] == "centre of mass, z")
    assert abs(arcs["without"] - 5e-3) < 4 * arcs["standard_error"]
    assert (page / "index.html").is_file() and (page / "staircase.png").stat().st_size > 5000
    model = Model.load(saved)
    assert any(e.id == "mass_eccentricity" for e in model.effects)

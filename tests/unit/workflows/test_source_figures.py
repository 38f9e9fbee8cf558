"""The figures of the source's studies show what they are given."""

import numpy as np
import pytest
from matplotlib.colors import to_hex

from rockref import Model
from rockref.engines import run
from rockref.model.channel import DEGREES
from rockref.model.housner import housner
from rockref.model.parameters import TABLE_3_1
from rockref.report.charts import style
from rockref.report.charts.figures import rendered
from rockref.workflows import source_figures
from tests.unit.workflows import source_records as made


@pytest.fixture(scope="module")
def response():
    """The release of Table 3.1 through its first two main impacts, in steps that are coarse and quick."""
    pytest.importorskip("numba")
    return run(Model.table_3_1().problem(1.6, 5e-5, 1000.0), engine="auto")


@pytest.fixture(scope="module")
def plane():
    model = Model.table_3_1()
    inertia = float(np.asarray(model.problem(0.01).block.inertia)[0, 0])
    return housner(model.mass, model.width, model.height, inertia, model.g, 0.117, 1.6, 500.0, 1e-3)


def line(ax, name):
    (found,) = [one for one in ax.lines if one.get_label() == name]
    return found


def test_the_response_has_its_rates_impacts_and_contacts(response, plane):
    axes = source_figures.response_figures(response, plane)["figure_3_4_whole"].axes
    for axis in range(3):
        np.testing.assert_array_equal(line(axes[axis], "eight points").get_ydata(), response.crv[:, axis])
        red = [one.get_xdata()[0] for one in axes[axis].lines if one.get_color() == style.IMPACT]
        assert red == pytest.approx(list(response.main_impacts()))
    # Housner's block has no other axis than the main one.
    np.testing.assert_array_equal(line(axes[0], "Housner").get_ydata(), DEGREES * plane.rate)
    assert all(one.get_label() != "Housner" for ax in axes[1:] for one in ax.lines)
    assert [label.get_text() for label in axes[3].get_yticklabels()] == [name for name, _ in response.contacts()]


def test_zooms_show_their_stretch_and_name_the_rows_once(response, plane):
    figure = source_figures.response_figures(response, plane)["figure_3_4_zooms"]
    grid = np.array(figure.axes).reshape(4, 3)
    t = line(grid[1, 0], "eight points").get_xdata()
    start, end = source_figures.ABOUT_FIRST
    assert start <= t[0] < start + 2e-3 and end - 2e-3 < t[-1] <= end
    assert grid[0, 0].get_ylabel() and not grid[0, 1].get_ylabel() and not grid[0, 2].get_ylabel()
    names = [len([label for label in ax.get_yticklabels() if label.get_text()]) for ax in grid[3]]
    assert names == [len(response.contacts()), 0, 0]
    assert rendered(figure, "png", dpi=40).startswith(b"\x89PNG")


def test_twins_above_the_noise_floor_are_red():
    (ax,) = source_figures.twins_figure(made.twins()).axes
    places = np.array([c.lines[0].get_xdata() for c in ax.containers])
    assert [to_hex(c.lines[0].get_color()) for c in ax.containers] == [style.COLOURS[1]] * 2 + [style.IMPACT]
    assert [set(c.lines[0].get_ydata()) for c in ax.containers] == [{0.5}, {-0.25}, {7.0}]
    # A place a seed, about the place of the parameter; bars of two standard errors of a quarter.
    assert np.all(np.diff(places, axis=0) > 0) and places.mean(axis=0) == pytest.approx(np.arange(len(TABLE_3_1)))
    (low, high) = ax.containers[0].lines[2][0].get_segments()[0][:, 1]
    assert (low, high) == (0.0, 1.0)


def test_the_way_of_every_gene_stands_in_the_panel_of_its_group():
    result = made.reduction()
    axes = source_figures.reduction_figure(result).axes
    assert [ax.get_title() for ax in axes] == [g["group"] for g in result["groups"]]
    for k, ax in enumerate(axes):
        found = [list(one.get_ydata()) for one in ax.lines]
        assert found == [[(gene + n) / 16 for n in range(4)] for gene in (2 * k, 2 * k + 1)]


def test_models_that_failed_stand_beside_the_reference_on_its_scale():
    t = np.linspace(0.0, 2.0, 201)
    wanted = np.stack([np.zeros_like(t), 0.1 * np.sin(20 * t), 0.2 * np.sin(30 * t)], axis=-1)
    found = [("near", t, 0.9 * wanted), ("far", t[::2], 5.0 * wanted[::2])]
    figure = source_figures.scenarios_figure(t, wanted, found)
    grid = np.array(figure.axes).reshape(2, 2)
    assert [ax.get_title(loc="left") for ax in grid[:, 0]] == ["near", "far"]
    for row, (_, at, crv) in enumerate(found):
        for column, axis in enumerate((1, 2)):
            ax = grid[row, column]
            np.testing.assert_array_equal(line(ax, "reference").get_ydata(), DEGREES * wanted[:, axis])
            np.testing.assert_array_equal(line(ax, "model").get_ydata(), DEGREES * crv[:, axis])
            np.testing.assert_array_equal(line(ax, "model").get_xdata(), at)
            # A model that runs away does not squeeze the reference.
            assert ax.get_ylim()[1] == pytest.approx(1.6 * DEGREES * np.abs(wanted[:, axis]).max())

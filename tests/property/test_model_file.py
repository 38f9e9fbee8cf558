"""A model that is saved and loaded is the same model, to the last bit."""

import dataclasses

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rockref import Model
from rockref.effects.catalogue import EFFECTS, in_step_order
from tests.strategies import between, parameter_sets

NOTES = st.dictionaries(
    st.text(st.characters(codec="ascii", categories=["Ll", "Lu", "Nd"]), min_size=1, max_size=8),
    st.one_of(st.text(max_size=20), st.integers(-(2**60), 2**60), between(-1e9, 1e9), st.booleans()),
    max_size=3,
)


@st.composite
def effects(draw):
    """One effect of the catalogue; each of its parameters at its default or anywhere in its plausible range."""
    kind = draw(st.sampled_from(list(EFFECTS.values())))
    low_and_high = {name: (q.low, q.high) for name, q in kind.quantities.items()}
    return kind(**{name: draw(between(*ends)) for name, ends in low_and_high.items() if draw(st.booleans())})


@st.composite
def models(draw):
    inertia = None
    if draw(st.booleans()):
        inertia = np.diag(draw(st.tuples(between(0.1, 3), between(0.1, 3), between(0.1, 3))))
    depth, height, parameters = draw(between(0.08, 0.5)), draw(between(0.3, 2)), draw(parameter_sets())
    return Model(
        mass=draw(between(1, 500)),
        width=draw(between(0.08, 0.5)),
        depth=depth,
        height=height,
        g=draw(between(1, 20)),
        # a slender block tips over earlier
        parameters=parameters.replace(theta_0=min(parameters.theta_0, 0.99 * float(np.arctan2(depth, height)))),
        points=draw(st.sampled_from(["eight_points", "four_points"])),
        inertia=inertia,
        foot_radius=draw(st.one_of(st.just(0.0), between(0, 0.01))),
        effects=tuple({e.id: e for e in draw(st.lists(effects(), max_size=3))}.values()),
        uncertainty=draw(NOTES),
        origin=draw(NOTES),
    )


@given(models())
def test_save_and_load(tmp_path_factory, model):
    path = tmp_path_factory.mktemp("model") / "model.toml"
    model.save(path)
    back = Model.load(path)
    for field in dataclasses.fields(Model):
        here, there = getattr(model, field.name), getattr(back, field.name)
        if field.name == "inertia":
            assert (here is None and there is None) or np.array_equal(here, there)
        elif field.name == "effects":
            # the file keeps them in the order in which they act
            assert in_step_order(here) == there
        else:
            assert here == there, field.name
    # and it is written the same way again
    again = path.with_name("again.toml")
    back.save(again)
    assert again.read_bytes() == path.read_bytes()

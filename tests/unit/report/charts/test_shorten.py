"""A drawing in fewer letters: the same places, neighbours of one look joined, nothing see-through joined."""

from rockref.report.charts.shorten import shortened

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"><metadata>x</metadata>'


def of(body):
    return shortened(f"{HEAD}{body}</svg>")


def path(d, style):
    return f'<g id="line2d_1"><path d="{d}" clip-path="" style="{style}"/></g>'


def test_steps_are_those_of_rounded_places_so_that_rounding_does_not_add_up():
    """A hundred steps of 0.04 to the right are 4 in all, a tenth now and then."""
    d = "M 0 0 " + " ".join(f"L {0.04 * k:.2f} {k}" for k in range(1, 101))
    made = of(path(d, "fill: none; stroke: #000"))
    assert made.count("l.1 1") == 40 and made.count("v1") == 60


def test_curves_are_kept():
    assert (
        of(path("M 0 3 C 0.8 3 1.6 2.7 2.1 2.1 z", "fill: red"))
        == '<path d="M0 3c.8 0 1.6-.3 2.1-.9z" style="fill:red"/>'
    )


def test_neighbours_of_one_look_are_one_path():
    grid = "fill: none; stroke: #e7ebef; stroke-width: 0.6; stroke-linecap: butt"
    assert of(path("M 1 2 L 1 9", grid) + path("M 4.04 2 L 4.04 9", grid)) == (
        '<path d="M1 2v7M4 2v7" style="fill:none;stroke:#e7ebef;stroke-width:.6"/>'
    )


def test_what_is_seen_through_or_filled_is_not_joined():
    for look in ("fill: none; stroke: #000; stroke-opacity: 0.5", "fill: #000"):
        assert of(2 * path("M 1 2 L 1 9", look)).count("<path") == 2


def test_words_keep_their_turn_and_lose_their_font():
    style = "font: 11px 'DejaVu Sans', sans-serif; text-anchor: end"
    text = f'<text style="{style}" x="5.04" y="7" transform="{{}}">a &lt; b</text>'
    assert (
        of(text.format("rotate(-0 5 7)")) == '<text style="font-size:11px;text-anchor:end" x="5" y="7">a &lt; b</text>'
    )
    assert 'transform="rotate(-90 5.123 7)"' in of(text.format("rotate(-90 5.1234 7)"))


def test_marks_are_found_by_their_names():
    made = of('<defs><path id="m1" d="M -3 3 L 3 3 L 3 -3 z"/></defs><use xlink:href="#m1" x="2.46" y="1"/>')
    assert made == '<defs><path id="m1" d="M-3 3h6v-6z"/></defs><use href="#m1" x="2.5" y="1"/>'


def test_a_path_without_data_is_left_out():
    svg = '<svg xmlns="http://www.w3.org/2000/svg"><path d="" style="fill: none; stroke: #000000"/></svg>'
    assert shortened(svg) == ""

"""What a fuzzer begins with, made from shipped files; words that it may put in; and damage that tests do."""

from __future__ import annotations

import gzip
import io
import json
import tempfile
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import strategies as st

from rockref.api import Model
from rockref.conformance import vectors
from rockref.conformance.backends import json_lines
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge import claims
from rockref.effects.catalogue import EFFECTS
from rockref.model.rotation import exponential, quaternion
from tests.fuzz.readers import RUN, questions
from tests.unit.measure.importing.test_contactnets import archive, older

ROOT = Path(__file__).resolve().parents[2]
SHIPPED = ROOT / "data" / "experiments"
#: Every so many rows of a shipped run, and so many of them: an experiment of 100 Hz that is read in a millisecond.
STRIDE, ROWS = 10, 110


def below(name: str, content: bytes, how: str = "") -> bytes:
    """A file as it stands in data of several."""
    return f"%%% {name} {how}".rstrip().encode() + b"\n" + content


def shipped_run(folder: Path) -> bytes:
    """The first run of a shipped experiment, thinned."""
    header, *rows = gzip.decompress((folder / "run01.csv.gz").read_bytes()).split(b"\n")
    return b"\n".join([header, *rows[::STRIDE][:ROWS]]) + b"\n"


def shipped_toml(folder: Path) -> bytes:
    """experiment.toml of a shipped experiment with its first run alone, at the rate of the thinned one."""
    text = (folder / "experiment.toml").read_text(encoding="utf-8")
    head, first, *_ = text.split("[[run]]")
    head = head.replace("sample_rate_hz = 1000", f"sample_rate_hz = {1000 // STRIDE}").replace("300", "40")
    return (head + "[[run]]" + first).encode()


def experiment() -> list[bytes]:
    """Two shipped experiments, one packed, one with a link; the small files that the formats allow."""
    found = []
    for name in ("mystery-02", "mystery-08"):
        toml, run = shipped_toml(SHIPPED / name), shipped_run(SHIPPED / name)
        found.append(below("experiment.toml", toml) + below("run01.csv.gz", run, "gz"))
        plain = toml.replace(b"run01.csv.gz", b"run01.csv")
        found.append(below("experiment.toml", plain) + below("run01.csv", run))
    found.append(below("experiment.toml", plain) + below("run01.csv", b"../secret.csv", "link"))
    found.append(below("experiment.toml", plain) + below("run01.csv", b"", "pipe"))
    found.append(below("experiment.toml", plain.replace(b"run01.csv", b"../secret.csv")))
    found.append(below("experiment.toml", b"", "folder"))
    return found


def table() -> list[bytes]:
    """The run of a shipped experiment, plain and packed; other units, pose, strangers among the columns."""
    run = shipped_run(SHIPPED / "mystery-02")
    head = b"t_ms,wx_rad_s,wy_mrad_s,wz_deg_s,note,x_mm,y_m,z_m,qw,qx,qy,qz\n"
    return [
        b"\0" + run,
        b"\1" + gzip.compress(run, mtime=0),
        b"\0\xef\xbb\xbf" + run.replace(b"\n", b"\r\n"),
        b"\0" + head + b"0,1,2,3,a,1,2,3,1,0,0,0\n1.5,-1e-3,+.5,3.,,1,2,3,1,0,0,0\n",
        b"\0t_s;wx_deg_s;wy_deg_s;wz_deg_s\n0,5;1;2;3\n",
    ]


def tosses() -> list[bytes]:
    """Two tosses of ten frames in one table, and as an experiment of their own."""
    t = np.arange(10) / 148.0
    lines, runs = [], []
    for number in (0, 1):
        x = np.column_stack([0.1 * t, 0.2 * t, 0.3 + number * 0.1 + t - 5 * t * t])
        q = quaternion(exponential(np.column_stack([t, 2 * t, 3 * t])))
        rows = [",".join(f"{a:.6g}" for a in (t[i], *x[i], *q[i])) for i in range(10)]
        lines += [f"{number},{i},{row}" for i, row in enumerate(rows)]
        runs.append(("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n" + "\n".join(rows) + "\n").encode())
    text = ("toss,frame,t_s,x_m,y_m,z_m,qw,qx,qy,qz\n" + "\n".join(lines) + "\n").encode()
    toml = b'name = "made"\nkind = "toss"\nbaseline = "four_points"\n'
    toml += b"[block]\nmass_kg = 0.5\nwidth_m = 0.1\nheight_m = 0.2\n"
    toml += b"".join(b'[[run]]\nid = "%d"\nfile = "%d.csv"\nuse = "fit"\n' % (i, i) for i in (0, 1))
    folder = below("experiment.toml", toml) + below("0.csv", runs[0]) + below("1.csv", runs[1])
    return [below("tosses.csv", text), below("tosses.csv.gz", text, "gz"), folder]


def tensor() -> list[bytes]:
    """A tensor in both forms."""
    with tempfile.TemporaryDirectory() as name:
        path, found = Path(name) / "0.pt", []
        for write in (archive, older):
            write(path, np.arange(26, dtype="f4").reshape(1, 2, 13))
            found.append(path.read_bytes())
    return found


def model() -> list[bytes]:
    """Table 3.1, four points, points of one's own, 54 parameters, and every effect of the catalogue."""
    with tempfile.TemporaryDirectory() as name:
        path, found = Path(name) / "model.toml", []
        law = Model.table_3_1()
        block, points = law.body_without_effects()
        own = law.replace(points="custom", custom_points=points)
        some = law.replace(effects=tuple(kind.typical() for kind in list(EFFECTS.values())[::3]))
        for one in (law, Model.four_points(), own, some):
            one.save(path)
            found.append(path.read_bytes())
    return [*found, b'[effects.mine]\nfile = "mine.py:Mine"\n', b"", b"format = 1\n[effects.quadratic_drag]\nc = 0.4\n"]


def effect() -> list[bytes]:
    """Every effect of the catalogue with its typical numbers, and what a user may mistype."""
    words = ["mine.py:Mine:a=1", "../x.py:Y", "quadratic_drag", "quadratic_drag:c=0.4,,c=1", "none", ""]
    for kind in EFFECTS.values():
        values = {k: v for k, v in kind.typical().values().items() if isinstance(v, float)}
        words.append(f"{kind.id}:" + ",".join(f"{k}={v!r}" for k, v in values.items()))
    return [word.encode() for word in words]


def stored() -> list[bytes]:
    """The first vector of each piece, a claim, a short run, and the manifest."""
    found = []
    for layer in ("L0", "L1", "L4"):
        document = json.loads(vectors.read_bytes(f"{layer}.json"))
        document |= {"sets": {}, "vectors": [v for v in document["vectors"] if "set" not in v][:1]}
        found.append(below(f"{layer}.json", json.dumps(document).encode()))
    document = json.loads(vectors.read_bytes("LE.json"))
    one = min(document["vectors"], key=lambda v: len(json.dumps(v)) + len(json.dumps(document["sets"][v["set"]])))
    document |= {"vectors": [one], "sets": {one["set"]: document["sets"][one["set"]]}}
    found.append(below("LE.json", json.dumps(document).encode()))
    rows = gzip.decompress(vectors.read_bytes(f"L5/{RUN}.csv.gz")).split(b"\n")[:4]
    run = below("L5/run.json", vectors.read_bytes(f"L5/{RUN}.json"))
    found.append(run + below("L5/run.csv.gz", b"\n".join(rows) + b"\n", "gz"))
    found.append(below("L0.json", b"{}") + below("MANIFEST.json", b'{"files":{},"trajectories":[],"windows":[]}'))
    return found


def program() -> list[bytes]:
    """What the law answers to the questions that a program is asked, all of them and a few; other behaviour."""
    law, out = NumpyEngine(), io.StringIO()
    asked: list[dict[str, Any]] = [{"cmd": "start", "protocol": 1}]
    asked += [json_lines.question(f"q{i}", v.piece, v.inputs) for i, v in enumerate(questions(), 1)]
    asked.append(json_lines.of_problem(f"q{len(asked)}", "simulate", vectors.trajectory(RUN).problem))
    json_lines.serve(law, map(json_lines.line, asked), out)
    first, *rest = out.getvalue().encode().splitlines(keepends=True)
    return [
        first + b"".join(rest),
        b'{"protocol":1,"capabilities":["rotate"]}\n' + rest[5],
        b'{"protocol":1,"name":"\\u0000<\\ud800>","capabilities":["contact_law","effect"]}\nrubbish\n[1]\n{"id":"q1"}\n',
        b'{"protocol":1,"capabilities":["contact_law"]}\n{"id":"q1","error":"\\u0001\\ud800"}\n',
    ]


def answers() -> list[bytes]:
    """A file of the law's answers to a vector of each piece."""
    law, out = NumpyEngine(), io.StringIO()
    json_lines.serve(law, [json_lines.line(json_lines.of_vector(v)) for v in questions()], out)
    text = out.getvalue().encode()
    return [text, b'{"protocol":1,"capabilities":["rotate","step"]}\n' + text[:2000], b'{"id":"a","out":{}}\r\n']


def requests() -> list[bytes]:
    """The questions to a vector of each piece; start, stop, a claim."""
    claim = claims.claims()[0]
    inputs = claim.inputs | {"effect": claim.effect, "parameters": claim.parameters}
    effect_ = json_lines.line(json_lines.question("e", "effect", inputs))
    lines = [json_lines.line(json_lines.of_vector(v)) for v in questions()]
    start = '{"cmd":"start","protocol":1}\n'
    return [(start + line).encode() for line in [*lines, effect_]] + [b'{"cmd":"stop"}\n', b'{"cmd":"run","id":[]}\n']


MAKERS: tuple[Callable[[], list[bytes]], ...] = (
    experiment, table, tosses, tensor, model, effect, stored, program, answers, requests,
)  # fmt: skip


@lru_cache
def seeds(name: str) -> tuple[bytes, ...]:
    """The corpus of a reader, always the same."""
    return tuple({make.__name__: make for make in MAKERS}[name]())


#: Words that mean something to one of the readers, and numbers, names and structures that break careless ones.
WORDS = [
    b"nan", b"inf", b"-inf", b"1e999", b"1e308", b"5e-324", b"-0.0", b"9" * 400, b"9" * 5000, b"0x1p2000", b"1_0",
    b"1,5", b"null", b"true", b"[]", b"{}", b"[" * 200, b"[[1],[2,3]]", b'["a"]', b'{"a":1}', b'""', b"'''", b'"""',
    b"\\ud800", b"\xff\xfe", b"\xef\xbb\xbf", b"\x1f\x8b", b"\x80\x02", b"\0", b"\r", b"\r\n", b"\n\n", b";", b"\t",
    b"=", b",", b":", "\u22121".encode(), "\u2028".encode(), b"../secret.csv", b"/etc/passwd", b"file:///etc/passwd",
    b"C:\\x.csv", b"~/x.csv", b"%s%n{0}", b"a." * 300, b"\n%%% x.csv\n", b"\n%%% run01.csv link\n../secret.csv\n",
    b"\n%%% experiment.toml gz\n", b".py:", b"file=", b"[[run]]", b'kind = "toss"\n', b"[gyro]\n", b'"id":"q1",',
    b'"error":', b'"out":', b'"hex":', b'"flags":', b'"set":',
]  # fmt: skip


@st.composite
def damaged(draw: st.DrawFn, name: str) -> bytes:
    """A seed of a reader after one to four changes: cut out, doubled, overwritten, put in, or joined with another."""
    corpus = seeds(name)
    data = draw(st.sampled_from(corpus))
    for _ in range(draw(st.integers(1, 4))):
        a, b = sorted(draw(st.tuples(st.integers(0, len(data)), st.integers(0, len(data)))))
        b = min(b, a + draw(st.sampled_from([0, 1, 8, 64, 4096])))
        change = draw(st.sampled_from(["put", "cut", "double", "overwrite", "join"]))
        new = draw(st.one_of(st.sampled_from(WORDS), st.binary(max_size=6)))
        if change == "put":
            data = data[:a] + new + data[a:]
        elif change == "cut":
            data = data[:a] + data[b:]
        elif change == "double":
            data = data[:b] + data[a:]
        elif change == "overwrite":
            data = data[:a] + new + data[b:]
        else:
            data = data[:a] + draw(st.sampled_from(corpus))[b:]
    return data

"""Files of tensors are read without PyTorch, and nothing in them is run."""

import io
import pickle
import struct
import zipfile

import numpy as np
import pytest

from rockref.measure.importing.contactnets import import_contactnets
from rockref.measure.reading.tensorfile import LARGEST, MAGIC, read_tensor
from rockref.measure.tosses.load import CUBE_WIDTH, load_tosses
from rockref.model.errors import InputError
from rockref.model.rotation import quaternion
from tests.command import run
from tests.refusal import refused
from tests.tosses import made, stated


class Global:
    """Pickles as a bare name of a module that is not there."""

    def __init__(self, module, name):
        self.module, self.name = module, name


class Call:
    """Pickles as a call of a name."""

    def __init__(self, function, *arguments):
        self.function, self.arguments = function, arguments


class Storage:
    """Pickles as a persistent id."""

    def __init__(self, kind, key, count):
        self.pid = ("storage", Global("torch", kind), key, "cpu", count)


class Writer(pickle._Pickler):
    """Writes what PyTorch would, opcode by opcode."""

    def persistent_id(self, obj):
        return obj.pid if isinstance(obj, Storage) else None

    def save(self, obj, save_persistent_id=True):
        if isinstance(obj, Global):
            self.write(b"c" + f"{obj.module}\n{obj.name}\n".encode())
        elif isinstance(obj, Call):
            self.save(obj.function)
            self.save(obj.arguments)
            self.write(b"R")
        else:
            super().save(obj, save_persistent_id)


def dumped(obj) -> bytes:
    out = io.BytesIO()
    Writer(out, 2).dump(obj)
    return out.getvalue()


def tensor(a: np.ndarray, legacy: bool = False):
    kind = {"f4": "FloatStorage", "f8": "DoubleStorage"}[a.dtype.str[1:]]
    strides = tuple(s // a.itemsize for s in a.strides)
    storage = Storage(kind, "0", a.size)
    if legacy:
        storage.pid = (*storage.pid, None)
    rebuild = Global("torch._utils", "_rebuild_tensor_v2")
    return Call(rebuild, storage, 0, a.shape, strides, False, Call(Global("collections", "OrderedDict")))


def archive(path, a):
    with zipfile.ZipFile(path, "w") as z:
        z.writestr("toss/data.pkl", dumped(tensor(a)))
        z.writestr("toss/data/0", a.tobytes())


def older(path, a):
    parts = [dumped(MAGIC), dumped(1001), dumped({"little_endian": True}), dumped(tensor(a, True)), dumped(["0"])]
    path.write_bytes(b"".join(parts) + struct.pack("<q", a.size) + a.tobytes())


@pytest.mark.parametrize("write", [archive, older])
@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_both_forms_give_the_numbers_back(tmp_path, write, dtype):
    a = np.arange(60, dtype=dtype).reshape(1, 5, 12) / 7
    write(tmp_path / "0.pt", a)
    assert np.array_equal(read_tensor(tmp_path / "0.pt"), a)


def test_what_would_run_is_refused(tmp_path):
    bait = tmp_path / "bait"
    with zipfile.ZipFile(tmp_path / "0.pt", "w") as z:
        z.writestr("toss/data.pkl", dumped(Call(Global("os", "system"), f"touch {bait}")))
    with pytest.raises(InputError, match="os.system"):
        read_tensor(tmp_path / "0.pt")
    assert not bait.exists()


@pytest.mark.parametrize("raw", [b"", b"PK\x03\x04", b"\x80\x02K\x01.", b"cos\nsystem\n(S'true'\ntR."])
def test_rubbish_is_refused(tmp_path, raw):
    (tmp_path / "0.pt").write_bytes(raw)
    with pytest.raises(InputError, match="E-FILE]"):
        read_tensor(tmp_path / "0.pt")


@pytest.mark.parametrize(
    ("count", "shape", "strides", "words"),
    [
        (12, (4, 3), (30, 1), "reaches out of its numbers"),
        (12, (4, 30), (30, 1), "more numbers than it holds"),
        (1, (10**9,), (0,), "more numbers than it holds"),
    ],
)
def test_a_shape_of_more_numbers_than_there_are_is_refused(tmp_path, count, shape, strides, words):
    liar = Call(Global("torch._utils", "_rebuild_tensor_v2"), Storage("DoubleStorage", "0", count), 0, shape, strides)
    with zipfile.ZipFile(tmp_path / "0.pt", "w") as z:
        z.writestr("toss/data.pkl", dumped(liar))
        z.writestr("toss/data/0", np.zeros(count).tobytes())
    with pytest.raises(InputError, match=words):
        read_tensor(tmp_path / "0.pt")


def test_a_packed_bomb_is_not_unpacked(tmp_path):
    with zipfile.ZipFile(tmp_path / "0.pt", "w", zipfile.ZIP_DEFLATED) as z:
        z.writestr("toss/data.pkl", dumped(tensor(np.zeros(1))))
        z.writestr("toss/data/0", bytes(LARGEST))
    with pytest.raises(InputError, match="too large"):
        read_tensor(tmp_path / "0.pt")


@pytest.mark.parametrize(
    ("raw", "words"),
    [
        (b"\x80\x02(lp0\n.", "LIST is not part"),
        (b"\x80\x02}}b.", "BUILD is not part"),
        (b"\x80\x02" + b"N" * 20_000 + b".", "too long"),
        (b"\x80\x02ccollections\nOrderedDict\n)R.", "does not begin"),
        (b"\x80\x02ctorch._utils\n_rebuild_tensor\n)R.", "no tensor"),
        (b"\x80\x02Nr\xff\xff\xff\x7f.", "does not begin"),  # a place among a thousand million
    ],
)
def test_a_pickle_is_read_no_further_than_a_tensor_needs(tmp_path, raw, words):
    (tmp_path / "0.pt").write_bytes(raw)
    with pytest.raises(InputError, match=words):
        read_tensor(tmp_path / "0.pt")


def test_a_clone_becomes_a_folder_of_tosses_with_its_copies_marked(tmp_path):
    x, Lambda, starts = made(stated(), 3, frames=20)
    clone = tmp_path / "clone" / "data" / "tosses_processed"
    clone.mkdir(parents=True)
    half = CUBE_WIDTH / 2
    for number, i, sign in ((0, 0, 1), (1, 1, 1), (2, 2, 1), (7, 1, -1)):
        q = quaternion(Lambda[i])
        place = x[i] * [sign, sign, 1]
        turn = np.array([0, 0, 0, 1.0]) if sign < 0 else np.array([1.0, 0, 0, 0])
        q = product(turn, q)
        rows = np.concatenate([place / half, q, np.zeros((20, 3)), np.zeros((20, 3)), np.zeros((20, 6))], axis=1)
        (archive if number % 2 else older)(clone / f"{number}.pt", rows)
    assert import_contactnets(tmp_path / "clone", tmp_path / "out") == (4, 1)
    tosses = load_tosses(tmp_path / "out")
    assert [t.id for t in tosses.tosses] == ["0", "1", "2"]
    assert tosses.copies == (("7", "1"),)
    assert np.max(np.abs(tosses.tosses[2].x - x[2])) < 1e-6
    assert np.max(np.abs(tosses.tosses[2].Lambda - Lambda[2])) < 1e-6


def product(p, q):
    """Quaternion product of one with many."""
    w, v = p[0] * q[:, 0] - q[:, 1:] @ p[1:], p[0] * q[:, 1:] + q[:, :1] * p[1:] + np.cross(p[1:], q[:, 1:])
    return np.column_stack([w, v])


def test_a_folder_without_tosses_is_refused(tmp_path):
    with pytest.raises(InputError, match="E-FOLDER]"):
        import_contactnets(tmp_path, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_files_that_are_there_already_stay_as_they_are(tmp_path):
    rows = np.zeros((1, 8, 19))
    rows[..., 3] = 1.0
    clone, project = tmp_path / "clone", tmp_path / "project"
    clone.mkdir(), project.mkdir()
    archive(clone / "0.pt", rows)
    (project / "README.md").write_text("# mine")
    for place in (project, project / "README.md"):
        error = refused(import_contactnets, clone, place)
        assert error.code == "E-WRITE" and "README.md" in str(error)
    assert (project / "README.md").read_text() == "# mine" and len(list(project.iterdir())) == 1
    # The folder of an import may be made again.
    assert import_contactnets(clone, tmp_path / "out") == import_contactnets(clone, tmp_path / "out") == (1, 0)


def test_an_empty_word_is_no_folder(capsys, tmp_path):
    code, _, err = run(capsys, "import", "contactnets", tmp_path, "-o", "")
    assert code == 2 and "is empty" in err

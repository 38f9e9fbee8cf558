"""Makes `law.wasm` from the C text: `python -m rockref.lab.build` (extra `lab`, which brings the compiler).

Strict arithmetic: no contraction, no fast mathematics. The module imports nothing, so that a page needs no loader; exp,
pow, log, sin, cos and tanh are musl's (MIT), right to one unit in the last place.
"""

from __future__ import annotations

import hashlib
import subprocess
import sys
import tempfile
from pathlib import Path

from rockref.lab import golden, layout
from rockref.lab.wasm import BINARY
from rockref.model.storage import write_bytes, write_text

HERE = Path(__file__).parent
DIGEST = HERE / "law.wasm.sha256"
#: -mexec-model=reactor: a library without main.
FLAGS = (
    "-target wasm32-wasi -mexec-model=reactor -O3 -ffp-contract=off -fno-math-errno -Wall -Werror -s "
    "-Wl,--no-entry -Wl,--strip-all -Wl,--export-dynamic"
).split()


def compiled() -> bytes:
    """Return the module that the C text gives. Raises CalledProcessError where it does not compile."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / BINARY
        sources = sorted(f"law/{path.name}" for path in (HERE / "law").glob("*.c"))
        command = [sys.executable, "-m", "ziglang", "cc", *FLAGS, "-o", str(out), *sources]
        subprocess.run(command, cwd=HERE, check=True)
        return out.read_bytes()


def digest(data: bytes) -> str:
    """Return the line of `law.wasm.sha256`, as `sha256sum` writes it."""
    return f"{hashlib.sha256(data).hexdigest()}  {BINARY}\n"


if __name__ == "__main__":
    write_text(layout.HEADER, layout.header())
    made = compiled()
    write_bytes(HERE / BINARY, made)
    write_text(DIGEST, digest(made))
    golden.write()

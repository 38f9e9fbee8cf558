"""The room is light: SciPy is loaded by the functions that need it, when they are called."""

import subprocess
import sys


def test_room_loads_numpy_and_nothing_else():
    code = "import sys; before = set(sys.modules); import rockref.measure; print(*(set(sys.modules) - before))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = {name.partition(".")[0] for name in done.stdout.split()} - sys.stdlib_module_names
    assert "scipy" not in loaded and "pandas" not in loaded and "matplotlib" not in loaded
    assert {"rockref", "numpy"} <= loaded


def test_public_names_exist():
    import rockref.measure

    assert all(hasattr(rockref.measure, name) for name in rockref.measure.__all__)
    assert rockref.measure.__all__ == sorted(rockref.measure.__all__)

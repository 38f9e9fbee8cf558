"""The coverage-guided fuzzer on the readers: ``python -m tests.fuzz.run SECONDS [READER ...]``; needs the extra `fuzz`.

Each reader has a process of its own, for so many seconds, below 1 GiB of memory, and no piece of data may take more
than half a minute. The corpus grows in `.fuzz/READER`, and is begun with the next time; what breaks a reader is kept as
`.fuzz/READER-crash-...`, `-timeout-...` or `-oom-...`, and is given to it again by ``... --again READER FILE``.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CORPUS = ROOT / ".fuzz"
MEMORY_MB, PATIENCE = 1024, 30


def fuzz(name: str, seconds: str, *again: str) -> None:
    """Fuzz one reader in this process, which ends with it."""
    import atheris

    with atheris.instrument_imports(include=["rockref", "tomllib"]):
        from tests.fuzz.readers import DECOY, tried
        from tests.fuzz.seeds import SHIPPED, WORDS, seeds, shipped_run

    warnings.filterwarnings("error", module=r"rockref(\.|$)")
    corpus = CORPUS / name
    corpus.mkdir(parents=True, exist_ok=True)
    for number, data in enumerate(seeds(name)):
        (corpus / f"seed{number:02d}").write_bytes(data)
    shared = Path("/dev/shm")
    place = Path(tempfile.mkdtemp(prefix="fuzz", dir=shared if shared.is_dir() else None))
    (place / DECOY).write_bytes(shipped_run(SHIPPED / "mystery-02"))
    words = place / "words"
    short = (word for word in WORDS if len(word) < 100)
    words.write_text("".join('"' + "".join(f"\\x{b:02x}" for b in word) + '"\n' for word in short))
    longest = max(4096, *(2 * len(data) for data in seeds(name)))
    options = [
        f"-max_total_time={seconds}", f"-rss_limit_mb={MEMORY_MB}", f"-timeout={PATIENCE}", f"-max_len={longest}",
        f"-dict={words}", f"-artifact_prefix={CORPUS / name}-", "-print_final_stats=1",
    ]  # fmt: skip
    atheris.Setup([sys.argv[0], *options, *(again or [str(corpus)])], lambda data: tried(name, data, place / "here"))
    atheris.Fuzz()


def main() -> int:
    """Fuzz the readers one after the other, and say what came of it."""
    if sys.argv[1] == "--again":
        fuzz(sys.argv[2], "0", sys.argv[3])
    if sys.argv[1] == "--one":
        fuzz(sys.argv[2], sys.argv[3])
    from tests.fuzz.readers import READERS

    seconds, *names = sys.argv[1:]
    bad = 0
    for name in names or READERS:
        done = subprocess.run(
            [sys.executable, "-m", "tests.fuzz.run", "--one", name, seconds],
            cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace",
        )  # fmt: skip
        (CORPUS / f"{name}.log").write_text(done.stderr)
        runs = re.findall(r"number_of_executed_units: (\d+)", done.stderr) or ["?"]
        covered = re.findall(r"cov: (\d+) ft: (\d+)", done.stderr) or [("?", "?")]
        found = re.findall(r"Test unit written to (\S+)", done.stderr)
        bad += done.returncode != 0
        said = (
            f"found {', '.join(found)}" if found else "nothing found" if not done.returncode else "FAILED, see its log"
        )
        print(
            f"{name}: {runs[-1]} executions, coverage {covered[-1][0]}, features {covered[-1][1]}: {said}", flush=True
        )
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())

"""The measured speeds as a page of the documentation and as a picture."""

from __future__ import annotations

from pathlib import Path

import effects
import lanes

from rockref.model.storage import write_bytes, write_text

NAMES = {
    "numba_one_core": "rockref, compiled, one core, one block",
    "numba_one_thread": "rockref, compiled, one core, many blocks abreast",
    "numba_all_cores": "rockref, compiled, all cores, many blocks abreast",
    "lammps": "LAMMPS",
    "numpy_batch_1024": "rockref, the law in NumPy, 1024 blocks at once",
    "mujoco": "MuJoCo (another contact law)",
    "mujoco_rollout": "MuJoCo, 16 blocks on all cores (`mujoco.rollout`)",
    "numpy_one_block": "rockref, the law in NumPy, one block",
}


def speeds(found: dict) -> list[tuple[str, float]]:
    """Name and block-steps a second of everything that ran, the fastest first."""
    peers = {name: result.get("steps_per_s") for name, result in found["peers"].items()}
    rows = [(text, found.get(key) or peers.get(key)) for key, text in NAMES.items()]
    return sorted(((text, value) for text, value in rows if value), key=lambda r: -r[1])


def table(found: dict) -> str:
    """The measured part of the page, in Markdown."""
    rows = speeds(found)
    base = next((value for text, value in rows if text == NAMES["lammps"]), rows[-1][1])
    against = "LAMMPS" if NAMES["lammps"] in dict(rows) else rows[-1][0]
    machine = found["machine"]
    lines = [
        f"{machine['cpu']}, {machine['cores']} cores, Python {machine['python']}, NumPy {machine['numpy']}, "
        f"numba {machine['numba'] or 'not installed'}; load before the run {machine['load_before']:.1f}.",
        "",
        f"| engine | block-steps a second | times {against} |",
        "| --- | ---: | ---: |",
        *(f"| {text} | {value:,.0f} | {value / base:.2g} |" for text, value in rows),
        "",
    ]
    for name, result in found["peers"].items():
        if "skipped" in result:
            lines.append(f"{name} was not measured: {result['skipped'].splitlines()[-1][:120]}.")
        elif "first_main_impact_s" in result:
            lines.append(
                f"{name} {result['version']} puts the first main impact at {result['first_main_impact_s']:.4f} s."
            )
    if "first_call_s" in found:
        lines += [
            "",
            f"All cores run many problems {found['gain_of_all_cores']:.2f} times as fast as one. The first call "
            f"compiles for {found['first_call_s']:.0f} s; the first call of a later process takes "
            f"{found['first_call_of_a_later_process_s']:.1f} s.",
            "",
            *(
                [
                    f"A run of 10 s at 2 kHz takes {found['memory_api_mb']:.0f} MB at its peak from Python, "
                    f"{found['memory_command_mb']:.0f} MB as `rockref simulate -o out.csv` with its file.",
                    "",
                ]
                if "memory_api_mb" in found
                else []
            ),
            "| duration [s] | compiled, one run [ms] |",
            "| ---: | ---: |",
            *(f"| {d:g} | {s * 1e3:.3g} |" for d, s in found["seconds_by_duration"]),
            "",
            "| points | compiled, 0.3 s [ms] |",
            "| ---: | ---: |",
            *(f"| {n} | {s * 1e3:.3g} |" for n, s in found["seconds_by_points"]),
            "",
            "| blocks at once | compiled, one step [µs] | NumPy, one step [µs] |",
            "| ---: | ---: | ---: |",
            *(
                f"| {B} | {a * 1e6:.3g} | {b * 1e6:.3g} |"
                for (B, a), (_, b) in zip(
                    found["seconds_a_step_by_batch_numba"], found["seconds_a_step_by_batch_numpy"], strict=True
                )
            ),
        ]
    if "effects" in found:
        lines += ["", *effects.table(found["effects"])]
    if "abreast" in found:
        lines += ["", *lanes.tables(found["abreast"])]
    return "\n".join(lines)


def picture(found: dict) -> bytes:
    """Bars of the speeds, and the cost by batch, as SVG."""
    import io

    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    with plt.rc_context({"svg.hashsalt": "rockref", "font.size": 9, "svg.fonttype": "none"}):
        figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.2), width_ratios=(1.2, 1), layout="constrained")
        rows = speeds(found)[::-1]
        ours = ["#1b6ca8" if text.startswith("rockref") else "#9a9a9a" for text, _ in rows]
        left.barh([text for text, _ in rows], [value for _, value in rows], color=ours)
        left.set_xscale("log")
        left.set_xlabel("block-steps a second")
        for i, (_, value) in enumerate(rows):
            left.annotate(f" {value:,.2g}" if value < 1e3 else f" {value:,.0f}", (value, i), va="center", fontsize=8)
        left.set_xlim(right=rows[-1][1] * 12)
        for key, label, style in (("numpy", "NumPy", "s--"), ("numba", "compiled, all cores", "o-")):
            pairs = found.get(f"seconds_a_step_by_batch_{key}", [])
            right.loglog([B for B, _ in pairs], [1e6 * s for _, s in pairs], style, label=label)
        right.set_xlabel("blocks at once")
        right.set_ylabel("one step of all of them [µs]")
        right.legend(frameon=False)
        for axes in (left, right):
            axes.spines[["top", "right"]].set_visible(False)
        buffer = io.BytesIO()
        figure.savefig(buffer, format="svg", metadata={"Date": None})
        plt.close(figure)
    return buffer.getvalue()


def write(found: dict, root: Path) -> None:
    """Put the figure and the table in their places under `root`."""
    (root / "docs/figures").mkdir(exist_ok=True)
    write_bytes(root / "docs/figures/bench.svg", picture(found))
    written = "Measured by `make bench`; not to be edited."
    write_text(root / "benchmarks/performance.md", f"{written}\n\n{table(found)}\n")

"""What is told of many judgements: counts by way, and the mistakes that have another name."""

from __future__ import annotations

import json
from typing import Any

#: What a backend shows: its pieces, runs alone, or runs without their forces.
WAYS = ("pieces", "runs", "runs without forces")


def counted(found: list[dict[str, Any]]) -> dict[str, dict[str, int]]:
    """By way: how many were asked, detected, named, named in the top two, named or called alike."""
    table = {}
    for way in WAYS:
        asked = [f["ways"][way] for f in found if way in f["ways"]]
        counts = {k: sum(a[k] for a in asked) for k in ("detected", "named", "top two", "alike")}
        table[way] = {"asked": len(asked)} | counts
    return table


def show(found: list[dict[str, Any]], harmless: list[dict[str, Any]], as_json: bool) -> None:
    """Print counts, and the mistakes that are not named."""
    table, rejected = counted(found), sum(any(a["detected"] for a in h["ways"].values()) for h in harmless)
    if as_json:
        counts = table | {"harmless": len(harmless), "harmless rejected": rejected}
        print(json.dumps({"counts": counts, "mistakes": found}, indent=1))
        return
    for way, row in table.items():
        print(f"{way}: " + ", ".join(f"{k} {n}" for k, n in row.items()))
    print(f"harmless changes rejected: {rejected} of {len(harmless)}")
    for f in found:
        for way, a in f["ways"].items():
            if not a["named"]:
                got = " then ".join([a["rule"], *a["next"]]) if a["rule"] else "no rule" if a["detected"] else "PASS"
                print(f"  {way}: {f['says']} ({' or '.join(f['rules'])}): {got}; {a['vector']}; {a['says']}")

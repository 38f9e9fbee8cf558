"""The judge: what is asked of a backend, how answers are compared, and the verdict that names a rule."""

from rockref.conformance.judge.findings import LAYERS, PROFILES, Findings, judge, used_profile

__all__ = ["LAYERS", "PROFILES", "Findings", "judge", "used_profile"]

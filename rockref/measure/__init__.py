"""Experiment folders and runs: reading, checks, main impacts, envelopes, spectra, energy ledger, the gyroscope."""

from rockref.measure.experiment import load_experiment
from rockref.measure.gyroscope import record
from rockref.measure.reading.table import Table, read_table
from rockref.measure.records.notice import Notice
from rockref.measure.records.release import Experiment, Gyro, Run
from rockref.measure.signals.activity import Leakage, activity, arc_shares, leakage, onset, out_of_plane
from rockref.measure.signals.arcs import Arcs, arcs
from rockref.measure.signals.envelopes import Envelope, EnvelopeShape, envelope_shape, envelopes
from rockref.measure.signals.impacts import Impacts, main_impacts
from rockref.measure.signals.ledger import Ledger, RockingBlock, energy_ledger, rocking_block
from rockref.measure.signals.noise import NoiseFloor, noise_floor
from rockref.measure.signals.phases import Phases, phases
from rockref.measure.signals.repeatability import Repeatability, repeat_groups, repeatability
from rockref.measure.signals.spectra import Spectrum, amplitude_spectrum

__all__ = [
    "Arcs",
    "Envelope",
    "EnvelopeShape",
    "Experiment",
    "Gyro",
    "Impacts",
    "Leakage",
    "Ledger",
    "NoiseFloor",
    "Notice",
    "Phases",
    "Repeatability",
    "RockingBlock",
    "Run",
    "Spectrum",
    "Table",
    "activity",
    "amplitude_spectrum",
    "arc_shares",
    "arcs",
    "energy_ledger",
    "envelope_shape",
    "envelopes",
    "leakage",
    "load_experiment",
    "main_impacts",
    "noise_floor",
    "onset",
    "out_of_plane",
    "phases",
    "read_table",
    "record",
    "repeat_groups",
    "repeatability",
    "rocking_block",
]

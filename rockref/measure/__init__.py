"""Experiment folders and runs: reading, checks, main impacts, envelopes, spectra, energy ledger, the gyroscope."""

from rockref.measure.activity import Leakage, activity, arc_shares, leakage, onset, out_of_plane
from rockref.measure.arcs import Arcs, arcs
from rockref.measure.envelopes import Envelope, EnvelopeShape, envelope_shape, envelopes
from rockref.measure.experiment import load_experiment
from rockref.measure.gyroscope import record
from rockref.measure.impacts import Impacts, main_impacts
from rockref.measure.ledger import Ledger, RockingBlock, energy_ledger, rocking_block
from rockref.measure.noise import NoiseFloor, noise_floor
from rockref.measure.notice import Notice
from rockref.measure.phases import Phases, phases
from rockref.measure.release import Experiment, Gyro, Run
from rockref.measure.repeatability import Repeatability, repeat_groups, repeatability
from rockref.measure.spectra import Spectrum, amplitude_spectrum
from rockref.measure.table import Table, read_table

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

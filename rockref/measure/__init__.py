"""Experiment folders and runs: reading, checks, main impacts, envelopes, spectra, energy ledger, the gyroscope."""

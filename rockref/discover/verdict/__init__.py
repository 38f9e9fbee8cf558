"""The verdict: a pure function of stored evidence and of calibrated numbers."""

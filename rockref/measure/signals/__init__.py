"""What a record shows by itself: main impacts, arcs, envelopes, spectra, noise, energy."""

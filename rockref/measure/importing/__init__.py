"""From the files of a logger to an experiment folder: layout, channels, release, axes, units, tilts, hold-out."""

from rockref.measure.importing.campaign import Campaign, Choices, import_logs
from rockref.measure.importing.writing import write_campaign

__all__ = ["Campaign", "Choices", "import_logs", "write_campaign"]

"""From the files of a logger to an experiment folder: layout, channels, release, axes, units, tilts, hold-out."""

from rockref.measure.importing.campaign import Campaign, Choices, import_logs
from rockref.measure.importing.writing import check_vacant, write_campaign

__all__ = ["Campaign", "Choices", "check_vacant", "import_logs", "write_campaign"]

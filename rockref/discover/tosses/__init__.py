"""Tosses beside models: errors of whole flights, fits, what is missing. The release's pieces step aside here."""

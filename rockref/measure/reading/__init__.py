"""Files of strangers: text, tables with named columns, keys of TOML files, the time column."""

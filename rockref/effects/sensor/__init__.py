"""What the gyroscope makes of the crv: sensor."""

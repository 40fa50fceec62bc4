"""Memory of the PMC006B4: EEPROM engine, I2C, boot."""

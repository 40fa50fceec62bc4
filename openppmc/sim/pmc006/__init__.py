"""Surroundings of a PMC006B4: virtual line of controllers with motor and EEPROM."""
